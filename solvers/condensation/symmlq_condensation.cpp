#include "solvers/condensation/symmlq_condensation.hpp"

#include <memory>

#include "solvers/condensation/three_step.hpp"
#include "solvers/direct/dense_factors.hpp"
#include "solvers/krylov/symmetric_product.hpp"

namespace airybench {
namespace {

// y += C x and y += Cᵀ x on lanes, x and y where the rows and columns of C begin.
template <int lanes>
void multiply(const SparseRows& C, const double* x, double* y) {
  for (int i = 0; i < C.rows(); ++i)
    for (SparseRows::InnerIterator entry(C, i); entry; ++entry)
      for (int l = 0; l < lanes; ++l)
        y[i * lanes + l] += entry.value() * x[entry.col() * lanes + l];
}
template <int lanes>
void multiply_transposed(const SparseRows& C, const double* x, double* y) {
  for (int i = 0; i < C.rows(); ++i)
    for (SparseRows::InnerIterator entry(C, i); entry; ++entry)
      for (int l = 0; l < lanes; ++l)
        y[entry.col() * lanes + l] += entry.value() * x[i * lanes + l];
}

// L Lᵀ = C S*⁻¹ Cᵀ, dense, some columns at once.
Eigen::MatrixXd factor_schur(const AirySystem& system, const Preconditioner& S_star, int threads,
                             const Deadline& deadline) {
  constexpr int lanes = max_lanes;
  const int n = system.n(), m = system.n_f() + system.n_c();
  Eigen::MatrixXd K(m, m);
  in_parallel(threads, m, [&](int begin, int end) {
    const Apply apply = S_star.applier(lanes);
    LaneBlock X(n, lanes);
    for (int first = begin; first < end; first += lanes) {
      const int columns = std::min(lanes, end - first);
      X.setZero();
      for (int l = 0; l < columns; ++l)
        for (auto entry = constraint_row(system, first + l); entry; ++entry)
          X(entry.col(), l) = entry.value();
      apply(X);
      for (int i = 0; i < m; ++i)
        for (int l = 0; l < columns; ++l) {
          double sum = 0;
          for (auto entry = constraint_row(system, i); entry; ++entry)
            sum += entry.value() * X(entry.col(), l);
          K(i, first + l) = sum;
        }
      deadline.check("the Schur block");
    }
  });
  K = ((K + K.transpose()) / 2).eval();
  if (!factorise_in_place(K)) throw Breakdown("SYMMLQ: the Schur block is not positive definite");
  return K;
}

}  // namespace

SymmetricOperator saddle_operator(const AirySystem& system) {
  const Eigen::Index n = system.n();
  return {n + system.n_f() + system.n_c(), [&system, n](const LaneBlock& X, LaneBlock& Y) {
            Y.setZero();
            with_lanes(X.cols(), [&](auto lanes) {
              symmetric_product<lanes>(system.S, X.data(), Y.data());
              const Eigen::Index at_F = n * lanes, at_C = at_F + system.n_f() * lanes;
              multiply<lanes>(system.C_F, X.data(), Y.data() + at_F);
              multiply<lanes>(system.C_C, X.data(), Y.data() + at_C);
              multiply_transposed<lanes>(system.C_F, X.data() + at_F, Y.data());
              multiply_transposed<lanes>(system.C_C, X.data() + at_C, Y.data());
            });
          }};
}

Preconditioner saddle_preconditioner(const AirySystem& system, const Preconditioner& S_star,
                                     int threads, const Deadline& deadline) {
  const auto factor =
      std::make_shared<const Eigen::MatrixXd>(factor_schur(system, S_star, threads, deadline));
  const Eigen::Index n = system.n(), m = system.n_f() + system.n_c();
  Preconditioner result = S_star;
  result.applier = [factor, n, m, S_star](int lanes) -> Apply {
    return [factor, n, m, apply = S_star.applier(lanes), top = LaneBlock(n, lanes),
            columns = Eigen::MatrixXd(m, lanes)](LaneBlock& X) mutable {
      top = X.topRows(n);
      apply(top);
      X.topRows(n) = top;
      columns = X.bottomRows(m);
      solve_by_cholesky(*factor, columns);
      X.bottomRows(m) = columns;
    };
  };
  result.bytes += static_cast<std::size_t>(factor->size()) * sizeof(double);
  result.entries += m * (m + 1) / 2;  // the lower triangle
  result.workspace_rows += n + m;
  return result;
}

}  // namespace airybench
