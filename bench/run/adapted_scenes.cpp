#include "bench/run/adapted_scenes.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <limits>
#include <set>

#include "bench/measure/environment.hpp"
#include "bench/measure/heap_probe.hpp"
#include "bench/plan/mesh_files.hpp"
#include "bench/records/json.hpp"
#include "bench/records/summary.hpp"
#include "bench/run/adaptive_loop.hpp"
#include "bench/run/isolated_scene.hpp"
#include "mesh/msh_format.hpp"
#include "mesh/quality.hpp"
#include "mesh/refinement.hpp"
#include "support/atomic_file.hpp"
#include "support/errors.hpp"
#include "support/process.hpp"
#include "support/seconds_since.hpp"
#include "support/sha256.hpp"
#include "support/shortened.hpp"
#include "support/sign_of_life.hpp"
#include "support/text_table.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

// Contact groups of which every edge became free, as it faces nothing, are none of the mesh's.
void forget_groups(const std::set<std::string>& of_mesh, BoundaryConditions& boundary,
                   std::vector<ContactPair>& contacts) {
  const auto is_gone = [&](const std::string& label) { return !of_mesh.contains(label); };
  std::erase_if(boundary, [&](const auto& of_group) { return is_gone(of_group.first); });
  for (ContactPair& pair : contacts)
    for (std::vector<std::string>& labels : pair.between)
      if (labels.size() > 1) std::erase_if(labels, is_gone);
}

// What records that stay refer to is not replaced.
void write_for_records(const std::filesystem::path& file, const std::string& text,
                       const Output& output) {
  if (std::error_code error; (output.append || output.resume) &&
                             std::filesystem::exists(file, error) &&
                             sha256_of_file(file) != sha256_hex(text))
    throw InputError(
        fmt::format("{}: the records of that folder have another file of this name "
                    "(allowed: the goal and scene that made it, or another --out)",
                    file.string()));
  write_file_atomically(file, text);
}

// MESH+adapt3, for stresses of degree 2 MESH+adapt3k2: runs of several degrees can be joined.
Json answer_for(AdaptiveLevel& level, const Options& options, int degree,
                const std::string& mesh_name, const std::filesystem::path& folder) {
  level.mesh.name =
      fmt::format("{}+{}{}{}", mesh_name, options.run.adapt.marking == 1. ? "refined" : "adapt",
                  level.number, degree > 1 ? fmt::format("k{}", degree) : "");
  const std::filesystem::path file = folder / (level.mesh.name + ".msh");
  write_for_records(file, msh_text(level.mesh), options.output);
  return {{"file", file.string()},
          {"number", level.number},
          {"unknowns", level.unknowns},
          {"error", or_null(level.error)},
          {"reaches", level.goal.has_value()},
          {"angle", mesh_quality(level.mesh).smallest_angle_deg},
          {"goal", level.goal ? or_null(level.goal->error) : Json()},
          {"time_s", level.time_s}};
}

void serve_loop(Channel& channel, const Scene& scene, const Mesh& mesh, const Options& options,
                const std::filesystem::path& folder) {
  tell_refused_memory_at_exit();
  // A level takes the memory of the one before: pages that are given back would be cleared anew.
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  set_threads(options.run.cases.threads);
  const heap::Backstop backstop(options.limits.memory_limit_bytes);
  const Method method = adapting_method(options.run.adapt.by);
  AdaptiveLoop loop(
      scene, mesh, method,
      {options.run.adapt.goals, options.run.adapt.marking, options.run.adapt.stress_error,
       options.limits.timeout_s, options.limits.memory_limit_bytes, options.run.cases.threads});
  while (channel.receive()) {
    Json answer = Json::object();
    try {
      if (auto level = loop.next())
        answer = answer_for(*level, options, method.degree, mesh.name, folder);
      answer["reached"] = loop.reached();
      answer["ended"] = loop.why_ended();
    } catch (const InputError& error) {
      answer = {{"refused", error.what()}};
    }
    channel.send(json_text(answer));
  }
}

constexpr double grace_s = 60;  // beyond the solve: posing, judging and bisecting
constexpr int max_restarts = 3;

std::string obituary(const ChildEnd& end) {
  if (end.timed_out) return "a level took longer than --timeout";
  if (end.exit_code == heap::backstop_exit_code) return "it passed the memory limit";
  return "its process " + how_it_ended(end, grace_s);
}

PosedScene posed_level(const Json& said, const Scene& scene, const std::string& definition,
                       const PosedScene& start, const Options& options) {
  MeshFile file = read_mesh_file(said.at("file").get<std::string>());
  const Json& goal = said.at("goal");
  return {
      .scene_name = start.scene_name,
      .scene_group = start.scene_group,
      .mesh_file = recorded_path(file.path, options.output.folder),
      .mesh_sha256 = file.sha256,
      .scene_definition = definition,
      .problem = pose_in_time(scene, start.scene_name, std::move(file.mesh), options.limits),
      .adapted = AdaptedMesh{said.at("number"), said.at("time_s"),
                             goal.is_null() ? std::nullopt : std::optional(goal.get<double>())}};
}

void print(const Json& said, const std::string& name) {
  const Json& part = said["error"];
  const std::string error =
      part.is_null() ? "?" : fmt::format("{:.3g} %", 100 * part.get<double>());
  std::cerr << fmt::format(
      "adapt {}: level {}, n_phi {}, total error {}, smallest angle {:.1f}°, {}\n", name,
      said["number"].get<int>(), said["unknowns"].get<int>(), error, said["angle"].get<double>(),
      show_seconds(said["time_s"].get<double>()));
  was_heard();
}

}  // namespace

