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
#include "bench/plan/contact_faces.hpp"
#include "bench/plan/mesh_files.hpp"
#include "bench/records/json.hpp"
#include "mesh/mesh.hpp"
#include "mesh/model_format.hpp"
#include "mesh/model_settings.hpp"
#include "support/atomic_file.hpp"
#include "support/sign_of_life.hpp"

namespace airybench {
namespace {

// An object with a line for each key.
std::string in_lines(const Json& object) {
  std::vector<std::string> lines;
  for (const auto& [key, value] : object.items())
    lines.push_back(fmt::format("    {}: {}", json_text(key), json_text(value)));
  return fmt::format("{{\n{}\n  }}", fmt::join(lines, ",\n"));
}

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
Json labels_of(const std::vector<NamedCurve>& curves, const std::string& face) {
  std::set<std::string> labels;
  for (const NamedCurve& curve : curves)
    if (curve.face == face) labels.insert(curve.label);
  return labels.size() == 1 ? Json(*labels.begin()) : Json(labels);
}

// whole_face: none where it presses on another body.
Json values_to_fill_in(const std::string& label, const std::vector<FaceCurve>& curves,
                       const std::vector<FaceCurve>& whole_face) {
  switch (parse_boundary_label(label)->role) {
    case BoundaryRole::displacement:
      return {{"support", "full"}};  // a displacement would take the place of the scene's
    case BoundaryRole::force:
      return {{"traction_MPa", {0, 0}}};
    case BoundaryRole::contact:
      break;
  }
  Json values = Json::object();
  if (!whole_face.empty())
    values = {{"friction", Scene().friction}, {"clearance_mm", 0}, {"wall", wall_at(whole_face)}};
  if (const std::optional<Circle> circle = common_circle(curves)) values["face"] = face_on(*circle);
  return values;
}

void note_missing_roles(const Json& boundary, const std::string& name) {
  std::set<BoundaryRole> there;
  for (const auto& group : boundary.items()) there.insert(parse_boundary_label(group.key())->role);
  const auto note = [&](BoundaryRole role, const char* meaning) {
    if (there.contains(role)) return;
    const std::string_view word = boundary_role_names[static_cast<std::size_t>(role)];
    std::cerr << fmt::format(
        "note: {}: no curve has the role {}: {} (--role=CURVE={} next to --new-scene gives it)\n",
        name, word, meaning, word);
  };
  note(BoundaryRole::displacement,
       there.contains(BoundaryRole::contact) ? "contact alone holds it" : "it is held nowhere");
  note(BoundaryRole::contact, "it touches nothing");
}

}  // namespace

std::string new_scene_text(const std::filesystem::path& model,
                           const std::vector<std::string>& settings) {
  if (format_of(model) == ModelFormat::abaqus && std::ranges::all_of(settings, is_model_limit))
    if (const std::string of_deck = scene_of_deck(model, settings); !of_deck.empty())
      return of_deck;
  const Json shown = parse_json(curves_of_model(model, settings));
  const Material material;
  const Json of_material = {{"young_MPa", material.young_MPa}, {"poisson", material.poisson}};
  Json roles = Json::object(), boundary = Json::object(), materials = Json::object();
  const std::vector<NamedCurve> curves = curves_of(shown);
  Json contacts = Json::array();
  std::set<std::string> paired;
  for (const auto& [one, other] : facing_faces(curves)) {
    contacts.push_back(
        {{"between", Json::array({labels_of(curves, one), labels_of(curves, other)})},
         {"friction", Scene().friction},
         {"clearance_mm", 0}});
    paired.insert({one, other});
  }
  for (const NamedCurve& curve : curves) {
    if (std::ranges::find(curve.names, curve.label) == curve.names.end())
      roles[curve.names.empty() || curve.label != curve.face ? curve.number : curve.names.front()] =
          curve.label;
    if (!boundary.contains(curve.label))
      boundary[curve.label] = values_to_fill_in(
          curve.label, shapes_of(curves, &NamedCurve::label, curve.label),
          paired.contains(curve.face) ? std::vector<FaceCurve>()
                                      : shapes_of(curves, &NamedCurve::face, curve.face));
  }
  for (const Json& body : shown["bodies"]) materials[body.get<std::string>()] = of_material;
  note_missing_roles(boundary, model_name(model) + ".json");
  std::vector<std::string> lines = {
      fmt::format("\"length_unit\": {}", json_text(length_unit_of(settings))),
      "\"plane\": \"strain\"",
      fmt::format("\"materials\": {}", in_lines(materials)),
      "\"displacement_mm\": [0, 0]",
      "\"body_force_N_per_mm3\": [0, 0]",
      fmt::format("\"boundary\": {}", in_lines(boundary))};
  if (!contacts.empty()) lines.push_back(fmt::format("\"contacts\": {}", json_text(contacts)));
  if (!roles.empty())
    lines.insert(lines.begin() + 1, fmt::format("\"roles\": {}", in_lines(roles)));
  return fmt::format("{{\n  {}\n}}\n", fmt::join(lines, ",\n  "));
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
