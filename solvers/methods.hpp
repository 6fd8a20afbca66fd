// The table of named methods: the only place that knows all of them.
//
// A new method is one file with a free function and one line in methods.cpp; it then appears in
// `bench --list`, the runs, the tests and the figures.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "assembly/dual_system.hpp"
#include "solvers/solution.hpp"

namespace airybench {

struct Method {
  std::string name;                 // "3STEPD:CHOLMOD"
  std::string summary;              // one line
  bool in_paper;                    // compared there; these are run by default
  Blocks blocks;                    // what it needs assembled
  std::vector<std::string> stages;  // in order, as StageTimes names them
  std::function<Solution(const DualSystem&, const RunControl&)> solve;
};

const std::vector<Method>& methods();

// The methods that a comma-separated list of names and globs selects, in the table's order. Throws
// std::invalid_argument: one line with the item that matches nothing and the valid names.
std::vector<Method> select_methods(std::string_view selection);

// Runs a method; exceptions become statuses: TimeoutReached, std::bad_alloc, Breakdown, any other
// std::exception (crashed). A success whose result is incomplete or not finite is a breakdown.
Solution run(const Method& method, const DualSystem& system, const RunControl& control);

}  // namespace airybench
