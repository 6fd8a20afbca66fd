#include "solvers/condensation/airy_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "assembly/problem/load_scale.hpp"
#include "assembly/rough_compliance.hpp"
#include "solvers/condensation/airy_residual.hpp"
#include "solvers/contact/active_set.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "solvers/contact/free_body_contact.hpp"

namespace airybench {
namespace {

double largest(const Eigen::VectorXd& v) { return v.lpNorm<Eigen::Infinity>(); }

// One correction, and the estimate of what it and those before it correct. F_C keeps.
struct Correction {
  SaddleVector delta;
  Eigen::VectorXd S_delta;
  double energy_norm = 0;  // of the error that δx stands for, √(N mm)
  double estimate = 0;
};

// Of the corrected displacements ū_C, F_C held.
using CheckContact =
    std::function<ContactCheck(const Eigen::VectorXd& F_C, const Eigen::VectorXd& displacement)>;

// The larger of ‖δx‖_S and |δx·(r − Cᵀ δλ)| / ‖δx‖_S.
double error_norm(const AirySystem& system, const SaddleVector& delta, double norm,
                  const WideVector& r) {
  const double work = delta.x.dot(r.cast<double>()) - delta.lambda_F.dot(system.C_F * delta.x) -
                      delta.lambda_C.dot(system.C_C * delta.x);
  return norm == 0 ? 0 : larger_error(norm, std::abs(work) / norm);
}

// What all corrections of an answer have in common.
struct Checked {
  const AirySystem& system;
  CheckContact law;
  LoadScale scale;
  const SaddleSolve& solve;
};

// Of an answer with such a residual, F_C and λ'.
Correction correction(const Checked& of, const AiryResidual& at, const Eigen::VectorXd& F_C,
                      const Eigen::VectorXd& lambda_C, double corrected_before = 0) {
  const AirySystem& system = of.system;
  const auto& [residual, stress_norm] = at;
  Correction result;
  result.delta = {residual.x.cast<double>(), residual.lambda_F.cast<double>(),
                  residual.lambda_C.cast<double>()};
  const double force_scale = std::max(largest(system.F), largest(F_C));
  const double unbalanced =
      std::max(largest(result.delta.lambda_F), largest(result.delta.lambda_C));
  of.solve(result.delta);
  AiryProduct product = airy_product(system, result.delta.x);
  result.energy_norm = error_norm(system, result.delta, product.stress_norm, residual.x);
  result.S_delta = std::move(product.S_x);
  double error = corrected_before + result.energy_norm;
  result.estimate = of.scale.relative_force(unbalanced, force_scale);
  if (F_C.size() > 0) {
    const ContactCheck check = of.law(F_C, -(lambda_C + result.delta.lambda_C));
    error += check.energy_norm;
    result.estimate = larger_error(result.estimate, check.relative);
  }
  result.estimate = larger_error(result.estimate, of.scale.relative_energy(error, stress_norm));
  return result;
}

LongSaddleVector in_long(const SaddleVector& answer) {
  return {answer.x.cast<Wide>(), answer.lambda_F.cast<Wide>(), answer.lambda_C.cast<Wide>()};
}

// The residual of a corrected answer, from the one before: r ← r − [S Cᵀ; C 0] δ, in double. Of a
// correction that is enough.
void subtract_product(const AirySystem& system, const Correction& of, LongSaddleVector& r) {
  const SaddleVector& delta = of.delta;
  Eigen::VectorXd product = of.S_delta;
  product.noalias() += system.C_F.transpose() * delta.lambda_F;
  product.noalias() += system.C_C.transpose() * delta.lambda_C;
  r.x -= product.cast<Wide>();
  r.lambda_F -= (system.C_F * delta.x).cast<Wide>();
  r.lambda_C -= (system.C_C * delta.x).cast<Wide>();
}

void add(LongSaddleVector& answer, const SaddleVector& delta) {
  answer.x += delta.x.cast<Wide>();
  answer.lambda_F += delta.lambda_F.cast<Wide>();
  answer.lambda_C += delta.lambda_C.cast<Wide>();
}

CheckContact with_D(const contact::Problem& condensed, const LoadScale& scale) {
  return [&](const Eigen::VectorXd& F_C, const Eigen::VectorXd& displacement) {
    return check_contact(condensed.D, condensed.points, F_C, displacement, scale);
  };
}

// Where the factors are poor, or an iteration has not seen all of the residual, a correction is no
// better than the answer: another one follows until it adds little.
void check(const Checked& of, const SaddleVector& answer, const RunControl& control,
           Solution& solution) {
  constexpr double trusted = 1e-10, little = 0.1;
  constexpr int max_corrections = 6;
  AiryResidual at = airy_residual(of.system, in_long(answer), solution.F_C);
  Eigen::VectorXd lambda_C = answer.lambda_C;
  Correction next = correction(of, at, solution.F_C, lambda_C);
  double estimate = next.estimate, corrected = next.energy_norm;
  for (int k = 1; k < max_corrections && estimate > trusted; ++k) {
    control.deadline.check("the check of the answer");
    subtract_product(of.system, next, at.residual);
    lambda_C += next.delta.lambda_C;
    next = correction(of, at, solution.F_C, lambda_C, corrected);
    estimate = larger_error(estimate, next.estimate);
    if (!(next.energy_norm > little * corrected)) break;
    corrected += next.energy_norm;
  }
  judge_by_own_estimate(estimate, control, solution);
}

}  // namespace

void check_airy_answer(const AirySystem& system, const contact::Problem& condensed,
                       const SaddleSolve& solve, const SaddleVector& answer,
                       const RunControl& control, Solution& solution) {
  const LoadScale scale = load_scale(*system.problem);
  check({system, with_D(condensed, scale), scale, solve}, answer, control, solution);
}

void check_airy_answer_without_D(const AirySystem& system, const SaddleSolve& solve,
                                 const SaddleVector& answer, const RunControl& control,
                                 Solution& solution) {
  const LoadScale scale = load_scale(*system.problem);
  const Eigen::VectorXd D_diagonal = rough_compliance(*system.problem, system.contact);
  const auto check_law = [&](const Eigen::VectorXd& F_C, const Eigen::VectorXd& displacement) {
    const Eigen::VectorXd off = natural_map(system.contact, D_diagonal, F_C, displacement);
    ContactCheck result;
    // ‖ΔF‖_D ≤ ‖e‖_D + ‖D_d e‖_{D⁻¹}, e the map: the last up to 6 ‖e‖ in D_d
    // (docs/theory-errors.md).
    constexpr double multiple = 10;
    result.energy_norm = multiple * std::sqrt(off.dot(D_diagonal.cwiseProduct(off)));
    result.relative = multiple * scale.relative_force(off.norm(), F_C.norm());
    return result;
  };
  check({system, check_law, scale, solve}, answer, control, solution);
}

void refine_airy_answer(const AirySystem& system, const contact::Problem& condensed,
                        const SaddleSolve& solve, const SaddleVector& answer,
                        const RunControl& control, Solution& solution) {
  constexpr int max_steps = 20;
  const LoadScale scale = load_scale(*system.problem);
  const Checked of{system, with_D(condensed, scale), scale, solve};
  LongSaddleVector trial = in_long(answer), best = trial;
  Eigen::VectorXd F = solution.F_C;
  const auto next_correction = [&](int number) {
    return correction(of, airy_residual(system, trial, F, number), F,
                      trial.lambda_C.cast<double>());
  };
  Correction next = next_correction(0);
  double estimate = next.estimate;
  for (int step = 0; step < max_steps && estimate > 0 && std::isfinite(next.estimate); ++step) {
    control.deadline.check("refinement");
    add(trial, next.delta);
    if (F.size() > 0) {
      const Eigen::VectorXd u = -trial.lambda_C.cast<double>();
      const Eigen::VectorXd r = relative_to_gap(condensed.points, u);
      SaddleVector change{Eigen::VectorXd::Zero(system.n()), Eigen::VectorXd::Zero(system.n_f()),
                          active_set_step(condensed.D, condensed.points, F, r) - F};
      F += change.lambda_C;
      solve(change);
      add(trial, change);
    }
    next = next_correction(step + 1);
    if (!(next.estimate < estimate)) break;
    const bool slow = next.estimate > estimate / 2;
    estimate = next.estimate;
    best = trial;
    solution.F_C = F;
    if (slow) break;
  }
  const OwnerScope scope_of_answer(MemoryOwner::answer);
  solution.unknowns = AiryFunction{airy_function(system, best.x.cast<double>())};
  solution.stress = airy_stress(system, best.x);
  solution.contact_displacement = -best.lambda_C.cast<double>();
  // The motion of a free body stays that of the first answer.
  const double unbalanced = unbalanced_share(system.contact.free, solution.F_C);
  judge_by_own_estimate(larger_error(estimate, unbalanced), control, solution);
}

}  // namespace airybench
