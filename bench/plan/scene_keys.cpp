// Tables of a scene file's keys: the key's name, the member that it sets, its range.
// check_values() (assembly/problem/scene.hpp) checks the ranges that hold for any scene.
#include "assembly/problem/scene.hpp"
#include "bench/plan/scene_file.hpp"
#include "bench/records/json_value.hpp"
#include "mesh/mesh.hpp"
#include "mesh/model_settings.hpp"

namespace airybench {
namespace {

constexpr int most = 1'000'000;  // limit of counts

enum class Curve { obstacle, face };

}  // namespace

// Argument-dependent lookup must find read(), so no overload is in the unnamed namespace.

static void read(const JsonValue& value, Eigen::Vector2d& vector) {
  const Json& json = value.json;
  if (!json.is_array() || json.size() != 2 || !json[0].is_number() || !json[1].is_number())
    value.fail("two numbers [x, y]");
  vector = {json[0].get<double>(), json[1].get<double>()};
}

static void read(const JsonValue& value, Material& material) {
  value.object({key("young_MPa", material.young_MPa), key("poisson", material.poisson)});
}

template <typename Value>
void read(const JsonValue& value, LinearValue<Value>& linear) {
  if (value.json.is_object()) {
    value.object({key("at_mm", linear.at_mm), key("values", linear.values)},
                 "{\"at_mm\": [[x, y], [x, y]], \"values\": [..., ...]}, both given");
    return;
  }
  Value constant{};
  read(value, constant);
  linear.values.fill(constant);
}

static void read(const JsonValue& value, FlatWall& wall) {
  value.object({key("point_mm", wall.point_mm), key("normal", wall.normal)},
               "{\"point_mm\": [x, y], \"normal\": [x, y]}, both given");
}

static void read(const JsonValue& value, PolylineWall& wall) {
  if (!value.json.is_array()) value.fail("a list of points [x, y], or in a file a file's name");
  wall.points_mm.resize(value.json.size());
  for (std::size_t k = 0; k < wall.points_mm.size(); ++k) read(value.item(k), wall.points_mm[k]);
}

static void read_circle(const JsonValue& value, Curve curve, CircularWall& wall) {
  using enum CircularWall::Bodies;
  std::vector<JsonKey> keys = {key("centre_mm", wall.centre_mm),
                               positive("radius_mm", wall.radius_mm)};
  if (curve == Curve::face) {
    value.object(keys, "{\"centre_mm\": [x, y], \"radius_mm\": ...}, both given");
    return;
  }
  keys.push_back(choice("bodies", wall.bodies, {{"inside", inside}, {"outside", outside}}));
  value.object(keys,
               "{\"centre_mm\": [x, y], \"radius_mm\": ..., \"bodies\": \"inside\" or "
               "\"outside\"}, all given");
}

static JsonKey curve_key(const char* name, std::optional<Wall>& target, Curve curve) {
  return {name, [&target, curve](const JsonValue& value) {
            Wall wall;
            value.object(
                {{"flat", [&](const JsonValue& v) { read(v, wall.emplace<FlatWall>()); }},
                 {"circle",
                  [&](const JsonValue& v) { read_circle(v, curve, wall.emplace<CircularWall>()); }},
                 {"polyline", [&](const JsonValue& v) { read(v, wall.emplace<PolylineWall>()); }}});
            if (value.json.size() != 1) value.fail("one of flat, circle, polyline");
            target = std::move(wall);
          }};
}

static void read(const JsonValue& value, BoundaryConditions& conditions) {
  using enum BoundaryValues::Support;
  value.each("an object with a boundary group as each key", [&](const std::string& label,
                                                                const JsonValue& of_group) {
    BoundaryValues& values = conditions[label];
    ContactValues& contact = values.contact;
    of_group.object({key("traction_MPa", values.traction_MPa),
                     key("pressure_MPa", values.pressure_MPa),
                     key("displacement_mm", values.displacement_mm),
                     choice("support", values.support, {{"full", full}, {"normal", normal}}),
                     key("friction", contact.friction), key("clearance_mm", contact.clearance_mm),
                     curve_key("wall", contact.wall, Curve::obstacle),
                     curve_key("face", contact.face, Curve::face)});
  });
}

static void read(const JsonValue& value, PointSupport& point) {
  bool is_placed = false;
  value.object(
      {{"at_mm",
        [&](const JsonValue& at) {
          read(at, point.at_mm);
          is_placed = true;
        }},
       {"displacement_mm",
        [&](const JsonValue& both) {
          const Json& json = both.json;
          const auto is_component = [](const Json& x) { return x.is_number() || x.is_null(); };
          if (!json.is_array() || json.size() != 2 || !std::ranges::all_of(json, is_component))
            both.fail("two of numbers and null, [x, y]");
          for (std::size_t k = 0; k < 2; ++k)
            if (!json[k].is_null()) point.displacement_mm[k] = json[k].get<double>();
        }},
       key("body", point.body)});
  if (!is_placed) value.fail("an object with at_mm, [x, y], and displacement_mm");
}

static void read(const JsonValue& value, Grading& grading) {
  value.object({key("at_mm", grading.at_mm), key("ratio", grading.ratio)},
               "{\"at_mm\": [x, y], \"ratio\": ...}, both given");
}

static void read(const JsonValue& value, Slivers& slivers) {
  value.object({key("aspect", slivers.aspect), whole("count", slivers.count, 1, most)},
               "{\"aspect\": ..., \"count\": ...}, both given");
}

static void read(const JsonValue& value, MeshTransform& mesh) {
  value.object(
      {whole("refine", mesh.refine, 0, most_refinements), key("grade", mesh.grade),
       key("slivers", mesh.slivers), positive("scale", mesh.scale), key("stretch", mesh.stretch),
       key("move_mm", mesh.move_mm), whole("keep_contact_edges", mesh.keep_contact_edges, 0, most),
       whole("keep_displacement_edges", mesh.keep_displacement_edges, 1, most),
       whole("keep_force_edges", mesh.keep_force_edges, 0, most), key("polygon", mesh.polygon)});
}

template <typename Item>
static JsonKey list(const char* name, std::vector<Item>& items, const Item& preset,
                    const char* allowed) {
  return {name, [&items, preset, allowed](const JsonValue& value) {
            if (!value.json.is_array() || value.json.empty()) value.fail(allowed);
            items.assign(value.json.size(), preset);
            for (std::size_t k = 0; k < items.size(); ++k) read(value.item(k), items[k]);
          }};
}

static void read(const JsonValue& value, ContactPair& pair) {
  constexpr const char* allowed = "two groups, or lists of them: [\"contact:a\", \"contact:b\"]";
  value.object({{"between",
                 [&](const JsonValue& both) {
                   if (!both.json.is_array() || both.json.size() != 2) both.fail(allowed);
                   for (std::size_t side = 0; side < 2; ++side) {
                     const JsonValue groups = both.item(side);
                     std::vector<std::string>& labels = pair.between[side];
                     if (groups.json.is_array() && !groups.json.empty()) {
                       labels.resize(groups.json.size());
                       for (std::size_t k = 0; k < labels.size(); ++k)
                         read(groups.item(k), labels[k]);
                     } else {
                       read(groups, labels.emplace_back());
                     }
                   }
                 }},
                key("friction", pair.friction),
                key("clearance_mm", pair.clearance_mm)});
  if (pair.between[0].empty()) value.fail(std::string("between: ") + allowed);
}

static JsonKey pairs(const char* name, std::vector<ContactPair>& contacts) {
  return list(name, contacts, ContactPair(), "a list of pairs {\"between\": [..., ...]}");
}

static void read_layers(const JsonValue& value, Scene& scene) {
  Layers& layers = scene.layers;
  value.object({key("normal", layers.normal), whole("count", layers.count, 1, most_layers),
                list("interfaces_mm", layers.interfaces_mm, 0., "a list of numbers, ascending"),
                list("materials", scene.layer_materials, scene.material, "a list of materials")});
  if (value.json.contains("count") == value.json.contains("interfaces_mm"))
    value.fail("either count or interfaces_mm");
}

static void read(const JsonValue& value, LoadStep& step) {
  value.object({key("displacement_mm", step.displacement_mm),
                key("body_force_N_per_mm3", step.body_force_N_per_mm3),
                key("clearance_mm", step.clearance_mm), key("boundary", step.boundary),
                pairs("contacts", step.contacts)});
}

static void read_load_steps(const JsonValue& value, Scene& scene) {
  const Json& json = value.json;
  if (json.is_number_integer() && json >= 1 && json <= most_load_steps) {
    scene.equal_steps = json.get<int>();
    return;
  }
  if (!json.is_array() || json.empty() || json.size() >= most_load_steps)
    value.fail(fmt::format("a whole number from 1 to {}, or a list of 1 to {} steps",
                           most_load_steps, most_load_steps - 1));
  scene.later_steps.resize(json.size());
  for (std::size_t k = 0; k < json.size(); ++k)
    read(value.at(std::to_string(k + 1), json[k]), scene.later_steps[k]);
}

static void add(const ModelSetting& setting, const std::string& value, SceneFile& file) {
  file.model_settings.push_back(fmt::format("{}={}", setting.option, value));
}

static void read_roles(const JsonValue& value, SceneFile& file) {
  value.each("an object with a curve's name or number, numbers \"1-4\", or \"rest\" as each key",
             [&](const std::string& curves, const JsonValue& role) {
               const std::string label =
                   role.json.is_string() ? role.json.get<std::string>() : std::string();
               if (!parse_boundary_label(label)) role.fail(std::string(boundary_labels_allowed));
               add(role_setting, fmt::format("{}={}", curves, label), file);
             });
}

static void read_length_unit(const JsonValue& value, SceneFile& file) {
  constexpr std::array<std::string_view, 3> units = {"mm", "m", "inch"};
  const std::string_view unit = value.one_of(units, {}, ", of a model's lengths");
  if (unit != "mm") add(length_unit_setting, std::string(unit), file);
}

void read(const JsonValue& value, SceneFile& file) {
  Scene& scene = file.scene;
  Material& material = scene.material;
  // Keys from which others take their defaults come first.
  value.object(
      {whole("teeth", scene.teeth, 1, most),
       positive("root_half_height_mm", scene.root_half_height_mm),
       positive("length_mm", scene.length_mm),
       positive("tip_half_height_mm", scene.tip_half_height_mm),
       key("young_MPa", material.young_MPa),
       key("poisson", material.poisson),
       choice("plane", scene.plane, {{"strain", Plane::strain}, {"stress", Plane::stress}}),
       key("friction", scene.friction),
       {"crown_radius_mm",
        [&](const JsonValue& v) {
          if (v.json.is_null())
            scene.crown_radius_mm.reset();
          else
            read(v, scene.crown_radius_mm);
        }},
       curve_key("wall", scene.wall, Curve::obstacle),
       curve_key("face", scene.face, Curve::face),
       key("clearance_mm", scene.clearance_mm),
       key("displacement_mm", scene.displacement_mm),
       key("body_force_N_per_mm3", scene.body_force_N_per_mm3),
       {"load_steps", [&](const JsonValue& v) { read_load_steps(v, scene); }},
       {"materials",
        [&](const JsonValue& v) {
          v.each("an object with a body's name as each key",
                 [&](const std::string& region, const JsonValue& of_region) {
                   read(of_region, scene.materials[region] = material);
                 });
        }},
       key("boundary", scene.boundary),
       list("point_supports", scene.point_supports, PointSupport(),
            "a list of points {\"at_mm\": [x, y], \"displacement_mm\": [..., ...]}"),
       pairs("contacts", scene.contacts),
       {"roles", [&](const JsonValue& v) { read_roles(v, file); }},
       {"length_unit", [&](const JsonValue& v) { read_length_unit(v, file); }},
       key("mesh", scene.mesh),
       {"layers", [&](const JsonValue& v) { read_layers(v, scene); }},
       key("group", scene.group),
       key("about", scene.about)});
}

}  // namespace airybench
