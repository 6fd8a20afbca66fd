#include "solvers/direct/dense_factors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <utility>

#include "solvers/base/solution.hpp"
#include "solvers/direct/per_processor.hpp"

// Of LAPACK, which brings no header. Triangle "L": the lower one.
extern "C" {
void dpotri_(const char* triangle, const int* n, double* matrix, const int* stride, int* info,
             std::size_t length_of_triangle);
void dgesv_(const int* n, const int* columns, double* matrix, const int* stride, int* pivots,
            double* right, const int* right_stride, int* info);
void dsgesv_(const int* n, const int* columns, double* matrix, const int* stride, int* pivots,
             const double* b, const int* b_stride, double* x, const int* x_stride, double* residual,
             float* rounded, int* refinements, int* info);
}

namespace airybench {
namespace {

constexpr int narrow = 8;  // columns

bool factorise_narrow(DenseBlock A) {
  const Eigen::Index n = A.cols();
  for (Eigen::Index k = 0; k < n; ++k) {
    auto column = A.col(k).tail(n - k);
    for (Eigen::Index j = 0; j < k; ++j) column -= A(k, j) * A.col(j).tail(n - k);
    if (!(column(0) > 0) || std::isinf(column(0))) return false;
    column /= std::sqrt(column(0));
  }
  return true;
}

// X ← X L⁻ᵀ of up to `narrow` columns, eight rows at a time: those that are not there are those of
// the identity.
AIRYBENCH_PER_PROCESSOR
void divide_rows(const double* L, std::ptrdiff_t stride, std::ptrdiff_t columns, double* X,
                 std::ptrdiff_t rows) {
  constexpr int lanes = 8;
  typedef double Rows __attribute__((vector_size(lanes * sizeof(double))));
  double factor[narrow][narrow] = {};
  double reciprocal[narrow];
  for (int k = 0; k < narrow; ++k) {
    for (int j = 0; j < k && k < columns; ++j) factor[k][j] = L[k + j * stride];
    reciprocal[k] = k < columns ? 1 / L[k + k * stride] : 1;
  }
  for (std::ptrdiff_t i = 0; i < rows; i += lanes) {
    const std::size_t bytes = std::min<std::size_t>(lanes, rows - i) * sizeof(double);
    Rows x[narrow] = {};
    for (int k = 0; k < columns; ++k) std::memcpy(&x[k], X + i + k * stride, bytes);
    for (int k = 0; k < narrow; ++k) {
      for (int j = 0; j < k; ++j) x[k] -= factor[k][j] * x[j];
      x[k] *= reciprocal[k];
    }
    for (int k = 0; k < columns; ++k) std::memcpy(X + i + k * stride, &x[k], bytes);
  }
}

}  // namespace

Eigen::MatrixXd cholesky(Eigen::MatrixXd matrix, const std::string& name) {
  if (!factorise_in_place(matrix)) throw Breakdown(name + " is not positive definite to rounding");
  return matrix;
}

void solve_by_cholesky(const ConstDenseBlock& L, DenseBlock X) {
  solve_lower(L, X);
  solve_lower_transposed(L, X);
}

bool factorise_in_place(DenseBlock A) {
  const Eigen::Index n = A.cols(), below = A.rows() - n;
  if (n <= narrow) {
    if (!factorise_narrow(A.topRows(n))) return false;
    divide_rows(A.data(), A.outerStride(), n, A.data() + n, below);
    return true;
  }
  const Eigen::Index half = (n / 2 + narrow - 1) / narrow * narrow, rest = n - half;
  if (!factorise_in_place(A.leftCols(half))) return false;
  DenseBlock top = A.block(half, 0, rest, half), bottom = A.block(n, 0, below, half);
  if (rest > few_rows) {
    add_square(-1, top, A.block(half, half, rest, rest));
    add_times_transposed(-1, bottom, top, A.block(n, half, below, rest));
  } else {
    add_times_transposed(-1, A.bottomLeftCorner(rest + below, half), top,
                         A.bottomRightCorner(rest + below, rest));
  }
  return factorise_in_place(A.bottomRightCorner(rest + below, rest));
}

Eigen::MatrixXd inverse_from_factor(Eigen::MatrixXd L) {
  const int n = static_cast<int>(L.rows());
  int info = 0;
  if (n > 0) dpotri_("L", &n, L.data(), &n, &info, 1);
  if (info != 0)
    throw Breakdown("dense Cholesky factor: zero at " + std::to_string(info) + " on its diagonal");
  for (int j = 0; j < n; ++j) L.row(j).tail(n - j - 1) = L.col(j).tail(n - j - 1).transpose();
  return L;
}

Eigen::VectorXd solve_by_lu(Eigen::MatrixXd A, Eigen::VectorXd b) {
  constexpr int worth_rounding = 128;  // below, conversions cost what floats save
  constexpr int max_rounded = 46340;   // dsgesv counts n² in an int
  const auto n = static_cast<int>(A.rows());
  if (n == 0) return b;
  Eigen::VectorXi pivots(n);
  const int columns = 1;
  int info = 0;
  if (n < worth_rounding || n > max_rounded) {
    dgesv_(&n, &columns, A.data(), &n, pivots.data(), b.data(), &n, &info);
  } else {
    Eigen::VectorXd x(n), residual(n);
    Eigen::VectorXf rounded(static_cast<Eigen::Index>(n) * (n + columns));
    int refinements = 0;
    dsgesv_(&n, &columns, A.data(), &n, pivots.data(), b.data(), &n, x.data(), &n, residual.data(),
            rounded.data(), &refinements, &info);
    b = std::move(x);
  }
  if (info != 0) b.setConstant(std::numeric_limits<double>::quiet_NaN());
  return b;
}

}  // namespace airybench
