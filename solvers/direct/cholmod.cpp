#include "solvers/direct/cholmod.hpp"

#include <algorithm>
#include <new>

namespace airybench {
namespace {

// cholmod_solve returns a new matrix; this many columns at once keep that copy small.
constexpr Eigen::Index columns_at_once = 32;

}  // namespace

CholmodFactor::CholmodFactor() { llt_.cholmod().print = 0; }

void CholmodFactor::analyse(const Eigen::SparseMatrix<double>& lower) {
  if (lower.rows() == 0) return;
  llt_.analyzePattern(lower);
  throw_if_out_of_memory();
  bytes_ = static_cast<std::size_t>(llt_.cholmod().lnz) * sizeof(double);
}

void CholmodFactor::factor(const Eigen::SparseMatrix<double>& lower) {
  if (lower.rows() == 0) return;
  llt_.factorize(lower);
  throw_if_out_of_memory();
  if (llt_.info() != Eigen::Success)
    throw Breakdown("CHOLMOD: the matrix is not positive definite");
}

void CholmodFactor::solve_in_place(Eigen::Ref<Eigen::MatrixXd> X, const Deadline& deadline) {
  for (Eigen::Index j = 0; j < X.cols(); j += columns_at_once) {
    auto columns = X.middleCols(j, std::min(columns_at_once, X.cols() - j));
    const Eigen::MatrixXd solved = llt_.solve(Eigen::MatrixXd(columns));
    throw_if_out_of_memory();
    columns = solved;
    deadline.check("the solves with CHOLMOD's factor");
  }
}

void CholmodFactor::throw_if_out_of_memory() {
  if (llt_.cholmod().status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
}

}  // namespace airybench
