// A case with load steps: the path is one solve, and each step is judged as a separate problem. A
// case without is a path of one step.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "assembly/displacement_field.hpp"
#include "bench/records/step_result.hpp"
#include "solvers/loading/load_steps.hpp"
#include "verify/reference.hpp"
#include "verify/verifier.hpp"

namespace airybench {

inline int count_of_steps(const Problem& problem) {
  return 1 + static_cast<int>(problem.later_steps.size());
}

// Each reference carries the slip of the steps before it.
struct ReferencePath {
  std::vector<Reference> steps;  // all, or none
  std::string missing;           // why there are none
};
// degree: of the stresses. error_at_most: limits each reference's own error estimate and
// equilibrium residual.
ReferencePath references_along(const std::shared_ptr<const Problem>& first, int degree,
                               double error_at_most);

Solution answer_of(const Reference& reference);

struct JudgedStep {
  Status claimed_status;
  Verification verification;
  // Set if the forces meet the law but are not the reference's: against the nearest solution.
  std::optional<Verification> as_other = {};
  double dissipation_Nmm = 0;
  std::optional<double> largest_pressure_MPa = {};  // of equilibrium stresses, on Γ_C
  DisplacementField displacement = {};              // of an external program
  std::string fields = {};                          // StepResult::fields

  const Verification& seen() const { return as_other ? *as_other : verification; }
};

// The last step's answer, with the sums of times and iterations, the largest storage and error
// estimate, and the worst status. watched_s: time in `visit`, which is part of no stage.
Solution solve_path(const Solve& solve, ContactSystem& system, const RunControl& control,
                    const VisitStep& visit, double& watched_s);

// On Γ_C; empty: there is none, or the stresses are those of displacements.
std::optional<double> largest_pressure_MPa(const ContactSystem& system, const Solution& answer);

void add_times(const StageTimes& more, StageTimes& sum);

// "load step 3 of 20: "; empty for a path of one step.
std::string step_prefix(std::int64_t step, const Problem& first);

// The step with the largest worst measure; NaN is largest. There must be a step.
std::size_t worst_step(const std::vector<JudgedStep>& steps);

std::vector<StepResult> step_results(const std::vector<JudgedStep>& steps);

// How many steps support the body otherwise than the one before: these are not halved.
int changes_of_supports(const Problem& first);

// By HYBRID, each step halved so often; dissipation adds up. Without what has no answer, or none
// within five minutes.
struct FinerPath {
  std::vector<StepResult> steps;
  StressField stress;  // of the last, MPa
};
FinerPath path_in_parts(const Problem& first, int degree, int halvings);

}  // namespace airybench
