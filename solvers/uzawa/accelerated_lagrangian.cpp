#include "solvers/uzawa/accelerated_lagrangian.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/base/anderson_acceleration.hpp"
#include "solvers/contact/coulomb_law.hpp"

namespace airybench {
namespace {

constexpr int memory = 10;  // of the acceleration

// y −= Cᵀ z.
void subtract_transposed(const SparseRows& C, const Eigen::Ref<const Eigen::VectorXd>& z,
                         Eigen::VectorXd& y) {
  for (int i = 0; i < C.rows(); ++i)
    for (SparseRows::InnerIterator entry(C, i); entry; ++entry)
      y(entry.col()) -= entry.value() * z(i);
}

// Z = P(v): F, and the forces that the contact law allows next to v + ḡ/R.
void allowed_forces(const AirySystem& system, const Eigen::VectorXd& R,
                    const Eigen::VectorXd& shift, const Eigen::VectorXd& v, Eigen::VectorXd& Z) {
  if (system.F.size() > 0)
    Z.head(system.n_f()) = system.F;
  else
    Z.head(system.n_f()).setZero();
  Z.tail(system.n_c()) = v.tail(system.n_c()) + shift;
  set_means_of_pairs(system.contact, R.tail(system.n_c()), Z.tail(system.n_c()));
  project_in_place(system.contact, Z.tail(system.n_c()));
}

double relative(double value, double scale) { return value == 0 ? 0 : value / scale; }

// One evaluation of g, its vectors kept.
struct Iterate {
  Eigen::VectorXd shift;                          // ḡ/R
  Eigen::VectorXd x;                              // n
  Eigen::VectorXd v, Z, lambda, forces, g, next;  // rows of C; next: P(g)
  double force_scale = 0, contact_scale = 0;      // the largest so far, N

  // From λ = 0, exactly: where nothing loads the body, nothing moves.
  Iterate(const AirySystem& system, const Eigen::VectorXd& R)
      : shift(Eigen::VectorXd::Zero(system.n_c())),
        x(system.n()),
        v(Eigen::VectorXd::Zero(R.size())) {
    for (Eigen::VectorXd* vector : {&Z, &lambda, &forces, &g, &next}) vector->resize(R.size());
    if (system.F.size() > 0) v.head(system.n_f()) = system.F;
    if (system.contact.gap.size() > 0)
      shift = system.contact.gap.cwiseQuotient(R.tail(system.n_c()));
  }

  void evaluate(const AirySystem& system, PenalisedFactor& penalised) {
    const int n_f = system.n_f(), n_c = system.n_c();
    const Eigen::VectorXd& R = penalised.R;
    allowed_forces(system, R, shift, v, Z);
    lambda = R.cwiseProduct(v - Z) - R.cwiseProduct(Z);
    if (system.F0.size() > 0) lambda.tail(n_c) += R.tail(n_c).cwiseProduct(system.F0);
    if (system.q.size() > 0)
      x = system.q;
    else
      x.setZero();
    subtract_transposed(system.C_F, lambda.head(n_f), x);
    subtract_transposed(system.C_C, lambda.tail(n_c), x);
    penalised.factor.solve_in_place(x);
    forces.head(n_f).noalias() = system.C_F * x;
    forces.tail(n_c).noalias() = system.C_C * x;
    if (system.F0.size() > 0) forces.tail(n_c) += system.F0;
    g = forces + v - Z;
    allowed_forces(system, R, shift, g, next);
    lambda = R.cwiseProduct(g - next);
    force_scale = std::max(force_scale, std::hypot(forces.norm(), system.F.norm()));
    contact_scale = std::max(contact_scale, forces.tail(n_c).norm());
  }
};

}  // namespace

Eigen::VectorXd row_penalties(const AirySystem& system, double weight_F, double weight_C) {
  Eigen::VectorXd R(system.n_f() + system.n_c());
  for (int i = 0; i < system.n_f(); ++i) R(i) = weight_F / system.C_F.row(i).squaredNorm();
  for (int i = 0; i < system.n_c(); ++i)
    R(system.n_f() + i) = weight_C / system.C_C.row(i).squaredNorm();
  return R;
}

std::size_t accelerated_bytes(const AirySystem& system) {
  const Eigen::Index rows = system.n_f() + system.n_c();
  return static_cast<std::size_t>(system.n() + 8 * rows) * sizeof(double) +
         AndersonAcceleration::bytes(rows, memory);
}

UzawaResult iterate_accelerated(const AirySystem& system, PenalisedFactor& penalised,
                                const UzawaOptions& options, const Deadline& deadline) {
  constexpr double diverges = 1e6;     // as in iterate_uzawa
  constexpr int patience = 200;        // iterations without a smaller residual …
  constexpr double at_rounding = 100;  // … which, if so near the tolerance, is at rounding
  const OwnerScope scope(MemoryOwner::iteration);
  const int n_f = system.n_f(), n_c = system.n_c();
  const bool paper = options.stop == Stop::paper;
  const double enough = paper ? options.paper_stop_N : options.tolerance;
  Iterate it(system, penalised.R);
  Eigen::VectorXd f(penalised.R.size());
  const Eigen::VectorXd root = penalised.R.cwiseSqrt();
  AndersonAcceleration acceleration(f.size(), memory);
  UzawaResult result;
  double first = 0, best = std::numeric_limits<double>::infinity();
  int best_at = 0;
  while (true) {
    it.evaluate(system, penalised);
    f = it.forces - it.next;
    result.primal_N = f.size() > 0 ? f.lpNorm<Eigen::Infinity>() : 0;
    result.primal = relative(f.norm(), it.force_scale);
    result.dual = relative((it.next - it.Z).tail(n_c).norm(), it.contact_scale);
    ++result.iterations;
    const double residual = paper ? result.primal_N : std::max(result.primal, result.dual);
    result.history.push_back(residual);
    if (result.iterations == 1) first = result.primal_N;
    if (residual < best) {
      best = residual;
      best_at = result.iterations;
    }
    const bool lost = !std::isfinite(residual) || result.primal_N > diverges * std::max(first, 1.0);
    const bool stalls = result.iterations > best_at + patience;
    const bool compared = paper || result.iterations > 1 || result.primal_N == 0;
    // The paper's stop has no check that would judge what rounding leaves.
    const bool met =
        !lost && compared && residual <= (stalls && !paper ? at_rounding * enough : enough);
    if (met || lost || stalls || result.iterations >= options.max_iterations) {
      result.outcome = met    ? UzawaOutcome::converged
                       : lost ? UzawaOutcome::diverged
                              : UzawaOutcome::too_many_iterations;
      break;
    }
    f = root.cwiseProduct(it.g - it.v);
    it.v = acceleration.next(it.g, f);
    deadline.check("the Uzawa iteration");
  }
  result.F_C = it.next.tail(n_c);
  result.x = std::move(it.x);
  result.lambda = it.lambda.head(n_f);
  result.lambda_c = it.lambda.tail(n_c);
  return result;
}

}  // namespace airybench
