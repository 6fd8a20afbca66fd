#include "bench/commands/posed_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "bench/adapting/adapted_scenes.hpp"
#include "bench/cases/mesh_files.hpp"
#include "bench/cases/scene_file.hpp"
#include "bench/records/json.hpp"
#include "support/errors.hpp"
#include "support/file_text.hpp"

namespace airybench {
namespace {

// The scene file as it is, on a line.
std::string definition_of(const Scene& scene) {
  if (scene.source == Scene().source) return "{}";
  return json_text(parse_json(file_text(scene.source)));
}

}  // namespace

std::vector<PosedScene> pose_all(const Options& options) {
  std::vector<Scene> scenes;
  for (const auto& file : options.scenes.empty() ? scenes_of(options.study) : options.scenes) {
    scenes.push_back(read_scene(file));
    for (std::size_t i = 0; i + 1 < scenes.size(); ++i)
      if (scenes[i].name == scenes.back().name)
        throw UsageError(fmt::format("--scene: two scenes are named {}: {} and {}", scenes[i].name,
                                     scenes[i].source, scenes.back().source));
  }
  if (scenes.empty()) scenes.emplace_back();
  std::vector<PosedScene> posed;
  const std::vector<MeshFile> files =
      read_meshes({options.meshes, options.model_settings, options.out});
  for (const MeshFile& file : files)
    for (const Scene& scene : scenes)
      posed.push_back({scene.name, scene.group, recorded_path(file.path, options.out), file.sha256,
                       definition_of(scene),
                       std::make_shared<const Problem>(pose(scene, file.mesh))});
  if (!options.dry_run && !options.explain) keep_models(files);
  return posed;
}

std::vector<PosedScene> pose_and_adapt(const Options& options, std::vector<std::string>& short_of) {
  std::vector<PosedScene> posed = pose_all(options);
  if (options.adapt.empty()) return posed;
  std::vector<PosedScene> levels;
  for (const PosedScene& start : posed) {
    if (!start.problem->later_steps.empty())
      throw UsageError(fmt::format("--adapt: the scene {} (allowed: scenes without load_steps)",
                                   start.scene_name));
    AdaptedScenes adapted = adapted_scenes(start, options);
    std::ranges::move(adapted.levels, std::back_inserter(levels));
    if (!adapted.why_not_reached.empty()) short_of.push_back(adapted.why_not_reached);
  }
  return levels;
}

}  // namespace airybench
