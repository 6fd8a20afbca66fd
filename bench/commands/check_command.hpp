// What `bench` does for the author of an external program, instead of a run.
#pragma once

#include "bench/plan/options.hpp"

namespace airybench {

// --check=mine.json: small cases that each find one mistake. The exit code is 0 if all pass.
int check_external(Options options);
// --new-external=mine: writes mine.py and mine.json.
int new_external(const std::filesystem::path& name);

}  // namespace airybench
