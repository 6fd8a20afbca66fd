#include "solvers/direct/cholmod.hpp"

#include <Eigen/CholmodSupport>
#include <algorithm>
#include <new>
#include <string>
#include <utility>

#include "solvers/direct/dense_factors.hpp"

namespace airybench {
namespace {

// Columns solved together: enough for matrix products, few enough for little workspace.
constexpr Eigen::Index columns_at_once = 32;

cholmod_sparse view_of(const Eigen::SparseMatrix<double>& lower) {
  return Eigen::viewAsCholmod(lower.selfadjointView<Eigen::Lower>());
}

// CHOLMOD's workspace of numbers, which version 5 and later count in bytes.
template <typename Common>
std::size_t workspace_doubles(const Common& common) {
  if constexpr (requires { common.xworkbytes; })
    return common.xworkbytes / sizeof(double);
  else
    return common.xworksize;
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

// CHOLMOD's minimum degree, but the trailing unknowns after all others (CAMD).
std::vector<int> CholmodFactor::order_with_last(const Eigen::SparseMatrix<double>& lower,
                                                int trailing) {
  const auto n = static_cast<std::size_t>(lower.rows());
  std::vector<int> order(n), last(n, 0);
  std::fill(last.end() - trailing, last.end(), 1);
  cholmod_sparse view = view_of(lower);
  const bool ordered = cholmod_camd(&view, nullptr, 0, last.data(), order.data(), &common_);
  throw_if_out_of_memory();
  if (!ordered)
    throw Breakdown("CHOLMOD: CAMD ended with status " + std::to_string(common_.status));
  return order;
}

void CholmodFactor::analyse(const Eigen::SparseMatrix<double>& lower, int trailing) {
  const OwnerScope scope(MemoryOwner::factor);
  trailing_ = trailing;
  if (lower.rows() == 0) return;  // nothing to solve
  cholmod_sparse whole = view_of(lower);
  if (trailing > 0 && trailing < lower.rows()) {
    std::vector<int> order = order_with_last(lower, trailing);
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_GIVEN;
    factor_ = cholmod_analyze_p(&whole, order.data(), nullptr, 0, &common_);
    common_.nmethods = 0;  // its own choice again
  } else {
    factor_ = cholmod_analyze(&whole, &common_);
  }
  if (factor_ == nullptr && common_.status == CHOLMOD_TOO_LARGE)
    throw Breakdown("CHOLMOD: its factor would have more than 2^31 entries");
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
    solve(X.middleCols(j, std::min(columns_at_once, X.cols() - j)));
    deadline.check("the solves with CHOLMOD's factor");
  }
  if (X.cols() > 1) free_workspace();  // of many columns; what follows has few
}

Eigen::MatrixXd CholmodFactor::inverse_of_schur() const {
  if (trailing_ == 0) return {};
  // CHOLMOD postorders the elimination tree: C may not be last, but its unknowns still come after
  // all that they depend on, one after the other. place: of an unknown of C among them, else −1.
  const int n = static_cast<int>(factor_->n), leading = n - trailing_;
  const auto* permutation = static_cast<const int*>(factor_->Perm);
  std::vector<int> place(factor_->n, -1), unknown;
  for (int k = 0; k < n; ++k)
    if (permutation[k] >= leading) {
      place[static_cast<std::size_t>(k)] = static_cast<int>(unknown.size());
      unknown.push_back(permutation[k] - leading);
    }
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(trailing_, trailing_);
  const auto* first_column = static_cast<const int*>(factor_->super);
  const auto* first_row = static_cast<const int*>(factor_->pi);
  const auto* first_entry = static_cast<const int*>(factor_->px);
  const auto* rows = static_cast<const int*>(factor_->s);
  const auto* entries = static_cast<const double*>(factor_->x);
  for (std::size_t s = 0; s < factor_->nsuper; ++s) {
    const int height = first_row[s + 1] - first_row[s];
    for (int j = 0; j < first_column[s + 1] - first_column[s]; ++j) {
      const int column = place[static_cast<std::size_t>(first_column[s] + j)];
      if (column < 0) continue;
      for (int i = j; i < height; ++i)
        if (const int row = place[static_cast<std::size_t>(rows[first_row[s] + i])];
            row >= 0)  // else a supernode's padding
          L(row, column) = entries[first_entry[s] + static_cast<std::ptrdiff_t>(j) * height + i];
    }
  }
  const Eigen::MatrixXd inverse = inverse_from_factor(std::move(L));
  Eigen::MatrixXd in_order(trailing_, trailing_);
  for (int j = 0; j < trailing_; ++j)
    for (int i = 0; i < trailing_; ++i) in_order(unknown[i], unknown[j]) = inverse(i, j);
  return in_order;
}

std::size_t CholmodFactor::bytes() const {
  if (factor_ == nullptr) return 0;
  std::size_t doubles = factor_->xsize + workspace_doubles(common_);
  for (const cholmod_dense* workspace : {solution_, permuted_, gathered_})
    if (workspace != nullptr) doubles += workspace->nzmax;
  // Rows and starts of the supernodes; permutation and column counts; CHOLMOD's workspace.
  const std::size_t integers = factor_->ssize + 3 * (factor_->nsuper + 1) + 2 * factor_->n +
                               common_.iworksize + 2 * common_.nrow;
  return doubles * sizeof(double) + integers * sizeof(int);
}

std::int64_t CholmodFactor::entries() const {
  return factor_ == nullptr ? 0 : static_cast<std::int64_t>(common_.lnz);
}

double CholmodFactor::flops() const { return factor_ == nullptr ? 0 : common_.fl; }

void CholmodFactor::solve(Eigen::Ref<Eigen::MatrixXd> X) {
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
  cholmod_solve2(CHOLMOD_A, factor_, &b, nullptr, &solution_, nullptr, &permuted_, &gathered_,
                 &common_);
  throw_if_out_of_memory();
  X = Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(solution_->x), X.rows(),
                                        X.cols());
}

void CholmodFactor::throw_if_out_of_memory() const {
  if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
}

}  // namespace airybench
