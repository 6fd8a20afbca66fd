// What the commands that run cases have in common.
#pragma once

#include <string>
#include <vector>

#include "bench/plan/options.hpp"
#include "bench/plan/plan.hpp"
#include "bench/records/record.hpp"
#include "bench/report/prediction.hpp"

namespace airybench {

// The meshes and scenes of a command line, posed: every mesh under every scene, or the contact
// problems of --problem, each named as its file, in the scene "fclib". Keeps the meshes of models,
// unless the command only plans. Throws UsageError and what reading them throws.
std::vector<PosedScene> posed_scenes(const Options& options);
// Throws UsageError unless there is one.
PosedScene one_posed_scene(const Options& options);

RunLimits limits_of(const Options& options);

// A word as the shell reads it again: in quotation marks where it has more than letters, digits and
// what is nothing to the shell.
std::string shell_word(const std::string& word);

// Ends a run with a body of the user: runs the command of the shell that is in $AIRYBENCH_THEN,
// with the results folder as its last argument, whatever becomes of it; then a line names the
// picture to open, of the last mesh that is not of the catalogue, or says how to get one.
// has_fields: the run has written fields.
void end_run(const std::vector<Record>& records, const std::filesystem::path& out, bool has_fields);

}  // namespace airybench
