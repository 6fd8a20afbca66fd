#include "solvers/condensation/symmlq_condensation.hpp"

#include <memory>

#include "solvers/condensation/three_step.hpp"
#include "solvers/direct/dense_factors.hpp"
#include "solvers/krylov/symmetric_product.hpp"
#include "solvers/preconditioners/drop_tolerance.hpp"

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

// C S*⁻¹ Cᵀ, dense, column by column.
Eigen::MatrixXd dense_schur(const AirySystem& system, const Preconditioner& S_star, int lanes,
                            int threads, const Deadline& deadline) {
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
  return (K + K.transpose()) / 2;
}

struct SchurFactor {
  Eigen::MatrixXd dense;    // L, or
  IncompleteFactor sparse;  // complete
  std::size_t bytes() const {
    return static_cast<std::size_t>(dense.size()) * sizeof(double) + sparse.bytes();
  }
  std::int64_t entries() const {  // the dense one's lower triangle
    return dense.rows() * (dense.rows() + 1) / 2 + static_cast<std::int64_t>(sparse.entries());
  }
};

SchurFactor factor_schur(const AirySystem& system, const Preconditioner& S_star, SchurBlock schur,
                         int lanes, int threads, const Deadline& deadline) {
  SchurFactor factor;
  if (schur == SchurBlock::dense) {
    factor.dense = dense_schur(system, S_star, lanes, threads, deadline);
    if (!factorise_in_place(factor.dense))
      throw Breakdown("SYMMLQ: the Schur block is not positive definite");
    return factor;
  }
  SparseRows C(system.n_f() + system.n_c(), system.n());
  C.reserve(system.C_F.nonZeros() + system.C_C.nonZeros());
  for (int i = 0; i < C.rows(); ++i) {
    C.startVec(i);
    for (auto entry = constraint_row(system, i); entry; ++entry)
      C.insertBack(i, entry.col()) = entry.value();
  }
  C.finalize();
  const SparseColumns product = C * SparseRows(C.transpose());
  try {
    const SparseColumns lower = product.triangularView<Eigen::Lower>();
    factor.sparse = drop_tolerance_factor(lower, 0, deadline);
  } catch (const Breakdown&) {
    throw Breakdown("SYMMLQ: the Schur block C Cᵀ is not positive definite");
  }
  return factor;
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
                                     SchurBlock schur, int lanes, int threads,
                                     const Deadline& deadline) {
  const auto factor = std::make_shared<const SchurFactor>(
      factor_schur(system, S_star, schur, lanes, threads, deadline));
  const Eigen::Index n = system.n(), m = system.n_f() + system.n_c();
  const auto applier = [factor, n, m, S_star](int own_lanes) -> Apply {
    return [factor, n, m, apply = S_star.applier(own_lanes), top = LaneBlock(n, own_lanes),
            bottom = LaneBlock(m, own_lanes),
            columns = Eigen::MatrixXd(m, own_lanes)](LaneBlock& X) mutable {
      top = X.topRows(n);
      apply(top);
      X.topRows(n) = top;
      if (factor->dense.size() > 0) {
        columns = X.bottomRows(m);
        solve_by_cholesky(factor->dense, columns);
        X.bottomRows(m) = columns;
      } else {
        bottom = X.bottomRows(m);
        solve_in_place(factor->sparse, bottom);
        X.bottomRows(m) = bottom;
      }
    };
  };
  Preconditioner result = S_star;
  result.applier = applier;
  result.bytes += factor->bytes();
  result.entries += factor->entries();
  result.workspace_rows += n + 2 * m;
  return result;
}

}  // namespace airybench
