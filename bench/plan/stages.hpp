// Which stages a case needs, and which are left out and why.
#pragma once

#include <string>
#include <vector>

#include "bench/plan/plan.hpp"
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
MeshSizes solved_sizes(const contact::Problem& problem);  // n_c alone

// Contact edges that could not meet their wall, and are free (assembly/contact_conditions.hpp).
int edges_out_of_reach(const Problem& problem);

// Why a method is not run on a problem, with those that are; empty: it is.
std::string why_skipped(const Problem& problem, const Method& method);
std::string why_skipped(const contact::Problem& problem, const Method& method);

// From the problem alone, before anything is computed.
std::vector<StageDecision> decide_stages(const Problem& problem, const Method& method,
                                         bool fields_asked);
std::vector<StageDecision> decide_stages(const contact::Problem& problem, const Method& method,
                                         bool fields_asked);

// The same of whatever is posed.
inline MeshSizes solved_sizes(const PosedProblem& problem) {
  return std::visit([](const auto& own) { return solved_sizes(*own); }, problem);
}
inline std::string why_skipped(const PosedProblem& problem, const Method& method) {
  return std::visit([&](const auto& own) { return why_skipped(*own, method); }, problem);
}
inline std::vector<StageDecision> decide_stages(const PosedProblem& problem, const Method& method,
                                                bool fields_asked) {
  return std::visit([&](const auto& own) { return decide_stages(*own, method, fields_asked); },
                    problem);
}

}  // namespace airybench
