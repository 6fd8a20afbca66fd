#include "solvers/direct/cholmod.hpp"

#include <Eigen/CholmodSupport>
#include <algorithm>
#include <new>
#include <numeric>
#include <string>
#include <vector>

namespace airybench {
namespace {

// Columns solved together: enough for matrix products, few enough for little workspace.
constexpr Eigen::Index columns_at_once = 32;

cholmod_sparse view_of(const Eigen::SparseMatrix<double>& lower) {
  return Eigen::viewAsCholmod(lower.selfadjointView<Eigen::Lower>());
}

}  // namespace

CholmodFactor::CholmodFactor() {
  const OwnerScope scope(MemoryOwner::factor);
  cholmod_start(&common_);
  common_.print = 0;
  common_.supernodal = CHOLMOD_SUPERNODAL;
  common_.final_ll = 1;
}

CholmodFactor::~CholmodFactor() {
  free_workspace();
  cholmod_free_factor(&factor_, &common_);
  cholmod_finish(&common_);
}

void CholmodFactor::free_workspace() {
  for (cholmod_dense** workspace : {&solution_, &permuted_, &gathered_})
    cholmod_free_dense(workspace, &common_);
}

void CholmodFactor::analyse(const Eigen::SparseMatrix<double>& lower, int trailing) {
  const OwnerScope scope(MemoryOwner::factor);
  trailing_ = trailing;
  if (lower.rows() == 0) return;  // nothing to solve
  cholmod_sparse whole = view_of(lower);
  if (trailing == 0) {
    factor_ = cholmod_analyze(&whole, &common_);
    if (factor_ == nullptr) throw std::bad_alloc();
    return;
  }
  const int n = static_cast<int>(lower.rows()), inner = n - trailing;
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  {
    const Eigen::SparseMatrix<double> K_II = lower.topLeftCorner(inner, inner);
    cholmod_sparse leading = view_of(K_II);
    cholmod_factor* symbolic = cholmod_analyze(&leading, &common_);
    if (symbolic == nullptr) throw std::bad_alloc();
    std::copy_n(static_cast<const int*>(symbolic->Perm), inner, order.begin());
    cholmod_free_factor(&symbolic, &common_);
  }
  // K_II's order is already a postorder; another one would move the trailing unknowns.
  common_.nmethods = 1;
  common_.method[0].ordering = CHOLMOD_GIVEN;
  common_.postorder = 0;
  factor_ = cholmod_analyze_p(&whole, order.data(), nullptr, 0, &common_);
  if (factor_ == nullptr) throw std::bad_alloc();
}

void CholmodFactor::factor(const Eigen::SparseMatrix<double>& lower) {
  const OwnerScope scope(MemoryOwner::factor);
  if (factor_ == nullptr) return;
  cholmod_sparse whole = view_of(lower);
  cholmod_factorize(&whole, factor_, &common_);
  throw_if_out_of_memory();
  if (factor_->minor != factor_->n)
    throw Breakdown("CHOLMOD: the matrix is not positive definite at pivot " +
                    std::to_string(factor_->minor + 1));
  if (!(cholmod_rcond(factor_, &common_) > 0)) throw Breakdown("CHOLMOD: a pivot is not finite");
}

void CholmodFactor::solve_in_place(Eigen::Ref<Eigen::MatrixXd> X, const Deadline& deadline) {
  for (Eigen::Index j = 0; j < X.cols(); j += columns_at_once) {
    solve(CHOLMOD_A, X.middleCols(j, std::min(columns_at_once, X.cols() - j)));
    deadline.check("the solves with CHOLMOD's factor");
  }
  if (X.cols() > 1) free_workspace();  // of many columns; what follows has few
}

Eigen::VectorXd CholmodFactor::forward(const Eigen::VectorXd& b) {
  Eigen::VectorXd y = b;
  solve(CHOLMOD_P, y);
  solve(CHOLMOD_L, y);
  return y;
}

Eigen::VectorXd CholmodFactor::backward(const Eigen::VectorXd& z) {
  Eigen::VectorXd x = z;
  solve(CHOLMOD_Lt, x);
  solve(CHOLMOD_Pt, x);
  return x;
}

Eigen::MatrixXd CholmodFactor::trailing_factor() const {
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(trailing_, trailing_);
  if (factor_ == nullptr) return L;
  const auto first = static_cast<int>(factor_->n) - trailing_;
  const auto* super = static_cast<const int*>(factor_->super);  // first column of each supernode
  const auto* rows_at = static_cast<const int*>(factor_->pi);
  const auto* values_at = static_cast<const int*>(factor_->px);
  const auto* rows = static_cast<const int*>(factor_->s);
  const auto* values = static_cast<const double*>(factor_->x);
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

std::size_t CholmodFactor::bytes() const {
  if (factor_ == nullptr) return 0;
  std::size_t doubles = factor_->xsize + common_.xworksize;
  for (const cholmod_dense* workspace : {solution_, permuted_, gathered_})
    if (workspace != nullptr) doubles += workspace->nzmax;
  // Rows and starts of the supernodes; permutation and column counts; CHOLMOD's workspace.
  const std::size_t integers = factor_->ssize + 3 * (factor_->nsuper + 1) + 2 * factor_->n +
                               common_.iworksize + 2 * common_.nrow;
  return doubles * sizeof(double) + integers * sizeof(int);
}

std::size_t CholmodFactor::library_bytes() const { return common_.memory_inuse; }

std::int64_t CholmodFactor::entries() const { return static_cast<std::int64_t>(common_.lnz); }

double CholmodFactor::flops() const { return common_.fl; }

void CholmodFactor::solve(int system, Eigen::Ref<Eigen::MatrixXd> X) {
  if (factor_ == nullptr) return;
  const OwnerScope scope(MemoryOwner::factor);
  // Workspace is made here and kept: cholmod_solve2 does not survive an allocation of its own that
  // fails (CHOLMOD 3.0.14).
  const auto n = factor_->n, columns = static_cast<std::size_t>(X.cols());
  const std::pair<cholmod_dense**, std::size_t> needs[] = {
      {&solution_, n}, {&permuted_, n}, {&gathered_, factor_->maxesize}};
  for (const auto& [workspace, rows] : needs) {
    if (*workspace != nullptr && (*workspace)->nzmax >= rows * columns) continue;
    cholmod_free_dense(workspace, &common_);
    *workspace = cholmod_allocate_dense(rows, columns, rows, CHOLMOD_REAL, &common_);
    throw_if_out_of_memory();
  }
  cholmod_dense b{};
  b.nrow = n;
  b.ncol = columns;
  b.d = static_cast<std::size_t>(X.outerStride());
  b.nzmax = b.d * columns;
  b.x = X.data();
  b.xtype = CHOLMOD_REAL;
  b.dtype = CHOLMOD_DOUBLE;
  cholmod_solve2(system, factor_, &b, nullptr, &solution_, nullptr, &permuted_, &gathered_,
                 &common_);
  throw_if_out_of_memory();
  X = Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(solution_->x), X.rows(),
                                        X.cols());
}

void CholmodFactor::throw_if_out_of_memory() const {
  if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
}

}  // namespace airybench
