#include "solvers/condensation/airy_refinement.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/load_scale.hpp"
#include "solvers/condensation/airy_residual.hpp"
#include "solvers/contact/active_set.hpp"
#include "solvers/contact/coulomb_law.hpp"

namespace airybench {
namespace {

double energy_norm(const DualSystem& system, const Eigen::VectorXd& x) {
  return std::sqrt(std::max(0.0, x.dot(system.S.selfadjointView<Eigen::Lower>() * x)));
}

double largest(const Eigen::VectorXd& v) { return v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0; }

// One correction, and the estimate of what it corrects. F_C keeps.
struct Correction {
  SaddleVector delta;
  double estimate = 0;
};

Correction correction(const DualSystem& system, const Eigen::VectorXd& D_diagonal,
                      const LoadScale& scale, const SaddleSolve& solve,
                      const LongSaddleVector& answer, const Eigen::VectorXd& F_C) {
  const LongSaddleVector residual = airy_residual(system, answer, F_C);
  Correction result{{residual.x.cast<double>(), residual.lambda_F.cast<double>(),
                     residual.lambda_C.cast<double>()},
                    0};
  const double force_scale = std::max(largest(system.F), largest(F_C));
  const double unbalanced =
      std::max(largest(result.delta.lambda_F), largest(result.delta.lambda_C));
  solve(result.delta);
  const Eigen::VectorXd x = answer.x.cast<double>() + result.delta.x;
  result.estimate = relative_error(energy_norm(system, result.delta.x), energy_norm(system, x),
                                   scale.energy_norm);
  result.estimate =
      std::max(result.estimate, relative_error(unbalanced, force_scale, scale.force_N));
  if (F_C.size() > 0) {
    const Eigen::VectorXd u = -(answer.lambda_C.cast<double>() + result.delta.lambda_C);
    const double off = natural_map(system.contact, D_diagonal, F_C, u).norm();
    result.estimate = std::max(result.estimate, relative_error(off, F_C.norm(), scale.force_N));
  }
  return result;
}

LongSaddleVector in_long(const SaddleVector& answer) {
  return {answer.x.cast<long double>(), answer.lambda_F.cast<long double>(),
          answer.lambda_C.cast<long double>()};
}

void add(LongSaddleVector& answer, const SaddleVector& delta) {
  answer.x += delta.x.cast<long double>();
  answer.lambda_F += delta.lambda_F.cast<long double>();
  answer.lambda_C += delta.lambda_C.cast<long double>();
}

}  // namespace

void check_airy_answer(const DualSystem& system, const Eigen::VectorXd& D_diagonal,
                       const SaddleSolve& solve, const SaddleVector& answer,
                       const RunControl& control, Solution& solution) {
  judge_by_own_estimate(correction(system, D_diagonal, load_scale(*system.problem), solve,
                                   in_long(answer), solution.F_C)
                            .estimate,
                        control, solution);
}

void refine_airy_answer(const DualSystem& system, const Eigen::MatrixXd& D,
                        const SaddleSolve& solve, const SaddleVector& answer,
                        const RunControl& control, Solution& solution) {
  constexpr int most_steps = 20;
  const Eigen::VectorXd D_diagonal = D.diagonal();
  const LoadScale scale = load_scale(*system.problem);
  LongSaddleVector trial = in_long(answer), best = trial;
  Eigen::VectorXd F = solution.F_C;
  Correction next = correction(system, D_diagonal, scale, solve, trial, F);
  double estimate = next.estimate;
  for (int step = 0; step < most_steps && estimate > 0 && std::isfinite(next.estimate); ++step) {
    control.deadline.check("refinement");
    add(trial, next.delta);
    if (F.size() > 0) {
      const Eigen::VectorXd u = -trial.lambda_C.cast<double>();
      const Eigen::VectorXd r = relative_to_gap(system.contact, u);
      SaddleVector change{Eigen::VectorXd::Zero(system.n()), Eigen::VectorXd::Zero(system.n_f()),
                          active_set_step(D, system.contact, F, r) - F};
      F += change.lambda_C;
      solve(change);
      add(trial, change);
    }
    next = correction(system, D_diagonal, scale, solve, trial, F);
    if (!(next.estimate < estimate)) break;
    const bool slow = next.estimate > estimate / 2;
    estimate = next.estimate;
    best = trial;
    solution.F_C = F;
    if (slow) break;
  }
  const OwnerScope scope_of_answer(MemoryOwner::answer);
  solution.phi = airy_function(system, best.x.cast<double>());
  solution.stress = airy_stress(system, best.x);
  judge_by_own_estimate(estimate, control, solution);
}

}  // namespace airybench
