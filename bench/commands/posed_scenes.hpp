// The meshes and scenes of a command line, posed.
#pragma once

#include <string>
#include <vector>

#include "bench/plan/options.hpp"
#include "bench/plan/plan.hpp"

namespace airybench {

// Every mesh under every scene; a run keeps the meshes of models. Throws UsageError and what
// reading them throws.
std::vector<PosedScene> pose_all(const Options& options);

// The contact problems of --problem, each named as its file, in the scene "fclib". Throws
// UsageError, FileError.
std::vector<PosedScene> pose_problems(const Options& options);

// With --adapt the levels of each instead. short_of: goals that were not reached, a line each.
std::vector<PosedScene> pose_and_adapt(const Options& options, std::vector<std::string>& short_of);

}  // namespace airybench