Method adapting_method(const std::string& name) {
  const auto is_fit = [](const Method& method) {
    return method.unknowns == Unknowns::edge_displacements;
  };
  std::string allowed;
  for (const Method& method : methods()) {
    if (!is_fit(method)) continue;
    if (method.name == name) return method;
    allowed += method.name + ", ";
  }
  if (is_general_name(name))
    if (const Method method = select_methods(name).front(); is_fit(method)) return method;
  allowed += hybrid_of_degree(2) + " and more";
  throw UsageError(fmt::format("--adapt: by={} (allowed: {})", shortened(name), allowed));
}

SceneFile scene_of_level_0(const PosedScene& start) {
  const Mesh& mesh = start.body()->mesh;
  SceneFile file = scene_file_of(start.scene_definition, mesh.name + "/" + start.scene_name);
  Scene& scene = file.scene;
  for (std::size_t k = 0; k < mesh.body_names.size() && !scene.layer_materials.empty(); ++k)
    scene.materials.try_emplace(mesh.body_names[k],
                                scene.layer_materials[k % scene.layer_materials.size()]);
  scene.mesh = {};
  scene.mesh.polygon = mesh.is_polygon;
  scene.layers = {};
  scene.layer_materials.clear();
  file.roles.clear();
  file.length_unit = "mm";
  for (const char* key : {"layers", "roles", "length_unit", "mesh"}) file.keys.erase(key);
  file.keys.insert("materials");
  if (mesh.is_polygon) file.keys.insert("mesh");
  if (!scene.wall) file.keys.insert("crown_radius_mm");  // other bodies have no default
  std::set<std::string> groups;
  for (const BoundaryEdge& edge : mesh.boundary) groups.insert(boundary_label(mesh, edge));
  std::erase_if(scene.contacts, &ContactPair::is_bonded);
  if (scene.contacts.empty()) file.keys.erase("contacts");
  forget_groups(groups, scene.boundary, scene.contacts);
  for (LoadStep& step : scene.later_steps) forget_groups(groups, step.boundary, step.contacts);
  return file;
}

PosedScene refined_scene(const PosedScene& level_0, const Options& options) {
  const std::filesystem::path& out = options.output.folder;
  PosedScene refined = level_0;
  refined.adapted.reset();
  Mesh mesh = uniformly_refined(level_0.body()->mesh);
  mesh.name = mesh.name.substr(0, mesh.name.rfind('+')) + "+refine1";
  const std::filesystem::path file = out / "meshes" / level_0.scene_name / (mesh.name + ".msh");
  write_file_atomically(file, msh_text(mesh));
  refined.mesh_file = recorded_path(file, out);
  refined.mesh_sha256 = sha256_of_file(file);
  const Scene scene = scene_of(level_0.scene_definition, mesh.name);
  refined.problem = pose_in_time(scene, level_0.scene_name, std::move(mesh), options.limits);
  return refined;
}

AdaptedScenes adapted_scenes(const PosedScene& start, const Options& options) {
  adapting_method(options.run.adapt.by);  // a usage error here, not in the loop's process
  const Mesh& mesh = start.body()->mesh;
  const std::string name = mesh.name + "/" + start.scene_name;
  const SceneFile on_mesh = scene_of_level_0(start);
  const std::string definition = on_mesh.definition();
  const std::filesystem::path folder = options.output.folder / "meshes" / start.scene_name;
  const std::filesystem::path scene_file = folder / mesh.name / (start.scene_name + ".json");
  make_folder(scene_file.parent_path());
  write_for_records(scene_file, definition + "\n", options.output);
  Scene scene = on_mesh.scene;
  scene.source = scene_file.string();

  AdaptedScenes result;
  std::vector<Json> levels;
  std::optional<ChildProcess> process;
  int restarts = 0;
  for (bool goes_on = true; goes_on;) {
    if (!process)
      process.emplace([&](Channel& channel) { serve_loop(channel, scene, mesh, options, folder); });
    double left_s = 1.1 * options.limits.timeout_s + grace_s;
    const auto asked = std::chrono::steady_clock::now();
    const std::optional<std::string> answer = process->ask("next", [&](double suspended_s) {
      throw_if_interrupted();
      left_s += suspended_s;
      sign_of_life([&] {
        return fmt::format("... adapt {}: level {}, for {}", name, levels.size(),
                           show_duration(seconds_since(asked)));
      });
      return seconds_since(asked) > left_s;
    });
    if (process->was_suspended() && restarts++ < max_restarts) {
      process.reset();  // the loop has timed its levels, and may have ended for lack of time
      levels.clear();
      continue;
    }
    const Json said = answer ? parse_json(*answer) : Json{{"ended", obituary(process->end())}};
    if (said.contains("refused")) throw UsageError(said["refused"].get<std::string>());
    if (said.contains("file")) {
      levels.push_back(said);
      print(said, name);
    }
    result.why_not_reached = said.value("ended", "");
    goes_on = !said.value("reached", false) && result.why_not_reached.empty();
  }
  if (options.run.adapt.goals_only && !levels.empty()) {
    levels.back()["reaches"] = true;  // the last level, even if it misses the goal
    std::erase_if(levels, [](const Json& said) { return !said.at("reaches").get<bool>(); });
  }
  for (const Json& said : levels)
    result.levels.push_back(posed_level(said, scene, definition, start, options));
  if (!result.why_not_reached.empty())
    result.why_not_reached =
        fmt::format("goal {}: not reached for {}: {}", text_of(options.run.adapt.goals), name,
                    result.why_not_reached);
  return result;
}

}  // namespace airybench
