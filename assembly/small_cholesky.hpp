// Cholesky factorisation S = L Lᵀ of a small matrix. Eigen's, made for large ones too, costs
// seconds of compile time per scalar.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace airybench {

// Σ a_i b_i by four sums, so that no addition waits for the previous one.
template <typename Scalar>
Scalar in_four_sums(const Scalar* a, const Scalar* b, int first, int end) {
  constexpr int sums = 4;
  Scalar sum[sums] = {0, 0, 0, 0};
  int i = first;
  for (; i + sums <= end; i += sums)
    for (int s = 0; s < sums; ++s) sum[s] += a[i + s] * b[i + s];
  for (; i < end; ++i) sum[0] += a[i] * b[i];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

template <typename Scalar, int n>
class SmallCholesky {
 public:
  SmallCholesky() = default;
  // S: symmetric; its lower triangle is read.
  explicit SmallCholesky(const Eigen::Matrix<Scalar, n, n>& S) {
    using std::sqrt;
    for (int j = 0; j < n; ++j)
      for (int i = j; i < n; ++i) L_(i, j) = S(i, j);
    for (int j = 0; j < n; ++j) {  // down columns, which lie in one piece
      L_(j, j) = sqrt(L_(j, j));
      reciprocal_(j) = 1 / L_(j, j);
      for (int i = j + 1; i < n; ++i) L_(i, j) *= reciprocal_(j);
      for (int c = j + 1; c < n; ++c)
        for (int i = c; i < n; ++i) L_(i, c) -= L_(c, j) * L_(i, j);
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
        X(i, c) *= reciprocal_(i);
        for (int k = i + 1; k < n; ++k) X(k, c) -= L_(k, i) * X(i, c);
      }
  }
  template <int columns>
  void solve_upper(Eigen::Matrix<Scalar, n, columns>& X) const {
    for (int c = 0; c < columns; ++c)
      for (int i = n - 1; i >= 0; --i) {
        X(i, c) -= in_four_sums(&L_(0, i), &X(0, c), i + 1, n);
        X(i, c) *= reciprocal_(i);
      }
  }

 private:
  template <int rows>
  static Scalar dot(const Eigen::Matrix<Scalar, rows, n>& M, int a, int b) {
    return in_four_sums(&M(0, a), &M(0, b), 0, rows);
  }

  Eigen::Matrix<Scalar, n, n> L_ = Eigen::Matrix<Scalar, n, n>::Zero();
  Eigen::Matrix<Scalar, n, 1> reciprocal_;  // of L's diagonal
  Scalar independence_ = 1;
};

}  // namespace airybench
