// Parts that the commands that run cases share.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/plan/options.hpp"
#include "bench/plan/plan.hpp"
#include "bench/plan/scene_file.hpp"
#include "bench/report/prediction.hpp"
#include "bench/run/runner.hpp"

namespace airybench {

// Of the run's files, of its deck, or the default scene. Throws UsageError, FileError.
std::vector<SceneFile> read_scenes(const RunSettings& run);

// Poses every mesh under every scene, or the contact problems of --problem in the scene "fclib".
// Writes converted meshes unless the command only plans. Throws UsageError and errors of reading.
std::vector<PosedScene> posed_scenes(const Options& options);
std::vector<PosedScene> posed_scenes(const Options& options, std::vector<SceneFile> scenes);
PosedScene one_posed_scene(const Options& options);  // throws UsageError unless there is one

// Of the paper's meshes, also adapted or refined: "Mesh0+adapt3".
bool is_named_after_catalogue(const std::string& mesh);

// ./run draws when this program has ended: $AIRYBENCH_TO_DRAW names a file, which gets the
// arguments of `./run figures`, each with a zero byte behind it.
bool is_drawn_by_caller();
// False where nobody draws, or the file cannot be written.
bool leave_to_draw(const std::filesystem::path& out, const std::vector<std::string>& options = {});

// Leaves figures to draw, if there are any. Prints which picture of the last mesh outside the
// catalogue to open, or how to get one. has_fields: the run has written fields.
void end_run(const RunResult& result, const std::filesystem::path& out, bool has_fields);

}  // namespace airybench
