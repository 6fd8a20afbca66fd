#include "bench/commands/posed_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <iterator>

#include "bench/plan/mesh_files.hpp"
#include "bench/plan/scene_file.hpp"
#include "bench/plan/stages.hpp"
#include "bench/problems/problem_files.hpp"
#include "bench/run/adapted_scenes.hpp"
#include "support/errors.hpp"
#include "support/sha256.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

void note_out_of_reach(const PosedScene& posed) {
  const Mesh& mesh = posed.body()->mesh;
  if (const int free = edges_out_of_reach(*posed.body()); free > 0)
    std::cerr << fmt::format("note: {}/{}: {} of {} contact edges meet no wall, and are free\n",
                             mesh.name, posed.scene_name, free,
                             free + mesh_sizes(mesh).contact_edges);
}

}  // namespace

std::vector<PosedScene> pose_all(const Options& options) {
  std::vector<SceneFile> scenes;
  for (const auto& file : options.scenes.empty() ? scenes_of(options.study) : options.scenes) {
    scenes.push_back(read_scene_file(file));
    const Scene& last = scenes.back().scene;
    for (std::size_t i = 0; i + 1 < scenes.size(); ++i)
      if (const Scene& other = scenes[i].scene; other.name == last.name)
        throw UsageError(fmt::format("--scene: two scenes are named {}: {} and {}", last.name,
                                     other.source, last.source));
  }
  if (scenes.empty()) scenes.emplace_back();
  std::vector<PosedScene> posed;
  const std::vector<MeshFile> files =
      read_meshes({options.meshes, options.model_settings, options.out});
  for (const MeshFile& file : files)
    for (const SceneFile& given : scenes) {
      const auto& [scene, definition] = is_of_catalogue(file.path) ? given : on_other_bodies(given);
      posed.push_back({scene.name, scene.group, recorded_path(file.path, options.out), file.sha256,
                       definition, std::make_shared<const Problem>(pose(scene, file.mesh))});
      note_out_of_reach(posed.back());
    }
  if (!options.dry_run && !options.explain) keep_models(files);
  return posed;
}

std::vector<PosedScene> pose_problems(const Options& options) {
  std::vector<PosedScene> posed;
  for (const std::filesystem::path& file : options.problems) {
    const std::string name = file.stem().string();
    const auto same = [&](const PosedScene& p) { return mesh_name_of(p.problem) == name; };
    if (!is_name(name) || std::ranges::any_of(posed, same))
      throw UsageError(
          fmt::format("--problem: {} (allowed: file names that differ, in UTF-8 without "
                      "control characters)",
                      shortened(file.string())));
    auto problem = std::make_shared<const contact::Problem>(read_contact_problem(file));
    posed.push_back({"fclib", "", recorded_path(file, options.out), sha256_of_file(file), "{}",
                     std::move(problem)});
  }
  return posed;
}

std::vector<PosedScene> pose_and_adapt(const Options& options, std::vector<std::string>& short_of) {
  std::vector<PosedScene> posed = pose_all(options);
  if (options.adapt.empty()) return posed;
  std::vector<PosedScene> levels;
  for (const PosedScene& start : posed) {
    AdaptedScenes adapted = adapted_scenes(start, options);
    std::ranges::move(adapted.levels, std::back_inserter(levels));
    if (!adapted.why_not_reached.empty()) short_of.push_back(adapted.why_not_reached);
  }
  return levels;
}

}  // namespace airybench
