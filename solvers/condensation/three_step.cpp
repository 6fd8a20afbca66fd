#include "solvers/condensation/three_step.hpp"

#include <algorithm>
#include <numeric>

namespace airybench {
namespace {

// Row k of [C_F; C_C].
SparseRows::InnerIterator constraint_row(const DualSystem& system, int k) {
  return k < system.n_f() ? SparseRows::InnerIterator(system.C_F, k)
                          : SparseRows::InnerIterator(system.C_C, k - system.n_f());
}

// Rows of [C_F; C_C] in the order of their first unknown, so that neighbouring right-hand sides
// share their leading zeros.
std::vector<int> rows_by_first_unknown(const DualSystem& system) {
  std::vector<int> rows(static_cast<std::size_t>(system.n_f() + system.n_c()));
  std::iota(rows.begin(), rows.end(), 0);
  std::vector<int> first(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto entry = constraint_row(system, static_cast<int>(k));
    first[k] = entry ? static_cast<int>(entry.col()) : 0;
  }
  std::stable_sort(rows.begin(), rows.end(), [&](int a, int b) { return first[a] < first[b]; });
  return rows;
}

// C_block X, with the columns back in the order of [C_F; C_C].
Eigen::MatrixXd constraint_times(const SparseRows& C, const ThreeStep& steps) {
  const Eigen::MatrixXd product = C * steps.X;
  Eigen::MatrixXd ordered(product.rows(), product.cols());
  for (Eigen::Index k = 0; k < product.cols(); ++k)
    ordered.col(steps.row_of_column[static_cast<std::size_t>(k)]) = product.col(k);
  return ordered;
}

Eigen::LLT<Eigen::MatrixXd> cholesky(const Eigen::MatrixXd& matrix, const char* name) {
  Eigen::LLT<Eigen::MatrixXd> llt(matrix);
  if (llt.info() != Eigen::Success || !matrix.allFinite())
    throw Breakdown(std::string("three-step condensation: ") + name +
                    " is not positive definite to rounding");
  return llt;
}

// C v, or zero where v is empty.
Eigen::VectorXd times_or_zero(const SparseRows& C, const Eigen::VectorXd& v) {
  return v.size() > 0 ? Eigen::VectorXd(C * v) : Eigen::VectorXd::Zero(C.rows());
}

}  // namespace

std::size_t ThreeStep::bytes() const {
  return static_cast<std::size_t>(X.size() + x.size() + K_FF_inverse_K_FC.size() +
                                  condensed.D.size()) *
         sizeof(double);
}

ThreeStep condense_in_three_steps(const DualSystem& system, const SolveInPlace& solve) {
  const int n_f = system.n_f(), n_c = system.n_c();
  ThreeStep steps;

  // Step 1.
  steps.row_of_column = rows_by_first_unknown(system);
  steps.X.setZero(system.n(), n_f + n_c);
  for (int k = 0; k < n_f + n_c; ++k)
    for (auto entry = constraint_row(system, steps.row_of_column[k]); entry; ++entry)
      steps.X(entry.col(), k) = entry.value();
  solve(steps.X);
  if (system.q.size() > 0) {
    steps.x = system.q;
    solve(steps.x);
  }

  // Step 2.
  Eigen::MatrixXd K_C;  // [K_CF K_CC]
  if (n_c > 0) K_C = constraint_times(system.C_C, steps);
  if (n_f > 0) {
    const Eigen::MatrixXd K_F = constraint_times(system.C_F, steps);
    const auto llt = cholesky((K_F.leftCols(n_f) + K_F.leftCols(n_f).transpose()) / 2, "K_FF");
    if (n_c > 0) steps.K_FF_inverse_K_FC = llt.solve(K_F.rightCols(n_c));
    if (system.q.size() > 0 || system.F.size() > 0) {
      steps.lambda_0 = times_or_zero(system.C_F, steps.x);
      if (system.F.size() > 0) steps.lambda_0 -= system.F;
      steps.lambda_0 = llt.solve(steps.lambda_0);
    }
  }

  // Step 3.
  if (n_c > 0) {
    Eigen::MatrixXd W = K_C.rightCols(n_c);
    Eigen::VectorXd g = times_or_zero(system.C_C, steps.x);
    if (system.F0.size() > 0) g += system.F0;
    if (n_f > 0) W.noalias() -= K_C.leftCols(n_f) * steps.K_FF_inverse_K_FC;
    if (steps.lambda_0.size() > 0) g.noalias() -= K_C.leftCols(n_f) * steps.lambda_0;
    const auto llt = cholesky((W + W.transpose()) / 2, "W");
    const Eigen::MatrixXd inverse = llt.solve(Eigen::MatrixXd::Identity(n_c, n_c));
    steps.condensed.D = (inverse + inverse.transpose()) / 2;
    steps.condensed.G = llt.solve(g);
  }
  return steps;
}

Eigen::VectorXd recover_airy_unknowns(const ThreeStep& steps, const DualSystem& system,
                                      const Eigen::VectorXd& F_C) {
  const int n_f = system.n_f(), n_c = system.n_c();
  Eigen::VectorXd multipliers = Eigen::VectorXd::Zero(n_f + n_c);  // λ, λ'
  if (n_c > 0) multipliers.tail(n_c) = steps.condensed.G - steps.condensed.D * F_C;
  if (n_f > 0) {
    if (steps.lambda_0.size() > 0) multipliers.head(n_f) = steps.lambda_0;
    if (n_c > 0) multipliers.head(n_f).noalias() -= steps.K_FF_inverse_K_FC * multipliers.tail(n_c);
  }
  Eigen::VectorXd by_column(multipliers.size());
  for (Eigen::Index k = 0; k < by_column.size(); ++k)
    by_column(k) = multipliers(steps.row_of_column[static_cast<std::size_t>(k)]);
  Eigen::VectorXd unknowns =
      steps.x.size() > 0 ? steps.x : Eigen::VectorXd(Eigen::VectorXd::Zero(system.n()));
  unknowns.noalias() -= steps.X * by_column;
  return unknowns;
}

}  // namespace airybench
