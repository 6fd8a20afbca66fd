// Cholesky factorisation S = L Lᵀ of a small matrix. Eigen's, made for large ones too, costs
// seconds of compile time per scalar.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace airybench {

template <typename Scalar, int n>
class SmallCholesky {
 public:
  SmallCholesky() = default;
  // S: symmetric; its lower triangle is read.
  explicit SmallCholesky(const Eigen::Matrix<Scalar, n, n>& S) {
    using std::sqrt;
    for (int j = 0; j < n; ++j) {
      Scalar pivot = 0;
      for (int k = 0; k < j; ++k) pivot += L_(j, k) * L_(j, k);
      L_(j, j) = sqrt(S(j, j) - pivot);
      for (int i = j + 1; i < n; ++i) {
        Scalar sum = 0;
        for (int k = 0; k < j; ++k) sum += L_(i, k) * L_(j, k);
        L_(i, j) = (S(i, j) - sum) / L_(j, j);
      }
      reciprocal_(j) = 1 / L_(j, j);
    }
  }
  // S = MᵀM without forming it, which would square M's condition number: M = Q Lᵀ by modified
  // Gram–Schmidt (Björck 1967, doi:10.1007/BF01934122).
  template <int rows>
  static SmallCholesky of_root(Eigen::Matrix<Scalar, rows, n> M) {
    using std::min;
    using std::sqrt;
    SmallCholesky result;
    Eigen::Matrix<Scalar, n, 1> length;
    for (int j = 0; j < n; ++j) length(j) = sqrt(dot(M, j, j));
    for (int j = 0; j < n; ++j) {
      result.L_(j, j) = sqrt(dot(M, j, j));
      result.reciprocal_(j) = 1 / result.L_(j, j);
      // In this order min() keeps a NaN, which the later columns have, too.
      result.independence_ = min(Scalar(result.L_(j, j) / length(j)), result.independence_);
      M.col(j) *= result.reciprocal_(j);
      for (int i = j + 1; i < n; ++i) {
        result.L_(i, j) = dot(M, j, i);
        M.col(i) -= result.L_(i, j) * M.col(j);
      }
    }
    return result;
  }
  // The smallest sine of the angle between a column of M and those before it. Below a few roundings
  // they are dependent, and S is not positive definite.
  const Scalar& independence() const { return independence_; }
  // Positive if S is positive definite to rounding: after a pivot that is not positive, none is.
  const Scalar& last_pivot() const { return L_(n - 1, n - 1); }
  const Eigen::Matrix<Scalar, n, n>& L() const { return L_; }

  // X ← S⁻¹ X, L⁻¹ X, L⁻ᵀ X.
  template <int columns>
  void solve(Eigen::Matrix<Scalar, n, columns>& X) const {
    solve_lower(X);
    solve_upper(X);
  }
  template <int columns>
  void solve_lower(Eigen::Matrix<Scalar, n, columns>& X) const {
    for (int c = 0; c < columns; ++c)
      for (int i = 0; i < n; ++i) {
        for (int k = 0; k < i; ++k) X(i, c) -= L_(i, k) * X(k, c);
        X(i, c) *= reciprocal_(i);
      }
  }
  template <int columns>
  void solve_upper(Eigen::Matrix<Scalar, n, columns>& X) const {
    for (int c = 0; c < columns; ++c)
      for (int i = n - 1; i >= 0; --i) {
        for (int k = i + 1; k < n; ++k) X(i, c) -= L_(k, i) * X(k, c);
        X(i, c) *= reciprocal_(i);
      }
  }

 private:
  // Four independent sums, so that no addition waits for the previous one.
  template <int rows>
  static Scalar dot(const Eigen::Matrix<Scalar, rows, n>& M, int a, int b) {
    constexpr int sums = 4;
    Scalar sum[sums] = {0, 0, 0, 0};
    for (int i = 0; i < rows; ++i) sum[i % sums] += M(i, a) * M(i, b);
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
  }

  Eigen::Matrix<Scalar, n, n> L_ = Eigen::Matrix<Scalar, n, n>::Zero();
  Eigen::Matrix<Scalar, n, 1> reciprocal_;  // of L's diagonal
  Scalar independence_ = 1;
};

}  // namespace airybench
