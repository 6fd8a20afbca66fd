// Decides which stages a case needs, and says why the others are left out.
#pragma once

#include <string>
#include <vector>

#include "bench/plan/plan.hpp"
#include "solvers/methods.hpp"

namespace airybench {

struct StageDecision {
  std::string stage;
  bool run;
  std::string reason;  // empty if it is run
};

// The sizes of the system that is solved: without friction, tangential contact rows count in n_f,
// not in n_c; a roller edge adds two rows to n_f. Without a body n_c only.
MeshSizes solved_sizes(const PosedProblem& problem);

// Counts contact edges out of reach of their wall (assembly/problem/contact_conditions.hpp).
int edges_out_of_reach(const Problem& problem);

// Why a method cannot solve a problem, and which methods can. Empty if it can.
std::string why_skipped(const PosedProblem& problem, const Method& method);

std::vector<StageDecision> decide_stages(const PosedProblem& problem, const Method& method,
                                         bool fields_asked);

}  // namespace airybench
