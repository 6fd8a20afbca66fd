#include "bench/plan/new_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <iostream>
#include <set>
#include <string_view>
#include <vector>

#include "assembly/problem/scene.hpp"
#include "bench/plan/face_curves.hpp"
#include "bench/plan/mesh_files.hpp"
#include "bench/plan/scene_file.hpp"
#include "bench/records/json.hpp"
#include "mesh/mesh.hpp"
#include "mesh/model_format.hpp"
#include "mesh/model_settings.hpp"
#include "support/atomic_file.hpp"
#include "support/sign_of_life.hpp"

namespace airybench {
namespace {

std::string length_unit_of(const std::vector<std::string>& settings) {
  const std::string setting = std::string(length_unit_setting.option) + "=";
  for (const std::string& given : settings)
    if (given.starts_with(setting)) return given.substr(setting.size());
  return "mm";
}

// "sole" of "Contact_sole".
std::string part_of(const std::string& name, const std::string& role) {
  const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
  std::string part = name;
  const auto at = std::search(part.begin(), part.end(), role.begin(), role.end(), same);
  part.erase(at, at + std::min(part.end() - at, std::ssize(role)));
  const auto is_part = [](unsigned char c) { return c >= 0x80 || std::isalnum(c) != 0; };
  part.erase(part.begin(), std::ranges::find_if(part, is_part));
  while (!part.empty() && !is_part(part.back())) part.pop_back();
  return part;
}

// A curve that is given no role is addressed by its name, with the role that this may mean.
std::string label_of(const Json& curve) {
  const std::string role = curve["role"], perhaps = curve["perhaps"];
  const std::vector<std::string> names = curve["names"];
  const bool is_given = role != "force" || std::ranges::find(names, role) != names.end();
  if (is_given || names.empty()) return role;
  if (perhaps.empty()) return fmt::format("{}:{}", role, names.front());
  const std::string part = part_of(names.front(), perhaps);
  return part.empty() ? perhaps : fmt::format("{}:{}", perhaps, part);
}

struct NamedCurve {
  std::string number;
  std::vector<std::string> names;
  std::string face, label;  // the model's or a proposed one; an arc may take one of its own
  FaceCurve shape;
};

std::vector<FaceCurve> shapes_of(const std::vector<NamedCurve>& curves,
                                 std::string NamedCurve::*name, const std::string& value) {
  std::vector<FaceCurve> shapes;
  for (const NamedCurve& curve : curves)
    if (curve.*name == value) shapes.push_back(curve.shape);
  return shapes;
}

bool is_contact(const std::string& label) {
  return parse_boundary_label(label)->role == BoundaryRole::contact;
}

std::vector<NamedCurve> curves_of(const Json& shown) {
  std::vector<NamedCurve> curves;
  for (const Json& curve : shown["curves"]) {
    NamedCurve& named = curves.emplace_back();
    named.number = std::to_string(curve["number"].get<int>());
    named.names = curve["names"];
    named.face = named.label = label_of(curve);
    for (const Json& walk : curve["walks_mm"]) {
      Walk& places = named.shape.walks.emplace_back();
      for (const Json& place : walk) places.emplace_back(place[0], place[1]);
    }
    named.shape.circle = circle_of(named.shape.walks);
  }
  // "contact:curve_2", "contact:sole_curve_2": a face has one shape.
  for (NamedCurve& curve : curves)
    if (is_contact(curve.face) && curve.shape.circle &&
        !common_circle(shapes_of(curves, &NamedCurve::face, curve.face)))
      curve.label +=
          (curve.face.find(':') == curve.face.npos ? ":curve_" : "_curve_") + curve.number;
  return curves;
}

// The contact faces that face another one, in pairs, by their names.
std::vector<std::array<std::string, 2>> facing_faces(const std::vector<NamedCurve>& curves) {
  std::set<std::string> faces;
  for (const NamedCurve& curve : curves)
    if (is_contact(curve.face)) faces.insert(curve.face);
  std::vector<std::array<std::string, 2>> pairs;
  while (!faces.empty()) {
    const std::string one = faces.extract(faces.begin()).value();
    const std::vector<FaceCurve> shape = shapes_of(curves, &NamedCurve::face, one);
    const auto other = std::ranges::find_if(faces, [&](const std::string& face) {
      const std::vector<FaceCurve> of_face = shapes_of(curves, &NamedCurve::face, face);
      return face_each_other(shape, of_face) || face_each_other(of_face, shape);
    });
    if (other == faces.end()) continue;
    pairs.push_back({one, *other});
    faces.erase(other);
  }
  return pairs;
}

// The groups of a face: one, or one for each shape.
std::vector<std::string> labels_of(const std::vector<NamedCurve>& curves, const std::string& face) {
  std::set<std::string> labels;
  for (const NamedCurve& curve : curves)
    if (curve.face == face) labels.insert(curve.label);
  return {labels.begin(), labels.end()};
}

// whole_face: none where it presses on another body.
BoundaryValues values_to_fill_in(const std::string& label, const std::vector<FaceCurve>& curves,
                                 const std::vector<FaceCurve>& whole_face) {
  BoundaryValues values;
  switch (parse_boundary_label(label)->role) {
    case BoundaryRole::displacement:
      values.support = BoundaryValues::Support::full;  // a displacement would replace the scene's
      return values;
    case BoundaryRole::force:
      values.traction_MPa.emplace().values.fill({0, 0});
      return values;
    case BoundaryRole::contact:
      break;
  }
  if (!whole_face.empty()) values.contact = {Scene().friction, 0, wall_at(whole_face), {}};
  if (const std::optional<Circle> circle = common_circle(curves))
    values.contact.face = face_on(*circle);
  return values;
}

void note_missing_roles(const BoundaryConditions& boundary, const std::string& name) {
  std::set<BoundaryRole> present;
  for (const auto& [label, values] : boundary) present.insert(parse_boundary_label(label)->role);
  const auto note = [&](BoundaryRole role, const char* meaning) {
    if (present.contains(role)) return;
    const std::string_view word = boundary_role_names[static_cast<std::size_t>(role)];
    std::cerr << fmt::format(
        "note: {}: no curve has the role {}: {} (--role=CURVE={} of bench new-scene gives it)\n",
        name, word, meaning, word);
  };
  note(BoundaryRole::displacement,
       present.contains(BoundaryRole::contact) ? "contact alone holds it" : "it is held nowhere");
  note(BoundaryRole::contact, "it touches nothing");
}

}  // namespace

std::string new_scene_text(const std::filesystem::path& model,
                           const std::vector<std::string>& settings) {
  if (format_of(model) == ModelFormat::abaqus && std::ranges::all_of(settings, is_model_limit))
    if (const std::string of_deck = scene_of_deck(model, settings); !of_deck.empty())
      return of_deck;
  const Json shown = parse_json(curves_of_model(model, settings));
  const std::vector<NamedCurve> curves = curves_of(shown);
  SceneFile file;
  file.length_unit = length_unit_of(settings);
  file.keys = {"length_unit",          "plane",    "materials", "displacement_mm",
               "body_force_N_per_mm3", "boundary", "contacts"};
  Scene& scene = file.scene;
  scene.displacement_mm = {0, 0};
  std::set<std::string> paired;
  for (const auto& [one, other] : facing_faces(curves)) {
    scene.contacts.push_back(
        {{labels_of(curves, one), labels_of(curves, other)}, scene.friction, 0});
    paired.insert({one, other});
  }
  for (const NamedCurve& curve : curves) {
    if (std::ranges::find(curve.names, curve.label) == curve.names.end()) {
      const bool has_name = !curve.names.empty() && curve.label == curve.face;
      file.roles.emplace_back(has_name ? curve.names.front() : curve.number, curve.label);
    }
    if (!scene.boundary.contains(curve.label))
      scene.boundary[curve.label] = values_to_fill_in(
          curve.label, shapes_of(curves, &NamedCurve::label, curve.label),
          paired.contains(curve.face) ? std::vector<FaceCurve>()
                                      : shapes_of(curves, &NamedCurve::face, curve.face));
  }
  if (!file.roles.empty()) file.keys.insert("roles");
  for (const Json& body : shown["bodies"]) scene.materials[body.get<std::string>()] = {};
  note_missing_roles(scene.boundary, model_name(model) + ".json");
  return file.text();
}

std::string write_new_scene(const std::filesystem::path& model,
                            const std::vector<std::string>& settings) {
  const std::string name = model_name(model) + ".json";
  const auto refuse_if_there = [&] {
    if (std::error_code error; std::filesystem::exists(name, error))
      throw FileError(name + ": is there already (allowed: a name that is free)");
  };
  refuse_if_there();
  const SignsOfLife signs("reading " + model.string());
  const std::string text = new_scene_text(model, settings);
  refuse_if_there();
  write_file_atomically(name, text);
  return name;
}

}  // namespace airybench
