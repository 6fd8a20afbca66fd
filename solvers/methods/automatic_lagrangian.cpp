// ALM:AUTO: the augmented Lagrangian method without parameters to choose, accelerated; with
// CHOLMOD's factor, which takes a third of the skyline's memory.
#include "solvers/base/kept_body.hpp"
#include "solvers/direct/factor_counts.hpp"
#include "solvers/uzawa/accelerated_lagrangian.hpp"
#include "solvers/uzawa/augmented_lagrangian.hpp"

namespace airybench {
namespace {

// Its iterations come close to rounding: the residual has no D to weigh it, and what it leaves in
// the soft modes of a rack is a thousand times as large in the displacements.
constexpr double first_tolerance = 2e-4;

// With the factor that is there.
Solution iterate_automatically(const AirySystem& system, const RunControl& control,
                               PenalisedFactor& penalised, Solution solution) {
  constexpr double check_tolerance = 1e-2;
  solution.storage[MemoryOwner::iteration] = accelerated_bytes(system);
  UzawaResult result = [&] {
    const StageTimer timer(solution.times, system.n_c() > 0 ? Stage::contact : Stage::recover);
    return iterate_accelerated(system, penalised, uzawa_options(control), control.deadline);
  }();
  store_uzawa_answer(system, control,
                     {penalised.R, [&](Eigen::VectorXd& x) { penalised.factor.solve_in_place(x); },
                      check_tolerance},
                     "w=3, w_F=10", std::move(result), solution);
  return solution;
}

Solution solve_automatic_lagrangian(const AirySystem& system, const RunControl& control) {
  const auto penalised = std::make_shared<PenalisedFactor>();
  Solution solution;
  SparseColumns lower = run_stage(solution.times, Stage::factor, MemoryOwner::factor, [&] {
    penalised->R = row_penalties(system, 10, 3);
    return penalised_matrix(system, penalised->R);
  });
  run_stage(solution.times, Stage::order, MemoryOwner::factor,
            [&] { penalised->factor.analyse(lower); });
  control.deadline.check("CHOLMOD's analysis");
  run_stage(solution.times, Stage::factor, MemoryOwner::factor, [&] {
    penalised->factor.factor(lower);
    SparseColumns().swap(lower);
  });
  control.deadline.check("CHOLMOD's factorisation");
  solution = iterate_automatically(system, control, *penalised, std::move(solution));
  count_factor(penalised->factor, solution);
  if (control.keep_body)
    solution.solve_again = for_the_same_body(
        system, on_airy_system([penalised](const AirySystem& load_case, const RunControl& again) {
          return iterate_automatically(load_case, again, *penalised, {});
        }));
  return solution;
}

}  // namespace

Method automatic_alm() {
  return {.name = "ALM:AUTO",
          .family = "ALM",
          .summary = "augmented Lagrangian, accelerated, no parameters to choose",
          .stages = {Stage::order, Stage::factor, Stage::contact, Stage::recover, Stage::check},
          .solve = on_airy_system(solve_automatic_lagrangian),
          .first_tolerance = first_tolerance,
          .knob = AccuracyKnob::uzawa_iterations};
}

}  // namespace airybench
