#include "solvers/uzawa/augmented_lagrangian.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <sstream>

#include "solvers/condensation/finish.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "solvers/contact/free_body_contact.hpp"

namespace airybench {
namespace {

double mean_magnitude(const SparseRows& C) {
  return C.nonZeros() > 0 ? C.coeffs().abs().sum() / static_cast<double>(C.nonZeros()) : 1;
}

double mean_magnitude_symmetric(const SparseColumns& lower) {
  const double diagonal = lower.diagonal().cwiseAbs().sum();
  const auto n = static_cast<double>(lower.rows());
  return (2 * lower.coeffs().abs().sum() - diagonal) /
         (2 * static_cast<double>(lower.nonZeros()) - n);
}

// S += Cᵀ W C, lower triangle, inside the pattern of S.
void add_normal_product(const SparseRows& C, const Eigen::Ref<const Eigen::VectorXd>& weights,
                        SparseColumns& lower) {
  for (int i = 0; i < C.rows(); ++i)
    for (SparseRows::InnerIterator a(C, i); a; ++a)
      for (SparseRows::InnerIterator b(C, i); b && b.col() <= a.col(); ++b)
        lower.coeffRef(a.col(), b.col()) += weights(i) * a.value() * b.value();
  assert(lower.isCompressed());  // nothing new was inserted
}

// The iterates of all ρ as columns; those that have ended are moved behind the active ones.
struct Iterates {
  Eigen::MatrixXd x, lambda, lambda_c, F_C;              // n, n_f, n_c, n_c
  Eigen::MatrixXd force, contact, on_force, on_contact;  // C_F φ − F, C_C φ + F0; workspace
  std::vector<std::size_t> result;                       // whose column it is
  std::vector<double> rho, force_scale, displacement_scale;
  int active = 0;

