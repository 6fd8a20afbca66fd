#include "solvers/direct/cholmod_schur.hpp"

#include <Eigen/CholmodSupport>
#include <algorithm>
#include <new>
#include <numeric>
#include <vector>

namespace airybench {

CholmodSchur::CholmodSchur() {
  cholmod_start(&common_);
  common_.print = 0;
  common_.supernodal = CHOLMOD_SUPERNODAL;
  common_.final_ll = 1;
}

CholmodSchur::~CholmodSchur() {
  cholmod_free_factor(&factor_, &common_);
  cholmod_finish(&common_);
}

void CholmodSchur::analyse(const Eigen::SparseMatrix<double>& lower, int trailing) {
  trailing_ = trailing;
  const int n = static_cast<int>(lower.rows()), inner = n - trailing;
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  {
    const Eigen::SparseMatrix<double> K_II = lower.topLeftCorner(inner, inner);
    cholmod_sparse view = Eigen::viewAsCholmod(K_II.selfadjointView<Eigen::Lower>());
    cholmod_factor* symbolic = cholmod_analyze(&view, &common_);
    if (symbolic != nullptr)
      std::copy_n(static_cast<const int*>(symbolic->Perm), inner, order.begin());
    cholmod_free_factor(&symbolic, &common_);
    throw_if_out_of_memory();
  }
  // K_II's order is already a postorder; another one would move the trailing unknowns.
  common_.nmethods = 1;
  common_.method[0].ordering = CHOLMOD_GIVEN;
  common_.postorder = 0;
  cholmod_sparse view = Eigen::viewAsCholmod(lower.selfadjointView<Eigen::Lower>());
  factor_ = cholmod_analyze_p(&view, order.data(), nullptr, 0, &common_);
  throw_if_out_of_memory();
}

void CholmodSchur::factor(const Eigen::SparseMatrix<double>& lower) {
  cholmod_sparse view = Eigen::viewAsCholmod(lower.selfadjointView<Eigen::Lower>());
  cholmod_factorize(&view, factor_, &common_);
  throw_if_out_of_memory();
  if (factor_->minor != factor_->n)
    throw Breakdown("CHOLMOD: the matrix is not positive definite at pivot " +
                    std::to_string(factor_->minor + 1));
  if (!(cholmod_rcond(factor_, &common_) > 0)) throw Breakdown("CHOLMOD: a pivot is not finite");
}

Eigen::MatrixXd CholmodSchur::trailing_factor() const {
  const auto first = static_cast<int>(factor_->n) - trailing_;
  const auto* super = static_cast<const int*>(factor_->super);  // first column of each supernode
  const auto* rows_at = static_cast<const int*>(factor_->pi);
  const auto* values_at = static_cast<const int*>(factor_->px);
  const auto* rows = static_cast<const int*>(factor_->s);
  const auto* values = static_cast<const double*>(factor_->x);
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(trailing_, trailing_);
  for (std::size_t k = 0; k < factor_->nsuper; ++k) {
    const int height = rows_at[k + 1] - rows_at[k];
    for (int column = std::max(super[k], first); column < super[k + 1]; ++column) {
      const double* entry = values + values_at[k] + std::ptrdiff_t{column - super[k]} * height;
      for (int i = column - super[k]; i < height; ++i)  // above is the unused triangle
        L(rows[rows_at[k] + i] - first, column - first) = entry[i];
    }
  }
  return L;
}

Eigen::VectorXd CholmodSchur::forward(const Eigen::VectorXd& b) {
  return solve(CHOLMOD_L, solve(CHOLMOD_P, b));
}

Eigen::VectorXd CholmodSchur::backward(const Eigen::VectorXd& z) {
  return solve(CHOLMOD_Pt, solve(CHOLMOD_Lt, z));
}

std::size_t CholmodSchur::bytes() const { return factor_->xsize * sizeof(double); }

Eigen::VectorXd CholmodSchur::solve(int part, const Eigen::VectorXd& b) {
  Eigen::VectorXd copy = b;
  cholmod_dense view = Eigen::viewAsCholmod(copy);
  cholmod_dense* x = cholmod_solve(part, factor_, &view, &common_);
  throw_if_out_of_memory();
  Eigen::VectorXd result =
      Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(x->x), b.size());
  cholmod_free_dense(&x, &common_);
  return result;
}

void CholmodSchur::throw_if_out_of_memory() const {
  if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
}

}  // namespace airybench
