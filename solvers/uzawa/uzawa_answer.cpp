#include "solvers/uzawa/uzawa_answer.hpp"

#include <sstream>

#include "solvers/condensation/finish.hpp"

namespace airybench {
namespace {

std::string residuals(const UzawaResult& result) {
  std::ostringstream text;
  text << "i_C " << result.primal_N << " N, relative residuals " << result.primal << " and "
       << result.dual << " after " << result.iterations << " iterations";
  return text.str();
}

void check_uzawa_answer(const DualSystem& system, const PenalisedSolve& penalised,
                        const UzawaResult& result, const RunControl& control, Solution& solution) {
  bool solved = true;
  run_stage(solution.times, Stage::check, MemoryOwner::check, [&] {
    check_airy_answer_without_D(
        system,
        [&](SaddleVector& v) { solved = solve_saddle(system, penalised, v, control.deadline); },
        {result.x, result.lambda, result.lambda_c}, control, solution);
  });
  if (solved || solution.status != Status::ok) return;
  solution.status = Status::inaccurate;
  solution.message = "its error could not be estimated: " + solution.parameters +
                     " leave too badly conditioned a system";
}

}  // namespace

UzawaOptions uzawa_options(const RunControl& control) {
  UzawaOptions options;
  options.stop = control.stop;
  options.tolerance = control.tolerance;
  options.most_iterations = control.most_iterations.value_or(options.most_iterations);
  return options;
}

void store_uzawa_answer(const DualSystem& system, const RunControl& control,
                        const PenalisedSolve& penalised, const std::string& parameters,
                        UzawaResult result, Solution& solution) {
  solution.parameters = parameters;
  solution.uzawa_iterations = result.iterations;
  solution.F_C = std::move(result.F_C);
  run_stage(solution.times, Stage::recover, MemoryOwner::answer,
            [&] { store_airy_answer(system, result.x, solution); });
  solution.contact_displacement = -result.lambda_c;
  if (control.histories)
    solution.histories.push_back({control.stop == Stop::paper
                                      ? "i_C of the Uzawa iteration, N"
                                      : "relative residual of the Uzawa iteration",
                                  std::move(result.history)});
  if (result.outcome == UzawaOutcome::converged) {
    solution.status = Status::ok;
    solution.message.clear();
  } else {
    solution.status = Status::not_converged;
    solution.message = "Uzawa iteration (" + solution.parameters + ") " +
                       (result.outcome == UzawaOutcome::diverged ? "diverged: " : "too slow: ") +
                       residuals(result);
  }
  if (solution.status == Status::ok && control.stop == Stop::target)
    check_uzawa_answer(system, penalised, result, control, solution);
}

}  // namespace airybench
