#include "tests/support/dense_algebra.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

extern "C" {
void dgels_(const char* trans, const int* m, const int* n, const int* columns, double* a,
            const int* lda, double* b, const int* ldb, double* work, const int* lwork, int* info,
            std::size_t length_of_trans);
void dgeqp3_(const int* m, const int* n, double* a, const int* lda, int* pivots, double* tau,
             double* work, const int* lwork, int* info);
void dgeqrf_(const int* m, const int* n, double* a, const int* lda, double* tau, double* work,
             const int* lwork, int* info);
void dgetrf_(const int* m, const int* n, double* a, const int* lda, int* pivots, int* info);
void dgetrs_(const char* trans, const int* n, const int* columns, const double* a, const int* lda,
             const int* pivots, double* b, const int* ldb, int* info, std::size_t length_of_trans);
void dorgqr_(const int* m, const int* n, const int* k, double* a, const int* lda, const double* tau,
             double* work, const int* lwork, int* info);
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info,
             std::size_t length_of_uplo);
void dsyev_(const char* jobz, const char* uplo, const int* n, double* a, const int* lda,
            double* eigenvalues, double* work, const int* lwork, int* info,
            std::size_t length_of_jobz, std::size_t length_of_uplo);
}

namespace airybench::testing {
namespace {

struct Shape {
  int rows, columns;
  explicit Shape(const Eigen::MatrixXd& A)
      : rows(static_cast<int>(A.rows())), columns(static_cast<int>(A.cols())) {}
};

// LAPACK's, ample for its blocked variants.
struct Work : std::vector<double> {
  int count;
  explicit Work(const Shape& of)
      : std::vector<double>(64 * static_cast<std::size_t>(1 + std::max(of.rows, of.columns))),
        count(static_cast<int>(size())) {}
};

void demand(int info, const char* routine) {
  if (info != 0)
    throw std::runtime_error(std::string(routine) + " ended with info = " + std::to_string(info));
}

}  // namespace

double distance(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) { return (A - B).norm(); }

double residual(const Eigen::MatrixXd& A, const Eigen::MatrixXd& X, const Eigen::MatrixXd& B) {
  return distance(A * X, B);
}

Eigen::VectorXd eigenvalues(Eigen::MatrixXd A) {
  const Shape shape(A);
  Eigen::VectorXd values(shape.rows);
  Work work(shape);
  int info = 0;
  dsyev_("N", "L", &shape.rows, A.data(), &shape.rows, values.data(), work.data(), &work.count,
         &info, 1, 1);
  demand(info, "dsyev");
  return values;
}

Eigen::MatrixXd with_eigenvalues(const Eigen::MatrixXd& Q, const Eigen::VectorXd& values) {
  const Eigen::MatrixXd A = Q * values.asDiagonal() * Q.transpose();
  return (A + A.transpose()) / 2;
}

Eigen::MatrixXd orthogonal_factor(Eigen::MatrixXd A) {
  const Shape shape(A);
  Work work(shape);
  std::vector<double> tau(static_cast<std::size_t>(shape.columns));
  int info = 0;
  dgeqrf_(&shape.rows, &shape.columns, A.data(), &shape.rows, tau.data(), work.data(), &work.count,
          &info);
  demand(info, "dgeqrf");
  dorgqr_(&shape.rows, &shape.columns, &shape.columns, A.data(), &shape.rows, tau.data(),
          work.data(), &work.count, &info);
  demand(info, "dorgqr");
  return A;
}

Eigen::MatrixXd cholesky_factor(Eigen::MatrixXd A) {
  const Shape shape(A);
  int info = 0;
  dpotrf_("L", &shape.rows, A.data(), &shape.rows, &info, 1);
  demand(info, "dpotrf");
  for (int j = 1; j < shape.columns; ++j) A.col(j).head(j).setZero();
  return A;
}

std::function<Eigen::MatrixXd(Eigen::MatrixXd B)> factorised(Eigen::MatrixXd A) {
  const Shape shape(A);
  std::vector<int> pivots(static_cast<std::size_t>(shape.rows));
  int info = 0;
  dgetrf_(&shape.rows, &shape.rows, A.data(), &shape.rows, pivots.data(), &info);
  demand(std::min(info, 0), "dgetrf");  // a pivot of zero makes what is solved infinite
  return [lu = std::move(A), pivots = std::move(pivots), n = shape.rows](Eigen::MatrixXd B) {
    const int columns = static_cast<int>(B.cols());
    int status = 0;
    dgetrs_("N", &n, &columns, lu.data(), &n, pivots.data(), B.data(), &n, &status, 1);
    demand(status, "dgetrs");
    return B;
  };
}

Eigen::MatrixXd solved(Eigen::MatrixXd A, Eigen::MatrixXd B) {
  return factorised(std::move(A))(std::move(B));
}

Eigen::VectorXd least_squares(Eigen::MatrixXd A, Eigen::VectorXd b) {
  const Shape shape(A);
  Work work(shape);
  const int columns = 1;
  int info = 0;
  dgels_("N", &shape.rows, &shape.columns, &columns, A.data(), &shape.rows, b.data(), &shape.rows,
         work.data(), &work.count, &info, 1);
  demand(info, "dgels");
  return b.head(shape.columns);
}

int rank(Eigen::MatrixXd A) {
  const Shape shape(A);
  Work work(shape);
  const int most = std::min(shape.rows, shape.columns);
  std::vector<int> pivots(static_cast<std::size_t>(shape.columns), 0);
  std::vector<double> tau(static_cast<std::size_t>(most));
  int info = 0;
  dgeqp3_(&shape.rows, &shape.columns, A.data(), &shape.rows, pivots.data(), tau.data(),
          work.data(), &work.count, &info);
  demand(info, "dgeqp3");
  int found = 0;
  const double rounding = most * std::numeric_limits<double>::epsilon();
  while (found < most && std::abs(A(found, found)) > rounding * std::abs(A(0, 0))) ++found;
  return found;
}

}  // namespace airybench::testing
