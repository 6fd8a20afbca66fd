// Parts that the commands that run cases share.
#pragma once

#include <string>
#include <vector>

#include "bench/plan/options.hpp"
#include "bench/plan/plan.hpp"
#include "bench/report/prediction.hpp"
#include "bench/run/runner.hpp"

namespace airybench {

// Poses every mesh under every scene, or the contact problems of --problem in the scene "fclib".
// Writes converted meshes unless the command only plans. Throws UsageError and errors of reading.
std::vector<PosedScene> posed_scenes(const Options& options);
PosedScene one_posed_scene(const Options& options);  // throws UsageError unless there is one

// Of the paper's meshes, also adapted or refined: "Mesh0+adapt3".
bool is_named_after_catalogue(const std::string& mesh);

// Runs the shell command $AIRYBENCH_THEN with these options and the results folder as its last
// argument; notes a failure. False where there is no such command, or it fails.
bool draw_figures(const std::filesystem::path& out, const std::string& options = "");

// Draws the figures, if there are any. Then prints which picture of the last mesh outside the
// catalogue to open, or how to get one. has_fields: the run has written fields.
void end_run(const RunResult& result, const std::filesystem::path& out, bool has_fields);

}  // namespace airybench
