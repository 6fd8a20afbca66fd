#include "solvers/contact/complementarity.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace airybench {
namespace {

using Eigen::Index;
constexpr double tied = 1e-11, min_pivot = 1e-8;

// T x = 0 with x = (w, z, z0; 1, ε, …): the identity in the columns of the basis.
class Tableau {
 public:
  Tableau(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b)
      : n_(A.rows()), T_(n_, 2 * n_ + 1 + b.cols()), basis_(static_cast<std::size_t>(n_)) {
    T_ << Eigen::MatrixXd::Identity(n_, n_), -A, -Eigen::VectorXd::Ones(n_), b;
    first_ = T_;
    for (Index i = 0; i < n_; ++i) basis_[i] = i;
  }

  // Lexicographically least of rows, each over its divisor: (b, then the w columns).
  Index first_row(const std::vector<Index>& rows, const Eigen::VectorXd& divisor) const {
    return *std::ranges::min_element(rows, [&](Index i, Index j) {
      const auto order = [&](Index column) {
        const double x = T_(i, column) / divisor(i), y = T_(j, column) / divisor(j);
        return std::abs(x - y) <= tied * std::max({1., std::abs(x), std::abs(y)}) ? 0. : x - y;
      };
      for (Index k = artificial() + 1; k < T_.cols(); ++k)
        if (const double d = order(k); d != 0) return d < 0;
      if (basis_[i] == artificial() || basis_[j] == artificial()) return basis_[i] == artificial();
      for (Index k = 0; k < n_; ++k)
        if (const double d = order(k); d != 0) return d < 0;
      return false;
    });
  }
  bool is_negative(Index row) const {
    for (Index k = artificial() + 1; k < T_.cols(); ++k)
      if (std::abs(T_(row, k)) > tied) return T_(row, k) < 0;
    return false;
  }
  // The variable that leaves.
  Index pivot(Index row, Index entering) {
    T_.row(row) /= T_(row, entering);
    for (Index i = 0; i < n_; ++i)
      if (i != row && T_(i, entering) != 0) T_.row(i) -= (T_(i, entering) * T_.row(row)).eval();
    return std::exchange(basis_[row], entering);
  }
  // The same from the first tableau, without the rounding of the pivots since.
  void refresh() {
    Eigen::MatrixXd B(n_, n_);
    for (Index i = 0; i < n_; ++i) B.col(i) = first_.col(basis_[i]);
    T_ = B.partialPivLu().solve(first_);
  }
  Index complement(Index variable) const { return variable < n_ ? variable + n_ : variable - n_; }
  Index artificial() const { return 2 * n_; }
  auto column(Index variable) const { return T_.col(variable); }

  Eigen::MatrixXd z() const {
    Eigen::MatrixXd z = Eigen::MatrixXd::Zero(n_, T_.cols() - artificial() - 1);
    for (Index i = 0; i < n_; ++i)
      if (basis_[i] >= n_ && basis_[i] < artificial())
        z.row(basis_[i] - n_) = T_.row(i).tail(z.cols());
    return z;
  }

 private:
  Index n_;
  Eigen::MatrixXd T_, first_;
  std::vector<Index> basis_;
};

}  // namespace

std::optional<Eigen::MatrixXd> solve_complementarity(const Eigen::MatrixXd& A,
                                                     const Eigen::MatrixXd& b) {
  const Index n = A.rows(), max_pivots = 100 + 50 * n;
  constexpr Index refreshed_after = 16;
  Tableau tableau(A, b);
  std::vector<Index> rows;
  for (Index i = 0; i < n; ++i)
    if (tableau.is_negative(i)) rows.push_back(i);
  if (rows.empty()) return Eigen::MatrixXd::Zero(n, b.cols());
  Index entering = tableau.artificial();
  Index row = tableau.first_row(rows, Eigen::VectorXd::Ones(n));
  for (Index pivots = 0; pivots < max_pivots; ++pivots) {
    const Index leaving = tableau.pivot(row, entering);
    const bool is_done = leaving == tableau.artificial();
    if (is_done || pivots % refreshed_after == 0) tableau.refresh();
    if (is_done) return tableau.z();
    entering = tableau.complement(leaving);
    const Eigen::VectorXd divisor = tableau.column(entering);
    rows.clear();
    for (Index i = 0; i < n; ++i)
      if (divisor(i) > min_pivot * std::max(1., divisor.maxCoeff())) rows.push_back(i);
    if (rows.empty()) return {};
    row = tableau.first_row(rows, divisor);
  }
  return {};
}

}  // namespace airybench
