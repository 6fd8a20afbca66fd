#include "bench/plan/scene_file.hpp"

#include <set>
#include <vector>

#include "bench/plan/scene_boundary.hpp"
#include "bench/plan/scene_reader.hpp"
#include "bench/plan/scene_wall.hpp"
#include "bench/records/case_name.hpp"
#include "support/file_text.hpp"

namespace airybench {
namespace {

constexpr int most = 1'000'000;  // of things that are counted

Material read_material(const SceneReader& reader, const std::string& prefix, const Json& json,
                       Material material) {
  reader.object(
      prefix, json,
      {{"young_MPa",
        [&](const auto& k, const Json& v) { material.young_MPa = reader.number(k, v); }},
       {"poisson", [&](const auto& k, const Json& v) { material.poisson = reader.number(k, v); }}});
  return material;
}

void read_materials(const SceneReader& reader, const std::string& key, const Json& json,
                    Scene& scene) {
  if (!json.is_object()) reader.fail(key, json, "an object with a body's name as each key");
  for (const auto& [body, value] : json.items())
    scene.materials[body] = read_material(reader, key + ": " + body + ": ", value, scene.material);
}

// The keys that `needed` lists must be there.
void require(const SceneReader& reader, const std::string& key, const Json& json,
             const std::vector<const char*>& needed, const char* allowed) {
  for (const char* name : needed)
    if (!json.contains(name)) reader.fail(key, json, allowed);
}

MeshTransform read_mesh(const SceneReader& reader, const std::string& key, const Json& json) {
  MeshTransform mesh;
  const auto kept = [&](std::optional<int>& target, int least) {
    return [&, least](const std::string& k, const Json& v) {
      target = reader.whole(k, v, least, most);
    };
  };
  const auto grade = [&](const std::string& k, const Json& v) {
    Grading& grading = mesh.grade.emplace();
    reader.object(k + ": ", v,
                  {{"at_mm", [&](const auto& name,
                                 const Json& x) { grading.at_mm = reader.vector(name, x); }},
                   {"ratio", [&](const auto& name, const Json& x) {
                      grading.ratio = reader.number(name, x);
                    }}});
    require(reader, k, v, {"at_mm", "ratio"}, "{\"at_mm\": [x, y], \"ratio\": ...}, both given");
  };
  const auto slivers = [&](const std::string& k, const Json& v) {
    Slivers& given = mesh.slivers.emplace();
    reader.object(k + ": ", v,
                  {{"aspect", [&](const auto& name,
                                  const Json& x) { given.aspect = reader.number(name, x); }},
                   {"count", [&](const auto& name, const Json& x) {
                      given.count = reader.whole(name, x, 1, most);
                    }}});
    require(reader, k, v, {"aspect", "count"}, "{\"aspect\": ..., \"count\": ...}, both given");
  };
  reader.object(
      key + ": ", json,
      {{"refine", [&](const auto& k,
                      const Json& v) { mesh.refine = reader.whole(k, v, 0, most_refinements); }},
       {"grade", grade},
       {"slivers", slivers},
       {"scale", [&](const auto& k, const Json& v) { mesh.scale = reader.positive(k, v); }},
       {"stretch", [&](const auto& k, const Json& v) { mesh.stretch = reader.vector(k, v); }},
       {"move_mm", [&](const auto& k, const Json& v) { mesh.move_mm = reader.vector(k, v); }},
       {"keep_contact_edges", kept(mesh.keep_contact_edges, 0)},
       {"keep_displacement_edges", kept(mesh.keep_displacement_edges, 1)},
       {"keep_force_edges", kept(mesh.keep_force_edges, 0)}});
  return mesh;
}

void read_layers(const SceneReader& reader, const std::string& key, const Json& json,
                 Scene& scene) {
  Layers& layers = scene.layers;
  reader.object(
      key + ": ", json,
      {{"normal", [&](const auto& k, const Json& v) { layers.normal = reader.vector(k, v); }},
       {"count",
        [&](const auto& k, const Json& v) { layers.count = reader.whole(k, v, 1, most_layers); }},
       {"interfaces_mm",
        [&](const auto& k, const Json& v) {
          if (!v.is_array() || v.empty()) reader.fail(k, v, "a list of numbers, ascending");
          for (const Json& d : v) layers.interfaces_mm.push_back(reader.number(k, d));
        }},
       {"materials", [&](const auto& k, const Json& v) {
          if (!v.is_array() || v.empty()) reader.fail(k, v, "a list of materials");
          for (const Json& material : v)
            scene.layer_materials.push_back(
                read_material(reader, k + ": ", material, scene.material));
        }}});
  if (json.contains("count") == json.contains("interfaces_mm"))
    reader.fail(key, json, "either count or interfaces_mm");
}

LoadStep read_load_step(const SceneReader& reader, const std::string& prefix, const Json& json) {
  LoadStep step;
  const auto vector = [&](std::optional<Eigen::Vector2d>& target) {
    return [&](const std::string& k, const Json& v) { target = reader.vector(k, v); };
  };
  reader.object(prefix, json,
                {{"displacement_mm", vector(step.displacement_mm)},
                 {"body_force_N_per_mm3", vector(step.body_force_N_per_mm3)},
                 {"clearance_mm",
                  [&](const auto& k, const Json& v) { step.clearance_mm = reader.number(k, v); }},
                 {"boundary", [&](const auto& k, const Json& v) {
                    step.boundary = read_boundary(reader, k, v);
                  }}});
  return step;
}

void read_load_steps(const SceneReader& reader, const std::string& key, const Json& json,
                     Scene& scene) {
  if (json.is_number_integer() && json >= 1 && json <= most_load_steps) {
    scene.equal_steps = json.get<int>();
    return;
  }
  if (!json.is_array() || json.empty() || json.size() >= most_load_steps)
    reader.fail(key, json,
                fmt::format("a whole number from 1 to {}, or a list of 1 to {} steps",
                            most_load_steps, most_load_steps - 1)
                    .c_str());
  for (const Json& step : json)
    scene.later_steps.push_back(
        read_load_step(reader, fmt::format("{}: {}: ", key, scene.later_steps.size() + 1), step));
}

Scene from_json(const Json& json, const std::string& file) {
  const SceneReader reader(file);
  Scene scene;
  scene.source = file;
  Json materials, layers;
  const auto optional_length = [&](std::optional<double>& target) {
    return [&](const std::string& k, const Json& v) { target = reader.positive(k, v); };
  };
  const auto number = [&](double& target) {
    return [&](const std::string& k, const Json& v) { target = reader.number(k, v); };
  };
  const auto vector = [&](Eigen::Vector2d& target) {
    return [&](const std::string& k, const Json& v) { target = reader.vector(k, v); };
  };
  const auto text = [&](std::string& target) {
    return [&](const std::string& k, const Json& v) { target = reader.text(k, v); };
  };
  reader.object(
      "", json,
      {{"teeth", [&](const auto& k, const Json& v) { scene.teeth = reader.whole(k, v, 1, most); }},
       {"root_half_height_mm", optional_length(scene.root_half_height_mm)},
       {"length_mm", optional_length(scene.length_mm)},
       {"tip_half_height_mm", optional_length(scene.tip_half_height_mm)},
       {"young_MPa", number(scene.material.young_MPa)},
       {"poisson", number(scene.material.poisson)},
       {"plane",
        [&](const auto& k, const Json& v) {
          if (v != "strain" && v != "stress") reader.fail(k, v, "\"strain\" or \"stress\"");
          scene.plane = v == "strain" ? Plane::strain : Plane::stress;
        }},
       {"friction", number(scene.friction)},
       {"crown_radius_mm",
        [&](const auto& k, const Json& v) {
          if (v.is_null())
            scene.crown_radius_mm.reset();
          else
            scene.crown_radius_mm = reader.number(k, v);
        }},
       {"wall", set_wall(reader, scene.wall, Curve::wall)},
       {"face", set_wall(reader, scene.face, Curve::face)},
       {"clearance_mm", number(scene.clearance_mm)},
       {"displacement_mm", vector(scene.displacement_mm)},
       {"body_force_N_per_mm3", vector(scene.body_force_N_per_mm3)},
       {"load_steps", [&](const auto& k, const Json& v) { read_load_steps(reader, k, v, scene); }},
       {"materials", [&](const auto&, const Json& v) { materials = v; }},
       {"boundary",
        [&](const auto& k, const Json& v) { scene.boundary = read_boundary(reader, k, v); }},
       {"mesh", [&](const auto& k, const Json& v) { scene.mesh = read_mesh(reader, k, v); }},
       {"layers", [&](const auto&, const Json& v) { layers = v; }},
       {"group", text(scene.group)},
       {"about", text(scene.about)}});
  // A missing value is the scene's own, wherever that stands in the file.
  if (!materials.is_null()) read_materials(reader, "materials", materials, scene);
  if (!layers.is_null()) read_layers(reader, "layers", layers, scene);
  return scene;
}

Json json_of(const std::string& text, const std::string& place) {
  constexpr std::size_t most_keys = 1000;
  // JSON allows a key to be repeated; a scene does not.
  std::vector<std::set<std::string>> keys;
  const auto watch = [&](int depth, Json::parse_event_t event, Json& value) {
    if (depth > 8) throw SceneError(place + ": nested more than 8 deep");
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && keys.back().size() == most_keys)
      throw SceneError(fmt::format("{}: more than {} keys in one object", place, most_keys));
    if (event == Json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second)
      throw SceneError(place + ": " + shortened(value.get<std::string>()) + ": given twice");
    return true;
  };
  if (text.find('\0') != text.npos)  // which would end the text for the parser
    throw SceneError(place + ": not JSON: a zero byte");
  try {
    return Json::parse(text, watch);
  } catch (const Json::exception& wrong) {
    throw SceneError(place + ": not JSON: " + without_prefix(wrong));
  }
}

Scene checked_scene(const Json& json, const std::string& place) {
  Scene scene = from_json(json, place);
  if (json.contains("wall") && json.contains("crown_radius_mm"))
    throw SceneError(place + ": wall and crown_radius_mm (allowed: one of them)");
  check_values(scene);
  return scene;
}

}  // namespace

Scene scene_of(const std::string& text, const std::string& place) {
  return checked_scene(json_of(text, place), place);
}

SceneFile read_scene_file(const std::filesystem::path& file) {
  const std::string name = file.stem().string();
  if (!is_name(name))
    throw SceneError(shortened(file.string()) +
                     ": a scene is named as its file (allowed: UTF-8 without "
                     "control characters)");
  std::string text;
  try {
    text = file_text(file);
  } catch (const FileError& error) {
    throw SceneError(error.what());
  }
  Json json = json_of(text, file.string());
  inline_polylines(json, file);
  Scene scene = checked_scene(json, file.string());
  scene.name = name;
  return {std::move(scene), json_text(json)};
}

Scene read_scene(const std::filesystem::path& file) { return read_scene_file(file).scene; }

SceneFile on_other_bodies(SceneFile file) {
  Json json = parse_json(file.definition);
  if (json.contains("crown_radius_mm") || json.contains("wall")) return file;
  file.scene.crown_radius_mm.reset();
  json["crown_radius_mm"] = nullptr;
  file.definition = json_text(json);
  return file;
}

}  // namespace airybench
