#include "solvers/krylov/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "solvers/krylov/symmetric_product.hpp"

namespace airybench {
namespace {

[[noreturn]] void break_down(const char* product, double value, int iteration) {
  throw Breakdown(std::string("conjugate gradients: ") + product + " is " + std::to_string(value) +
                  " at iteration " + std::to_string(iteration));
}

template <int lanes>
KrylovSummary solve_range(const SparseColumns& lower, const Preconditioner& preconditioner,
                          const RightHandSides& sides, int begin, int end,
                          const KrylovOptions& options, const Deadline& deadline) {
  const OwnerScope scope(MemoryOwner::iteration);
  const Eigen::Index n = lower.rows();
  const Apply apply = preconditioner.applier(lanes);
  KrylovSummary summary;
  Lanes in(begin, end, lanes);
  LaneBlock x(n, lanes), r(n, lanes), z(n, lanes), p(n, lanes), Sp(n, lanes);
  LaneScalars rz{}, rz_start{}, alpha{}, minus_alpha{}, beta{}, residual{};
  std::array<int, lanes> iterations{};

  const auto begin_next = [&](int l) {
    const int k = in.refill(l);
    for (LaneBlock* block : {&x, &r, &z, &p}) block->col(l).setZero();
    if (k != Lanes::none) sides.load(k, r.col(l));
    iterations[l] = 0;
    residual[l] = 1;
  };
  const auto finish = [&](int l) {
    sides.store(in[l], x.col(l));
    summary.iterations += iterations[l];
    summary.max_iterations = std::max(summary.max_iterations, iterations[l]);
    summary.residual = std::max(summary.residual, residual[l]);
    summary.converged = summary.converged && residual[l] <= options.tolerance;
    begin_next(l);
  };

  if (begin == 0) summary.history.reserve(4096);
  for (int l = 0; l < lanes; ++l) begin_next(l);
  while (in.any()) {
    z = r;
    apply(z);
    const LaneScalars rz_new = dot<lanes>(n, r.data(), z.data());
    for (int l = 0; l < lanes; ++l) {
      alpha[l] = minus_alpha[l] = beta[l] = 0;
      if (in[l] == Lanes::none) continue;
      if (!(rz_new[l] >= 0) || !std::isfinite(rz_new[l]))
        break_down("r·M⁻¹r", rz_new[l], iterations[l]);
      if (iterations[l] == 0) rz_start[l] = rz_new[l];
      residual[l] = rz_start[l] > 0 ? std::sqrt(rz_new[l] / rz_start[l]) : 0;
      if (in[l] == 0) summary.history.push_back(residual[l]);
      if (residual[l] <= options.tolerance || iterations[l] >= options.max_iterations) {
        finish(l);  // the next one begins in the next round, with its own z
        continue;
      }
      if (iterations[l] > 0) beta[l] = rz_new[l] / rz[l];
      rz[l] = rz_new[l];
      alpha[l] = 1;  // runs
    }
    xpay<lanes>(n, z.data(), beta, p.data());
    symmetric_product(lower, p, Sp);
    const LaneScalars pSp = dot<lanes>(n, p.data(), Sp.data());
    for (int l = 0; l < lanes; ++l) {
      if (alpha[l] == 0) continue;
      if (!(pSp[l] > 0)) break_down("p·Sp", pSp[l], iterations[l]);
      alpha[l] = rz[l] / pSp[l];
      minus_alpha[l] = -alpha[l];
      ++iterations[l];
    }
    axpy<lanes>(n, alpha, p.data(), x.data());
    axpy<lanes>(n, minus_alpha, Sp.data(), r.data());
    in.check_time(deadline, "conjugate gradients", residual, options.tolerance);
  }
  return summary;
}

}  // namespace

KrylovSummary solve_by_conjugate_gradients(const SparseColumns& lower,
                                           const Preconditioner& preconditioner,
                                           const RightHandSides& sides,
                                           const KrylovOptions& options, const Deadline& deadline) {
  return solve_in_ranges(options, sides.count, [&](int begin, int end, auto lanes) {
    return solve_range<lanes>(lower, preconditioner, sides, begin, end, options, deadline);
  });
}

}  // namespace airybench
