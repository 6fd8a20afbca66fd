// Tables of a scene file's keys: the key's name, the member that it stands for, its range. Reader
// and writer go by them. check_values() (assembly/problem/scene.hpp) checks the ranges that hold
// for any scene.
#include "assembly/problem/scene.hpp"
#include "bench/plan/scene_file.hpp"
#include "bench/records/json_value.hpp"
#include "mesh/mesh.hpp"
#include "mesh/model_settings.hpp"

namespace airybench {
namespace {

constexpr int most = 1'000'000;  // limit of counts

enum class Curve { obstacle, face };

struct KeyTable {
  std::vector<JsonKey> keys;
  std::string all = {};  // what is allowed where every key is required
};

}  // namespace

// Argument-dependent lookup must find read(), put() and table(), so no overload is in the unnamed
// namespace.

template <typename T>
concept HasTable = requires(T& target) {
  { table(target) } -> std::same_as<KeyTable>;
};
template <HasTable T>
void read(const JsonValue& value, T& target) {
  const KeyTable of_target = table(target);
  value.object(of_target.keys, of_target.all);
}
template <HasTable T>
void put(JsonSlot& slot, T value) {
  slot.json = written(table(value).keys);
}
// Without the keys that have their defaults.
template <HasTable T>
Json changes(T value) {
  T preset;
  return changes(table(value).keys, table(preset).keys);
}

static void read(const JsonValue& value, Eigen::Vector2d& vector) {
  const Json& json = value.json;
  if (!json.is_array() || json.size() != 2 || !json[0].is_number() || !json[1].is_number())
    value.fail("two numbers [x, y]");
  vector = {json[0].get<double>(), json[1].get<double>()};
}
static void put(JsonSlot& slot, const Eigen::Vector2d& vector) {
  slot.json = {vector.x(), vector.y()};
}

static KeyTable table(Material& material) {
  return {{key("young_MPa", material.young_MPa), key("poisson", material.poisson),
           key("expansion_per_K", material.expansion_per_K)}};
}

template <typename Value>
KeyTable linear_table(LinearValue<Value>& linear) {
  return {{key("at_mm", linear.at_mm), key("values", linear.values)},
          "{\"at_mm\": [[x, y], [x, y]], \"values\": [..., ...]}, both given"};
}
template <typename Value>
void read(const JsonValue& value, LinearValue<Value>& linear) {
  if (value.json.is_object()) {
    const KeyTable of_linear = linear_table(linear);
    value.object(of_linear.keys, of_linear.all);
    return;
  }
  Value constant{};
  read(value, constant);
  linear.values.fill(constant);
}
template <typename Value>
void put(JsonSlot& slot, LinearValue<Value> linear) {
  if (linear.values[0] == linear.values[1])
    put(slot, linear.values[0]);
  else
    slot.json = written(linear_table(linear).keys);
}

static KeyTable table(FlatWall& wall) {
  return {{key("point_mm", wall.point_mm), key("normal", wall.normal)},
          "{\"point_mm\": [x, y], \"normal\": [x, y]}, both given"};
}

static void read(const JsonValue& value, PolylineWall& wall) {
  if (!value.json.is_array()) value.fail("a list of points [x, y], or in a file a file's name");
  wall.points_mm.resize(value.json.size());
  for (std::size_t k = 0; k < wall.points_mm.size(); ++k) read(value.item(k), wall.points_mm[k]);
}
static void put(JsonSlot& slot, const PolylineWall& wall) { slot.json = json_list(wall.points_mm); }

static KeyTable circle_table(CircularWall& wall, Curve curve) {
  using enum CircularWall::Bodies;
  KeyTable circle = {{key("centre_mm", wall.centre_mm), positive("radius_mm", wall.radius_mm)},
                     "{\"centre_mm\": [x, y], \"radius_mm\": ...}, both given"};
  if (curve == Curve::face) return circle;
  circle.keys.push_back(choice("bodies", wall.bodies, {{"inside", inside}, {"outside", outside}}));
  circle.all =
      "{\"centre_mm\": [x, y], \"radius_mm\": ..., \"bodies\": \"inside\" or \"outside\"}, all "
      "given";
  return circle;
}

static JsonKey curve_key(const char* name, std::optional<Wall>& target, Curve curve) {
  const auto take = [&target, curve](const JsonValue& value) {
    Wall wall;
    value.object(
        {{"flat", [&](const JsonValue& v) { read(v, wall.emplace<FlatWall>()); }},
         {"circle",
          [&](const JsonValue& v) {
            const KeyTable circle = circle_table(wall.emplace<CircularWall>(), curve);
            v.object(circle.keys, circle.all);
          }},
         {"polyline", [&](const JsonValue& v) { read(v, wall.emplace<PolylineWall>()); }}});
    if (value.json.size() != 1) value.fail("one of flat, circle, polyline");
    target = std::move(wall);
  };
  const auto give = [&target, curve]() -> Json {
    if (!target) return Json::value_t::discarded;
    if (const auto* flat = std::get_if<FlatWall>(&*target)) return {{"flat", written(*flat)}};
    if (auto* circle = std::get_if<CircularWall>(&*target))
      return {{"circle", written(circle_table(*circle, curve).keys)}};
    return {{"polyline", written(std::get<PolylineWall>(*target))}};
  };
  return {.name = name, .take = take, .give = give};
}

static KeyTable table(BoundaryValues& values) {
  using enum BoundaryValues::Support;
  ContactValues& contact = values.contact;
  return {{key("traction_MPa", values.traction_MPa), key("pressure_MPa", values.pressure_MPa),
           key("displacement_mm", values.displacement_mm),
           choice("support", values.support, {{"full", full}, {"normal", normal}}),
           key("friction", contact.friction), key("clearance_mm", contact.clearance_mm),
           curve_key("wall", contact.wall, Curve::obstacle),
           curve_key("face", contact.face, Curve::face)}};
}

template <typename T>
void put(JsonSlot& slot, const std::map<std::string, T>& values) {
  for (const auto& [name, value] : values) {
    if (slot.json.is_discarded()) slot.json = Json::object();
    slot.json[name] = written(value);
  }
}

static void read(const JsonValue& value, BoundaryConditions& conditions) {
  value.each("an object with a boundary group as each key",
             [&](const std::string& label, const JsonValue& of_group) {
               read(of_group, conditions[label]);
             });
}

static void read(const JsonValue& value, Temperatures& temperature_K) {
  value.each("an object with a body's name as each key",
             [&](const std::string& body, const JsonValue& of_body) {
               read(of_body, temperature_K[body]);
             });
}

static KeyTable table(PointSupport& point) {
  auto& displacement_mm = point.displacement_mm;
  const auto take = [&displacement_mm](const JsonValue& both) {
    const Json& json = both.json;
    const auto is_component = [](const Json& x) { return x.is_number() || x.is_null(); };
    if (!json.is_array() || json.size() != 2 || !std::ranges::all_of(json, is_component))
      both.fail("two of numbers and null, [x, y]");
    for (std::size_t k = 0; k < 2; ++k)
      if (!json[k].is_null()) displacement_mm[k] = json[k].get<double>();
  };
  const auto give = [&displacement_mm] {
    return Json::array({or_null(displacement_mm[0]), or_null(displacement_mm[1])});
  };
  return {{required(key("at_mm", point.at_mm)),
           {.name = "displacement_mm", .take = take, .give = give},
           key("body", point.body)}};
}
static void put(JsonSlot& slot, const PointSupport& point) { slot.json = changes(point); }

static KeyTable table(Grading& grading) {
  return {{key("at_mm", grading.at_mm), key("ratio", grading.ratio)},
          "{\"at_mm\": [x, y], \"ratio\": ...}, both given"};
}

static KeyTable table(Slivers& slivers) {
  return {{key("aspect", slivers.aspect), whole("count", slivers.count, 1, most)},
          "{\"aspect\": ..., \"count\": ...}, both given"};
}

static KeyTable table(MeshTransform& mesh) {
  return {
      {whole("refine", mesh.refine, 0, max_refinements), key("grade", mesh.grade),
       key("slivers", mesh.slivers), positive("scale", mesh.scale), key("stretch", mesh.stretch),
       key("move_mm", mesh.move_mm), whole("keep_contact_edges", mesh.keep_contact_edges, 0, most),
       whole("keep_displacement_edges", mesh.keep_displacement_edges, 1, most),
       whole("keep_force_edges", mesh.keep_force_edges, 0, most), key("polygon", mesh.polygon)}};
}
static void put(JsonSlot& slot, const MeshTransform& mesh) { slot.json = changes(mesh); }

template <typename Item>
static JsonKey list(const char* name, std::vector<Item>& items, const Item& preset,
                    const char* allowed) {
  const auto take = [&items, preset, allowed](const JsonValue& value) {
    if (!value.json.is_array() || value.json.empty()) value.fail(allowed);
    items.assign(value.json.size(), preset);
    for (std::size_t k = 0; k < items.size(); ++k) read(value.item(k), items[k]);
  };
  const auto give = [&items] {
    return items.empty() ? Json(Json::value_t::discarded) : json_list(items);
  };
  return {.name = name, .take = take, .give = give};
}

static KeyTable table(ContactPair& pair) {
  auto& between = pair.between;
  const auto take = [&between](const JsonValue& both) {
    if (!both.json.is_array() || both.json.size() != 2)
      both.fail("two groups, or lists of them: [\"contact:a\", \"contact:b\"]");
    for (std::size_t side = 0; side < 2; ++side) {
      const JsonValue groups = both.item(side);
      std::vector<std::string>& labels = between[side];
      if (groups.json.is_array() && !groups.json.empty()) {
        labels.resize(groups.json.size());
        for (std::size_t k = 0; k < labels.size(); ++k) read(groups.item(k), labels[k]);
      } else {
        read(groups, labels.emplace_back());
      }
    }
  };
  const auto give = [&between] {
    Json both = Json::array();
    for (const std::vector<std::string>& labels : between)
      both.push_back(labels.size() == 1 ? Json(labels.front()) : Json(labels));
    return both;
  };
  using enum ContactPair::Law;
  return {{required({.name = "between", .take = take, .give = give}),
           key("friction", pair.friction), key("clearance_mm", pair.clearance_mm),
           choice("law", pair.law, {{"contact", contact}, {"bonded", bonded}})}};
}

static JsonKey pairs(const char* name, std::vector<ContactPair>& contacts) {
  return list(name, contacts, ContactPair(), "a list of pairs {\"between\": [..., ...]}");
}

static std::vector<JsonKey> layer_keys(Scene& scene) {
  Layers& layers = scene.layers;
  return {key("normal", layers.normal), whole("count", layers.count, 1, max_layers),
          list("interfaces_mm", layers.interfaces_mm, 0., "a list of numbers, ascending"),
          list("materials", scene.layer_materials, scene.material, "a list of materials")};
}

static JsonKey layers_key(Scene& scene) {
  const auto take = [&scene](const JsonValue& value) {
    value.object(layer_keys(scene));
    if (value.json.contains("count") == value.json.contains("interfaces_mm"))
      value.fail("either count or interfaces_mm");
  };
  const auto give = [&scene] {
    Scene preset;
    return changes(layer_keys(scene), layer_keys(preset));
  };
  return {.name = "layers", .take = take, .give = give};
}

static KeyTable table(LoadStep& step) {
  return {{key("displacement_mm", step.displacement_mm),
           key("body_force_N_per_mm3", step.body_force_N_per_mm3),
           key("clearance_mm", step.clearance_mm), key("temperature_K", step.temperature_K),
           key("boundary", step.boundary), pairs("contacts", step.contacts)}};
}

static JsonKey load_steps_key(Scene& scene) {
  const auto take = [&scene](const JsonValue& value) {
    const Json& json = value.json;
    if (json.is_number_integer() && json >= 1 && json <= max_load_steps) {
      scene.equal_steps = json.get<int>();
      return;
    }
    if (!json.is_array() || json.empty() || json.size() >= max_load_steps)
      value.fail(fmt::format("a whole number from 1 to {}, or a list of 1 to {} steps",
                             max_load_steps, max_load_steps - 1));
    scene.later_steps.resize(json.size());
    for (std::size_t k = 0; k < json.size(); ++k)
      read(value.at(std::to_string(k + 1), json[k]), scene.later_steps[k]);
  };
  const auto give = [&scene] {
    return scene.later_steps.empty() ? Json(scene.equal_steps) : json_list(scene.later_steps);
  };
  return {.name = "load_steps", .take = take, .give = give};
}

static JsonKey crown_key(std::optional<double>& radius_mm) {
  const auto take = [&radius_mm](const JsonValue& value) {
    radius_mm.reset();
    if (!value.json.is_null()) read(value, radius_mm);
  };
  const auto give = [&radius_mm] { return or_null(radius_mm); };
  return {.name = "crown_radius_mm", .take = take, .give = give};
}

static JsonKey materials_key(Scene& scene) {
  const auto take = [&scene](const JsonValue& value) {
    value.each("an object with a body's name as each key",
               [&](const std::string& body, const JsonValue& of_body) {
                 read(of_body, scene.materials[body] = scene.material);
               });
  };
  return {.name = "materials", .take = take, .give = [&scene] { return written(scene.materials); }};
}

static JsonKey roles_key(std::vector<std::pair<std::string, std::string>>& roles) {
  const auto take = [&roles](const JsonValue& value) {
    value.each("an object with a curve's name or number, numbers \"1-4\", or \"rest\" as each key",
               [&](const std::string& curves, const JsonValue& role) {
                 const std::string label =
                     role.json.is_string() ? role.json.get<std::string>() : std::string();
                 if (!parse_boundary_label(label)) role.fail(std::string(boundary_labels_allowed));
                 roles.emplace_back(curves, label);
               });
  };
  const auto give = [&roles] {
    Json of_curves = Json::object();
    for (const auto& [curves, label] : roles) of_curves[curves] = label;
    return of_curves;
  };
  return {.name = "roles", .take = take, .give = give};
}

static JsonKey length_unit_key(std::string& unit) {
  const auto take = [&unit](const JsonValue& value) {
    constexpr std::array<std::string_view, 3> units = {"mm", "m", "inch"};
    unit = value.one_of(units, {}, ", of a model's lengths");
  };
  return {.name = "length_unit", .take = take, .give = [&unit] { return written(unit); }};
}

static KeyTable table(SceneFile& file) {
  Scene& scene = file.scene;
  Material& material = scene.material;
  // Keys from which others take their defaults come first.
  return {{whole("teeth", scene.teeth, 1, most),
           positive("root_half_height_mm", scene.root_half_height_mm),
           positive("length_mm", scene.length_mm),
           positive("tip_half_height_mm", scene.tip_half_height_mm),
           length_unit_key(file.length_unit),
           roles_key(file.roles),
           choice("plane", scene.plane, {{"strain", Plane::strain}, {"stress", Plane::stress}}),
           key("young_MPa", material.young_MPa),
           key("poisson", material.poisson),
           key("expansion_per_K", material.expansion_per_K),
           materials_key(scene),
           key("friction", scene.friction),
           crown_key(scene.crown_radius_mm),
           curve_key("wall", scene.wall, Curve::obstacle),
           curve_key("face", scene.face, Curve::face),
           key("clearance_mm", scene.clearance_mm),
           key("displacement_mm", scene.displacement_mm),
           key("body_force_N_per_mm3", scene.body_force_N_per_mm3),
           key("temperature_K", scene.temperature_K),
           key("boundary", scene.boundary),
           list("point_supports", scene.point_supports, PointSupport(),
                "a list of points {\"at_mm\": [x, y], \"displacement_mm\": [..., ...]}"),
           pairs("contacts", scene.contacts),
           load_steps_key(scene),
           key("mesh", scene.mesh),
           layers_key(scene),
           key("group", scene.group),
           key("about", scene.about)}};
}

void read_keys(const JsonValue& value, SceneFile& file) { value.object(table(file).keys); }

Json scene_json(SceneFile file) {
  std::vector<JsonKey> keys = table(file).keys;
  std::erase_if(keys, [&](const JsonKey& key) { return !file.keys.contains(key.name); });
  return written(keys);
}

}  // namespace airybench
