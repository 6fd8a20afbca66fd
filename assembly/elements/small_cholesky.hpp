// Cholesky factorisation S = L Lᵀ of a small matrix, and the loops that elements are made of. They
// run over plain arrays: every expression of Eigen costs a compiler 30 ms per size and scalar, and
// elements have dozens of both.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "assembly/elements/exact_data.hpp"

namespace airybench {

// Σ a_i b_i by four sums, so that no addition waits for the previous one.
template <typename Number, typename Scalar>
Scalar in_four_sums(const Number* a, const Scalar* b, int first, int end) {
  constexpr int sums = 4;
  Scalar sum[sums] = {0, 0, 0, 0};
  int i = first;
  for (; i + sums <= end; i += sums)
    for (int s = 0; s < sums; ++s) sum[s] += a[i + s] * b[i + s];
  for (; i < end; ++i) sum[0] += a[i] * b[i];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

// y += Σ_j a(j) x_j of `count` vectors of length n that begin `step` entries apart, in this order.
// Four at a time, so that y is loaded and stored for every fourth only.
template <typename Scalar, typename Number, typename Factor>
void add_multiples(Scalar* __restrict y, int n, int count, Factor a, const Number* __restrict x,
                   int step) {
  int j = 0;
  for (; j + 4 <= count; j += 4, x += 4 * step) {
    const Scalar a0 = a(j), a1 = a(j + 1), a2 = a(j + 2), a3 = a(j + 3);
    for (int i = 0; i < n; ++i)
      y[i] =
          (((y[i] + a0 * x[i]) + a1 * x[step + i]) + a2 * x[2 * step + i]) + a3 * x[3 * step + i];
  }
  for (; j < count; ++j, x += step) {
    const Scalar a0 = a(j);
    for (int i = 0; i < n; ++i) y[i] += a0 * x[i];
  }
}

// C = A B of `count` columns of three.
template <typename Scalar>
void transform_columns(const Eigen::Matrix3<Scalar>& A, const Scalar* B, int count, Scalar* C) {
  for (int j = 0; j < count; ++j, B += 3, C += 3)
    for (int i = 0; i < 3; ++i) C[i] = A(i, 0) * B[0] + A(i, 1) * B[1] + A(i, 2) * B[2];
}

template <typename Scalar, int n>
class SmallCholesky {
 public:
  SmallCholesky() {
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) L_(i, j) = 0;
  }
  // S: symmetric; its lower triangle is read.
  explicit SmallCholesky(const Eigen::Matrix<Scalar, n, n>& S) : SmallCholesky() {
    using std::min;
    using std::sqrt;
    for (int c = 0; c < n; ++c) {  // down columns, which lie in one piece
      for (int i = c; i < n; ++i) L_(i, c) = S(i, c);
      add_multiples(
          &L_(c, c), n - c, c, [&](int j) { return -L_(c, j); }, &L_(c, 0), n);
      L_(c, c) = sqrt(L_(c, c));
      reciprocal_(c) = 1 / L_(c, c);
      independence_ = min(Scalar(L_(c, c) / sqrt(S(c, c))), independence_);
      for (int i = c + 1; i < n; ++i) L_(i, c) *= reciprocal_(c);
    }
  }
  // S = MᵀM without forming it, which would square M's condition number: M = Q Lᵀ by modified
  // Gram–Schmidt (Björck 1967, doi:10.1007/BF01934122).
  template <int rows>
  static SmallCholesky of_root(Eigen::Matrix<Scalar, rows, n> M) {
    using std::min;
    using std::sqrt;
    SmallCholesky result;
    Scalar length[n];
    for (int j = 0; j < n; ++j) length[j] = sqrt(dot(M, j, j));
    for (int j = 0; j < n; ++j) {
      result.L_(j, j) = sqrt(dot(M, j, j));
      const Scalar reciprocal = 1 / result.L_(j, j);
      result.reciprocal_(j) = reciprocal;
      result.independence_ = min(Scalar(result.L_(j, j) / length[j]), result.independence_);
      for (int m = 0; m < rows; ++m) M(m, j) *= reciprocal;
      for (int i = j + 1; i < n; ++i) {
        const Scalar along = dot(M, j, i);
        result.L_(i, j) = along;
        for (int m = 0; m < rows; ++m) M(m, i) -= along * M(m, j);
      }
    }
    return result;
  }
  // The smallest sine of the angle between a column of M and those before it, in S = MᵀM. Below a
  // few roundings they are dependent, and S is not positive definite. In the order above min()
  // keeps a NaN, which the later columns have, too.
  const Scalar& independence() const { return independence_; }
  // Positive if S is positive definite to rounding: after a pivot that is not positive, none is.
  const Scalar& last_pivot() const { return L_(n - 1, n - 1); }
  const Eigen::Matrix<Scalar, n, n>& L() const { return L_; }
  const Eigen::Matrix<Scalar, n, 1>& reciprocal() const { return reciprocal_; }  // of its diagonal

  // a where it is true, else b: of packs (solvers/base/pack.hpp), lane by lane.
  template <typename Truth>
  static SmallCholesky chosen(const Truth& truth, const SmallCholesky& a, const SmallCholesky& b) {
    SmallCholesky result;
    for (int j = 0; j < n; ++j) {
      for (int i = j; i < n; ++i) result.L_(i, j) = select(truth, a.L_(i, j), b.L_(i, j));
      result.reciprocal_(j) = select(truth, a.reciprocal_(j), b.reciprocal_(j));
    }
    result.independence_ = select(truth, a.independence_, b.independence_);
    return result;
  }

  // x ← S⁻¹ x, L⁻¹ x, L⁻ᵀ x.
  void solve(Scalar* x) const {
    solve_lower(x);
    solve_upper(x);
  }
  void solve_lower(Scalar* x) const {
    for (int i = 0; i < n; ++i) {
      x[i] *= reciprocal_(i);
      for (int k = i + 1; k < n; ++k) x[k] -= L_(k, i) * x[i];
    }
  }
  void solve_upper(Scalar* x) const {
    for (int i = n - 1; i >= 0; --i) {
      x[i] -= in_four_sums(&L_(0, i), x, i + 1, n);
      x[i] *= reciprocal_(i);
    }
  }
  // The same of columns.
  template <int columns>
  void solve(Eigen::Matrix<Scalar, n, columns>& X) const {
    for (int c = 0; c < columns; ++c) solve(&X(0, c));
  }
  template <int columns>
  void solve_lower(Eigen::Matrix<Scalar, n, columns>& X) const {
    for (int c = 0; c < columns; ++c) solve_lower(&X(0, c));
  }

 private:
  template <int rows>
  static Scalar dot(const Eigen::Matrix<Scalar, rows, n>& M, int a, int b) {
    return in_four_sums(&M(0, a), &M(0, b), 0, rows);
  }

  Eigen::Matrix<Scalar, n, n> L_;
  Eigen::Matrix<Scalar, n, 1> reciprocal_;
  Scalar independence_ = 1;
};

// R of MᵀM = RᵀR, upper triangular, of a matrix whose size is known when it runs; by modified
// Gram–Schmidt, as SmallCholesky::of_root.
template <typename Scalar>
class GramRoot {
 public:
  GramRoot() = default;
  explicit GramRoot(Eigen::MatrixX<Scalar> M)
      : R_(Eigen::MatrixX<Scalar>::Zero(M.cols(), M.cols())) {
    using std::min;
    using std::sqrt;
    const int rows = static_cast<int>(M.rows()), n = static_cast<int>(M.cols());
    const auto dot = [&](int a, int b) {
      return in_four_sums(M.data() + a * rows, M.data() + b * rows, 0, rows);
    };
    std::vector<Scalar> length;
    for (int j = 0; j < n; ++j) length.push_back(sqrt(dot(j, j)));
    for (int j = 0; j < n; ++j) {
      R_(j, j) = sqrt(dot(j, j));
      independence_ = min(Scalar(R_(j, j) / length[j]), independence_);
      for (int m = 0; m < rows; ++m) M(m, j) /= R_(j, j);
      for (int i = j + 1; i < n; ++i) {
        R_(j, i) = dot(j, i);
        for (int m = 0; m < rows; ++m) M(m, i) -= R_(j, i) * M(m, j);
      }
    }
  }
  const Eigen::MatrixX<Scalar>& R() const { return R_; }
  const Scalar& independence() const { return independence_; }

  // x ← R⁻ᵀ x, (RᵀR)⁻¹ x.
  void solve_lower(Scalar* x) const {
    for (int i = 0; i < size(); ++i) {
      for (int k = 0; k < i; ++k) x[i] -= R_(k, i) * x[k];
      x[i] /= R_(i, i);
    }
  }
  void solve(Scalar* x) const {
    solve_lower(x);
    for (int i = size() - 1; i >= 0; --i) {
      for (int k = i + 1; k < size(); ++k) x[i] -= R_(i, k) * x[k];
      x[i] /= R_(i, i);
    }
  }

 private:
  int size() const { return static_cast<int>(R_.cols()); }

  Eigen::MatrixX<Scalar> R_;
  Scalar independence_ = 1;
};

}  // namespace airybench
