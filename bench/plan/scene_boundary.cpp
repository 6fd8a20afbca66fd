#include "bench/plan/scene_boundary.hpp"

#include "bench/plan/scene_wall.hpp"

namespace airybench {
namespace {

// A constant, or {"at_mm": [[x, y], [x, y]], "values": [..., ...]}.
template <typename Value>
LinearValue<Value> read_linear(
    const SceneReader& reader, const std::string& key, const Json& json,
    const std::function<Value(const std::string& key, const Json& value)>& read) {
  LinearValue<Value> result;
  if (!json.is_object()) {
    result.values.fill(read(key, json));
    return result;
  }
  const auto two = [&](const std::string& k, const Json& v) {
    if (!v.is_array() || v.size() != 2) reader.fail(k, v, "a list of two");
  };
  reader.object(key + ": ", json,
                {{"at_mm",
                  [&](const auto& k, const Json& v) {
                    two(k, v);
                    for (std::size_t i = 0; i < 2; ++i) result.at_mm[i] = reader.vector(k, v[i]);
                  }},
                 {"values", [&](const auto& k, const Json& v) {
                    two(k, v);
                    for (std::size_t i = 0; i < 2; ++i) result.values[i] = read(k, v[i]);
                  }}});
  if (!json.contains("at_mm") || !json.contains("values"))
    reader.fail(key, json, "{\"at_mm\": [[x, y], [x, y]], \"values\": [..., ...]}, both given");
  return result;
}

BoundaryValues read_values(const SceneReader& reader, const std::string& key, const Json& json) {
  BoundaryValues values;
  const auto vector = [&](std::optional<LinearValue<Eigen::Vector2d>>& target) {
    return [&](const std::string& k, const Json& v) {
      target = read_linear<Eigen::Vector2d>(
          reader, k, v, [&](const auto& name, const Json& x) { return reader.vector(name, x); });
    };
  };
  const auto number = [&](std::optional<double>& target) {
    return [&](const std::string& k, const Json& v) { target = reader.number(k, v); };
  };
  reader.object(key + ": ", json,
                {{"traction_MPa", vector(values.traction_MPa)},
                 {"pressure_MPa",
                  [&](const std::string& k, const Json& v) {
                    values.pressure_MPa = read_linear<double>(
                        reader, k, v,
                        [&](const auto& name, const Json& x) { return reader.number(name, x); });
                  }},
                 {"displacement_mm", vector(values.displacement_mm)},
                 {"support",
                  [&](const std::string& k, const Json& v) {
                    if (v != "full" && v != "normal") reader.fail(k, v, "\"full\" or \"normal\"");
                    using enum BoundaryValues::Support;
                    values.support = v == "full" ? full : normal;
                  }},
                 {"friction", number(values.contact.friction)},
                 {"clearance_mm", number(values.contact.clearance_mm)},
                 {"wall", set_wall(reader, values.contact.wall, Curve::wall)},
                 {"face", set_wall(reader, values.contact.face, Curve::face)}});
  return values;
}

}  // namespace

BoundaryConditions read_boundary(const SceneReader& reader, const std::string& key,
                                 const Json& json) {
  BoundaryConditions conditions;
  if (!json.is_object()) reader.fail(key, json, "an object with a boundary group as each key");
  for (const auto& [label, values] : json.items())
    conditions[label] = read_values(reader, key + ": " + label, values);
  return conditions;
}

}  // namespace airybench
