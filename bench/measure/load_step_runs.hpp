// A case with load steps: its whole path is one solve, and every step is judged as a separate
// problem. A case without is a path of one step.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/records/json.hpp"
#include "bench/verify/reference.hpp"
#include "bench/verify/verifier.hpp"
#include "solvers/loading/load_steps.hpp"

namespace airybench {

inline int count_of_steps(const Problem& problem) {
  return 1 + static_cast<int>(problem.later_steps.size());
}

// The references of all steps, each with the slip of those before it.
struct ReferencePath {
  std::vector<Reference> steps;  // all of them, or none …
  std::string missing;           // … and why
};
// error_at_most: of every reference, by its own estimate.
ReferencePath references_along(const std::shared_ptr<const Problem>& first, double error_at_most);

// From which a path can go on.
Solution answer_of(const Reference& reference);

struct JudgedStep {
  Status claimed_status;
  Verification verification;
  // Against the solution nearest to it, where the law is met by other forces than the reference's:
  // along the method's own path, whose past may be another, too.
  std::optional<Verification> as_other = {};
  double dissipation_Nmm = 0;

  const Verification& seen() const { return as_other ? *as_other : verification; }
};

// The answer of the last step, with the times and iterations of all, the largest storage and error
// estimate, and the worst status. watched_s: the time of visiting, which is part of no stage.
Solution solve_path(const Solve& solve, DualSystem& system, const RunControl& control,
                    const VisitStep& visit, double& watched_s);

// "load step 3 of 20: ", or nothing where there is one only.
std::string step_prefix(std::int64_t step, const Problem& first);

// The step whose worst measure is largest, a NaN above all; there must be one.
std::size_t worst_step(const std::vector<JudgedStep>& steps);

// Record::steps.
Json steps_of(const std::vector<JudgedStep>& steps);

// The same of a path whose steps are taken in two halves each, by HYBRID, where both halves are
// done; at their ends the loads are those of the path's own steps. The dissipation is that of both.
Json steps_in_halves(const Problem& first);

}  // namespace airybench
