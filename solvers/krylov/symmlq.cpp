#include "solvers/krylov/symmlq.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace airybench {
namespace {

// One lane's tridiagonal factorisation; names as in Paige & Saunders' section 5.
struct Tridiagonal {
  int step = 0;                         // Lanczos vectors so far
  double beta_1 = 0;                    // ‖b‖_M⁻¹
  double beta_old = 0, beta = 0;        // β_k, β_{k+1}
  double alpha = 0;                     // α_k
  double gamma_bar = 0, delta_bar = 0;  // what the next rotation acts on
  double rhs_1 = 0, rhs_2 = 0;          // of L z = β_1 e_1
  double sines = 1;                     // product of all sines
  double residual = 1;                  // relative, of the better point
  double to_galerkin = 0;               // coefficient of w̄ that leads there; 0: stay
};

// How the vectors of a lane change: x += on_w w + on_v v, then w ← w_on_w w + w_on_v v.
struct Update {
  double on_w = 0, on_v = 0, w_on_w = 1, w_on_v = 0;
};

// Takes step k, whose α_k and β_{k+1} are known, into the factorisation.
Update advance(Tridiagonal& t) {
  Update update;
  if (t.step == 1) {
    t.gamma_bar = t.alpha;
    t.delta_bar = t.beta;
    t.rhs_1 = t.beta_1;
    t.rhs_2 = 0;
    t.sines = 1;
    update.w_on_w = 0;  // w̄_1 = v_1
    update.w_on_v = 1;
  } else {
    const double gamma = std::hypot(t.gamma_bar, t.beta_old);
    const double c = t.gamma_bar / gamma, s = t.beta_old / gamma;
    const double delta = c * t.delta_bar + s * t.alpha;
    t.gamma_bar = s * t.delta_bar - c * t.alpha;
    t.delta_bar = -c * t.beta;
    const double z = t.rhs_1 / gamma;
    t.rhs_1 = t.rhs_2 - delta * z;
    t.rhs_2 = -s * t.beta * z;
    t.sines *= s;
    update = {z * c, z * s, s, -c};
  }
  const double at_lq = std::hypot(t.rhs_1, t.rhs_2);
  const double at_galerkin = t.gamma_bar != 0 ? t.beta_1 * std::abs(t.sines * t.beta / t.gamma_bar)
                                              : std::numeric_limits<double>::infinity();
  t.to_galerkin = at_galerkin < at_lq ? t.rhs_1 / t.gamma_bar : 0;
  t.residual = std::min(at_lq, at_galerkin) / t.beta_1;
  return update;
}

template <int lanes>
KrylovSummary solve_range(const SymmetricOperator& A, const Preconditioner& preconditioner,
                          const RightHandSides& sides, int begin, int end,
                          const KrylovOptions& options, const Deadline& deadline) {
  const OwnerScope scope(MemoryOwner::iteration);
  const Eigen::Index n = A.n;
  const Apply apply = preconditioner.applier(lanes);
  KrylovSummary summary;
  Lanes in(begin, end, lanes);
  LaneBlock x(n, lanes), w(n, lanes), v(n, lanes), y(n, lanes), older(n, lanes), r(n, lanes);
  std::array<Tridiagonal, lanes> t;
  LaneScalars residual{}, on_w{}, on_v{}, w_on_w{}, w_on_v{}, scale{}, on_older{}, on_r{};

  const auto begin_next = [&](int l) {
    const int k = in.refill(l);
    for (LaneBlock* block : {&x, &w, &v, &older, &r}) block->col(l).setZero();
    if (k != Lanes::none) sides.load(k, r.col(l));
    older.col(l) = r.col(l);
    t[l] = {};
    residual[l] = 1;
  };
  const auto finish = [&](int l) {
    x.col(l) += t[l].to_galerkin * w.col(l);
    sides.store(in[l], x.col(l));
    summary.iterations += t[l].step;
    summary.max_iterations = std::max(summary.max_iterations, t[l].step);
    summary.residual = std::max(summary.residual, t[l].residual);
    summary.converged = summary.converged && t[l].residual <= options.tolerance;
    begin_next(l);
  };

  if (begin == 0) summary.history.reserve(4096);
  for (int l = 0; l < lanes; ++l) begin_next(l);
  while (in.any()) {
    y = r;
    apply(y);
    const LaneScalars ry = dot<lanes>(n, r.data(), y.data());
    for (int l = 0; l < lanes; ++l) {
      on_w[l] = on_v[l] = w_on_v[l] = 0;
      w_on_w[l] = 1;
      if (in[l] == Lanes::none) continue;
      if (!(ry[l] >= 0) || !std::isfinite(ry[l]))
        throw Breakdown("SYMMLQ: r·M⁻¹r is " + std::to_string(ry[l]) + " at iteration " +
                        std::to_string(t[l].step));
      t[l].beta_old = t[l].beta;
      t[l].beta = std::sqrt(ry[l]);
      if (t[l].step == 0) {
        t[l].beta_1 = t[l].beta;
        t[l].residual = t[l].beta_1 > 0 ? 1 : 0;
        continue;
      }
      const Update update = advance(t[l]);
      on_w[l] = update.on_w, on_v[l] = update.on_v;
      w_on_w[l] = update.w_on_w, w_on_v[l] = update.w_on_v;
      if (!std::isfinite(t[l].residual))
        throw Breakdown("SYMMLQ: the residual is not finite at iteration " +
                        std::to_string(t[l].step));
    }
    for (Eigen::Index i = 0; i < n; ++i)
      for (int l = 0; l < lanes; ++l) {
        const Eigen::Index at = i * lanes + l;
        const double w_old = w.data()[at], v_old = v.data()[at];
        x.data()[at] += on_w[l] * w_old + on_v[l] * v_old;
        w.data()[at] = w_on_w[l] * w_old + w_on_v[l] * v_old;
      }
    for (int l = 0; l < lanes; ++l) {
      scale[l] = on_older[l] = 0;
      if (in[l] == Lanes::none) continue;
      residual[l] = t[l].residual;
      if (in[l] == 0) summary.history.push_back(residual[l]);
      if (residual[l] <= options.tolerance || t[l].step >= options.max_iterations) {
        finish(l);        // the next one begins in the next round, with its own y
        on_older[l] = 1;  // keeps its right-hand side in both residual vectors
        continue;
      }
      scale[l] = 1 / t[l].beta;
      if (t[l].step > 0) on_older[l] = -t[l].beta / t[l].beta_old;
    }
    for (Eigen::Index i = 0; i < n; ++i)
      for (int l = 0; l < lanes; ++l) v.data()[i * lanes + l] = scale[l] * y.data()[i * lanes + l];
    A.multiply(v, y);  // y is free now
    xpay<lanes>(n, y.data(), on_older, older.data());
    const LaneScalars alpha = dot<lanes>(n, v.data(), older.data());
    for (int l = 0; l < lanes; ++l) {
      on_r[l] = 0;
      if (scale[l] == 0) continue;
      ++t[l].step;
      t[l].alpha = alpha[l];
      on_r[l] = -alpha[l] / t[l].beta;
    }
    axpy<lanes>(n, on_r, r.data(), older.data());
    older.swap(r);
    in.check_time(deadline, "SYMMLQ", residual, options.tolerance);
  }
  return summary;
}

}  // namespace

KrylovSummary solve_by_symmlq(const SymmetricOperator& A, const Preconditioner& preconditioner,
                              const RightHandSides& sides, const KrylovOptions& options,
                              const Deadline& deadline) {
  return solve_in_ranges(options, sides.count, [&](int begin, int end, auto lanes) {
    return solve_range<lanes>(A, preconditioner, sides, begin, end, options, deadline);
  });
}

}  // namespace airybench
