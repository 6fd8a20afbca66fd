// Which stages a case needs, and which are left out and why.
#pragma once

#include <string>
#include <vector>

#include "assembly/problem.hpp"
#include "solvers/methods.hpp"

namespace airybench {

struct StageDecision {
  std::string stage;
  bool run;
  std::string reason;  // why it is left out; empty when it is run
};

// The sizes that a problem is solved with: without friction the tangential contact rows count in
// n_f.
MeshSizes solved_sizes(const Problem& problem);

// Contact edges that could not meet their wall, and are free (assembly/contact_conditions.hpp).
int edges_out_of_reach(const Problem& problem);

// Why a method is not run on a problem, with those that are; empty: it is.
std::string why_skipped(const Problem& problem, const Method& method);

// From the problem alone, before anything is computed.
std::vector<StageDecision> decide_stages(const Problem& problem, const Method& method,
                                         bool fields_asked);

}  // namespace airybench
