#include "solvers/base/dense_products.hpp"

#include <cblas.h>

namespace airybench {
namespace {

int length(Eigen::Index n) { return static_cast<int>(n); }
int stride(const ConstDenseBlock& A) { return length(A.outerStride()); }

CBLAS_DIAG kind_of(Diagonal diagonal) {
  return diagonal == Diagonal::unit ? CblasUnit : CblasNonUnit;
}

// y ← y + factor A x, or with Aᵀ.
void add_vector(double factor, const ConstDenseBlock& A, CBLAS_TRANSPOSE of_A, const double* x,
                double* y) {
  cblas_dgemv(CblasColMajor, of_A, length(A.rows()), length(A.cols()), factor, A.data(), stride(A),
              x, 1, 1, y, 1);
}

Eigen::VectorXd product(const ConstDenseBlock& A, CBLAS_TRANSPOSE of_A, const Eigen::VectorXd& x) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(of_A == CblasTrans ? A.cols() : A.rows());
  if (A.size() > 0) add_vector(1, A, of_A, x.data(), y.data());
  return y;
}

// C ← C + factor A B, each of them transposed where it says so.
void add(double factor, const ConstDenseBlock& A, CBLAS_TRANSPOSE of_A, const ConstDenseBlock& B,
         CBLAS_TRANSPOSE of_B, DenseBlock C) {
  if (C.size() == 0 || A.size() == 0) return;
  if (C.cols() == 1 && of_B == CblasNoTrans) {
    add_vector(factor, A, of_A, B.data(), C.data());
    return;
  }
  cblas_dgemm(CblasColMajor, of_A, of_B, length(C.rows()), length(C.cols()),
              length(of_A == CblasTrans ? A.rows() : A.cols()), factor, A.data(), stride(A),
              B.data(), stride(B), 1, C.data(), stride(C));
}

void solve(const ConstDenseBlock& L, CBLAS_SIDE side, CBLAS_TRANSPOSE of_L, Diagonal diagonal,
           DenseBlock X) {
  if (X.size() == 0) return;
  if (X.cols() == 1 && side == CblasLeft)
    cblas_dtrsv(CblasColMajor, CblasLower, of_L, kind_of(diagonal), length(L.rows()), L.data(),
                stride(L), X.data(), 1);
  else
    cblas_dtrsm(CblasColMajor, side, CblasLower, of_L, kind_of(diagonal), length(X.rows()),
                length(X.cols()), 1, L.data(), stride(L), X.data(), stride(X));
}

}  // namespace

Eigen::VectorXd times(const ConstDenseBlock& A, const Eigen::VectorXd& x) {
  return product(A, CblasNoTrans, x);
}

Eigen::VectorXd transposed_times(const ConstDenseBlock& A, const Eigen::VectorXd& x) {
  return product(A, CblasTrans, x);
}

void add_product(double factor, const ConstDenseBlock& A, const ConstDenseBlock& B, DenseBlock C) {
  add(factor, A, CblasNoTrans, B, CblasNoTrans, C);
}

void add_times_transposed(double factor, const ConstDenseBlock& A, const ConstDenseBlock& B,
                          DenseBlock C) {
  add(factor, A, CblasNoTrans, B, CblasTrans, C);
}

void add_transposed_times(double factor, const ConstDenseBlock& A, const ConstDenseBlock& B,
                          DenseBlock C) {
  add(factor, A, CblasTrans, B, CblasNoTrans, C);
}

void add_square(double factor, const ConstDenseBlock& A, DenseBlock C) {
  if (A.rows() <= few_rows)
    add(factor, A, CblasNoTrans, A, CblasTrans, C);
  else
    cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, length(A.rows()), length(A.cols()), factor,
                A.data(), stride(A), 1, C.data(), stride(C));
}

void solve_lower(const ConstDenseBlock& L, DenseBlock X, Diagonal diagonal) {
  solve(L, CblasLeft, CblasNoTrans, diagonal, X);
}

void solve_lower_transposed(const ConstDenseBlock& L, DenseBlock X, Diagonal diagonal) {
  solve(L, CblasLeft, CblasTrans, diagonal, X);
}

void solve_lower_transposed_right(const ConstDenseBlock& L, DenseBlock X, Diagonal diagonal) {
  solve(L, CblasRight, CblasTrans, diagonal, X);
}

}  // namespace airybench