  Iterates(const AirySystem& system, const std::vector<double>& rhos)
      : rho(rhos), force_scale(rhos.size(), 0), displacement_scale(rhos.size(), 0) {
    const auto columns = static_cast<Eigen::Index>(rhos.size());
    active = static_cast<int>(columns);
    x.setZero(system.n(), columns);
    for (Eigen::MatrixXd* m : {&lambda, &force, &on_force}) m->setZero(system.n_f(), columns);
    for (Eigen::MatrixXd* m : {&lambda_c, &F_C, &contact, &on_contact})
      m->setZero(system.n_c(), columns);
    for (std::size_t k = 0; k < rhos.size(); ++k) result.push_back(k);
  }
  void retire(int k) {
    --active;
    for (Eigen::MatrixXd* m : {&x, &lambda, &lambda_c, &F_C, &force, &contact})
      if (k != active) m->col(k).swap(m->col(active));
    std::swap(result[k], result[active]);
    std::swap(rho[k], rho[active]);
    std::swap(force_scale[k], force_scale[active]);
    std::swap(displacement_scale[k], displacement_scale[active]);
  }
};

// S̃ φ = …, for all active columns.
void solve_for_stress(const AirySystem& system, const AugmentedFactor& a, Iterates& it) {
  auto x = it.x.leftCols(it.active);
  if (system.q.size() > 0)
    x.colwise() = system.q;
  else
    x.setZero();
  auto on_force = it.on_force.leftCols(it.active), on_contact = it.on_contact.leftCols(it.active);
  on_force = it.lambda.leftCols(it.active);
  if (system.F.size() > 0) on_force.colwise() -= a.r_F * system.F;
  on_contact = it.lambda_c.leftCols(it.active) - a.r_C * it.F_C.leftCols(it.active);
  if (system.F0.size() > 0) on_contact.colwise() += a.r_C * system.F0;
  for (int k = 0; k < it.active; ++k) {
    for (int i = 0; i < system.n_f(); ++i)
      for (SparseRows::InnerIterator entry(system.C_F, i); entry; ++entry)
        x(entry.col(), k) -= entry.value() * on_force(i, k);
    for (int i = 0; i < system.n_c(); ++i)
      for (SparseRows::InnerIterator entry(system.C_C, i); entry; ++entry)
        x(entry.col(), k) -= entry.value() * on_contact(i, k);
  }
  solve_in_place(a.factor, x);
}

// The projection and the multipliers of column k; residuals into `result`.
void update_column(const AirySystem& system, const AugmentedFactor& a, Iterates& it, int k,
                   UzawaResult& result) {
  auto force = it.force.col(k), contact = it.contact.col(k), F_C = it.F_C.col(k),
       change = it.on_contact.col(k);
  force.noalias() = system.C_F * it.x.col(k);
  contact.noalias() = system.C_C * it.x.col(k);
  if (system.F0.size() > 0) contact += system.F0;
  it.force_scale[k] =
      std::max(it.force_scale[k], std::hypot(force.norm(), contact.norm(), system.F.norm()));
  if (system.F.size() > 0) force -= system.F;

  double moved = 0;
  if (system.n_c() > 0) {
    change = F_C;
    F_C = contact + it.lambda_c.col(k) / a.r_C;
    if (system.contact.gap.size() > 0) F_C += system.contact.gap / a.r_C;
    if (!system.contact.opposite.empty())
      set_means_of_pairs(system.contact, Eigen::VectorXd::Ones(system.n_c()), F_C);
    project_in_place(system.contact, F_C);
    change -= F_C;
    moved = a.r_C * change.norm();
    contact -= F_C;
    it.lambda_c.col(k) += it.rho[k] / a.r * a.r_C * contact;
  }
  it.lambda.col(k) += it.rho[k] / a.r * a.r_F * force;
  it.displacement_scale[k] = std::max(
      it.displacement_scale[k], std::hypot(it.lambda.col(k).norm(), it.lambda_c.col(k).norm()));

  const auto relative = [](double value, double scale) { return value == 0 ? 0 : value / scale; };
  result.primal_N = std::max(system.n_f() > 0 ? force.cwiseAbs().maxCoeff() : 0,
                             system.n_c() > 0 ? contact.cwiseAbs().maxCoeff() : 0);
  result.primal = relative(std::hypot(force.norm(), contact.norm()), it.force_scale[k]);
  result.dual = relative(moved, it.displacement_scale[k]);
}

Eigen::VectorXd penalties(const AirySystem& system, const AugmentedFactor& augmented) {
  Eigen::VectorXd R(system.n_f() + system.n_c());
  R << Eigen::VectorXd::Constant(system.n_f(), augmented.r_F),
      Eigen::VectorXd::Constant(system.n_c(), augmented.r_C);
  return R;
}

std::string residuals(const UzawaResult& result) {
  std::ostringstream text;
  text << "i_C " << result.primal_N << " N, relative residuals " << result.primal << " and "
       << result.dual << " after " << result.iterations << " iterations";
  return text.str();
}

void check_uzawa_answer(const AirySystem& system, const PenalisedSolve& penalised,
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

SparseColumns penalised_matrix(const AirySystem& system, const Eigen::VectorXd& R) {
  refuse_free_bodies(system.contact);
  SparseColumns lower = system.S;
  add_normal_product(system.C_F, R.head(system.n_f()), lower);
  add_normal_product(system.C_C, R.tail(system.n_c()), lower);
  return lower;
}

PenalisedSolve penalised_solve(const AirySystem& system, const AugmentedFactor& augmented) {
  return {penalties(system, augmented),
          [&augmented](Eigen::VectorXd& x) { solve_in_place(augmented.factor, x); }};
}

AugmentedFactor factor_augmented(const AirySystem& system, double r, const Deadline& deadline) {
  const double mean_S = mean_magnitude_symmetric(system.S);
  const double mean_F = mean_magnitude(system.C_F), mean_C = mean_magnitude(system.C_C);
  AugmentedFactor result;
  result.r = r;
  result.r_F = r * mean_S / (mean_F * mean_F);
  result.r_C = r * mean_S / (mean_C * mean_C);
  const SparseColumns lower = penalised_matrix(system, penalties(system, result));
  result.factor = factor_ldlt(analyse_skyline(lower), lower, deadline);
  return result;
}

std::size_t uzawa_bytes(const AirySystem& system, int count) {
  return static_cast<std::size_t>(count * (2 * system.n() + 4 * system.n_f() + 6 * system.n_c())) *
         sizeof(double);
}

std::vector<UzawaResult> iterate_uzawa(const AirySystem& system, const AugmentedFactor& augmented,
                                       const std::vector<double>& rhos, const UzawaOptions& options,
                                       bool race, const Deadline& deadline) {
  // A residual that has grown so much, or is not finite, does not come back.
  constexpr double diverges = 1e6;
  const OwnerScope scope(MemoryOwner::iteration);
  Iterates it(system, rhos);
  std::vector<UzawaResult> results(rhos.size());
  for (std::size_t k = 0; k < rhos.size(); ++k) results[k].rho = rhos[k];
  std::vector<double> first(rhos.size(), 0);
  bool won = false;
  while (it.active > 0 && !won) {
    solve_for_stress(system, augmented, it);
    for (int k = 0; k < it.active;) {
      UzawaResult& result = results[it.result[k]];
      update_column(system, augmented, it, k, result);
      ++result.iterations;
      const bool paper = options.stop == Stop::paper;
      const double residual = paper ? result.primal_N : std::max(result.primal, result.dual);
      if (!race) result.history.push_back(residual);
      if (result.iterations == 1) first[it.result[k]] = result.primal_N;
      const bool met = residual <= (paper ? options.paper_stop_N : options.tolerance);
      const bool lost = !std::isfinite(result.primal_N) ||
                        result.primal_N > diverges * std::max(first[it.result[k]], 1.0);
      // The first iteration has compared nothing yet: F_C and the multipliers were zero.
      const bool met_truly =
          met && !lost && (paper || result.iterations > 1 || result.primal_N == 0);
      if (met_truly || lost || result.iterations >= options.max_iterations) {
        result.outcome = met_truly ? UzawaOutcome::converged
                         : lost    ? UzawaOutcome::diverged
                                   : UzawaOutcome::too_many_iterations;
        if (!race) {
          result.F_C = it.F_C.col(k);
          result.x = it.x.col(k);
          result.lambda = it.lambda.col(k);
          result.lambda_c = it.lambda_c.col(k);
        }
        won = won || (race && met_truly);
        it.retire(k);
      } else {
        ++k;
      }
    }
    if (it.active > 0 && !won) deadline.check("the Uzawa iteration");
  }
  return results;
}

bool solve_saddle(const AirySystem& system, const PenalisedSolve& penalised, SaddleVector& v,
                  const Deadline& deadline) {
  constexpr int max_iterations = 500;
  const int n_f = system.n_f(), n_c = system.n_c();
  const Eigen::VectorXd& R = penalised.R;
  const auto solve = [&](Eigen::VectorXd b) {
    penalised.solve(b);
    return b;
  };
  const auto C = [&](const Eigen::VectorXd& x) {
    Eigen::VectorXd y(n_f + n_c);
    y << system.C_F * x, system.C_C * x;
    return y;
  };
  const auto C_transposed = [&](const Eigen::VectorXd& y) {
    return Eigen::VectorXd(system.C_F.transpose() * y.head(n_f) +
                           system.C_C.transpose() * y.tail(n_c));
  };
  Eigen::VectorXd forces(n_f + n_c);
  forces << v.lambda_F, v.lambda_C;
  const Eigen::VectorXd load = v.x + C_transposed(R.cwiseProduct(forces));
  Eigen::VectorXd residual = C(solve(load)) - forces;
  Eigen::VectorXd lambda = Eigen::VectorXd::Zero(n_f + n_c);
  // The right-hand side is made so that λ is 0 for R → ∞; R is then the preconditioner.
  Eigen::VectorXd z = R.cwiseProduct(residual), direction = z;
  double rz = residual.dot(z);
  const double enough = penalised.tolerance * penalised.tolerance * rz;
  bool met = rz == 0;
  for (int k = 0; k < max_iterations && !met; ++k) {
    deadline.check("the check of the answer");
    const Eigen::VectorXd product = C(solve(C_transposed(direction)));
    const double step = rz / direction.dot(product);
    lambda += step * direction;
    residual -= step * product;
    z = R.cwiseProduct(residual);
    const double next = residual.dot(z);
    if (!std::isfinite(next)) break;
    met = next <= enough;
    direction = z + next / rz * direction;
    rz = next;
  }
  v.x = solve(load - C_transposed(lambda));
  v.lambda_F = lambda.head(n_f);
  v.lambda_C = lambda.tail(n_c);
  return met;
}

UzawaOptions uzawa_options(const RunControl& control) {
  UzawaOptions options;
  options.stop = control.stop;
  options.tolerance = control.tolerance;
  options.max_iterations = control.max_iterations.value_or(options.max_iterations);
  return options;
}

void store_uzawa_answer(const AirySystem& system, const RunControl& control,
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
    stop_unconverged("Uzawa iteration (" + solution.parameters + ")",
                     std::isfinite(result.primal_N + result.primal + result.dual),
                     (result.outcome == UzawaOutcome::diverged ? "diverged: " : "too slow: ") +
                         residuals(result),
                     solution);
  }
  if (solution.status == Status::ok && control.stop == Stop::target)
    check_uzawa_answer(system, penalised, result, control, solution);
}

}  // namespace airybench
