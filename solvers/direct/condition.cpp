#include "solvers/direct/condition.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace airybench {
namespace {

using Entry = Eigen::SparseMatrix<double>::InnerIterator;

Eigen::VectorXd equilibrating(const Eigen::SparseMatrix<double>& lower) {
  Eigen::VectorXd d = Eigen::VectorXd::Zero(lower.rows()), largest = d;
  for (Eigen::Index j = 0; j < lower.cols(); ++j)
    for (Entry entry(lower, j); entry; ++entry)
      if (entry.row() == j && entry.value() > 0) d(j) = 1 / std::sqrt(entry.value());
  // Rows without a positive diagonal, by what they couple with.
  for (Eigen::Index j = 0; j < lower.cols(); ++j)
    for (Entry entry(lower, j); entry; ++entry) {
      const double size = std::abs(entry.value());
      largest(entry.row()) = std::max(largest(entry.row()), size * d(j));
      largest(j) = std::max(largest(j), size * d(entry.row()));
    }
  for (Eigen::Index i = 0; i < d.size(); ++i)
    if (d(i) == 0) d(i) = largest(i) > 0 ? 1 / largest(i) : 1;
  return d;
}

double norm_1(const Eigen::SparseMatrix<double>& lower, const Eigen::VectorXd& d) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(lower.cols());
  for (Eigen::Index j = 0; j < lower.cols(); ++j)
    for (Entry entry(lower, j); entry; ++entry) {
      const double size = std::abs(entry.value()) * d(j) * d(entry.row());
      sum(j) += size;
      if (entry.row() != j) sum(entry.row()) += size;
    }
  return sum.maxCoeff();
}

}  // namespace

double estimate_condition(const Eigen::SparseMatrix<double>& lower,
                          const std::function<void(Eigen::Ref<Eigen::MatrixXd>)>& solve) {
  constexpr int max_vertices = 5;
  const Eigen::Index n = lower.rows();
  if (n == 0) return 1;
  const Eigen::VectorXd d = equilibrating(lower);
  const auto inverse = [&](const Eigen::VectorXd& x) {
    Eigen::VectorXd y = x.cwiseQuotient(d);
    solve(y);
    return Eigen::VectorXd(y.cwiseQuotient(d));
  };
  Eigen::VectorXd x = Eigen::VectorXd::Constant(n, 1 / static_cast<double>(n));
  double largest = 0;
  for (int vertex = 0; vertex < max_vertices; ++vertex) {
    const Eigen::VectorXd y = inverse(x);
    if (!y.allFinite()) return std::numeric_limits<double>::infinity();
    const double norm = y.lpNorm<1>();
    if (vertex > 1 && norm <= largest) break;
    largest = std::max(largest, norm);
    const Eigen::VectorXd sign = (y.array() >= 0).select(Eigen::VectorXd::Ones(n), -1.0);
    const Eigen::VectorXd gradient = inverse(sign);  // Â is symmetric
    Eigen::Index steepest;
    if (gradient.cwiseAbs().maxCoeff(&steepest) <= gradient.dot(x)) break;
    x.setZero();
    x(steepest) = 1;
  }
  for (Eigen::Index i = 0; i < n; ++i)
    x(i) = (i % 2 == 0 ? 1 : -1) *
           (1 + static_cast<double>(i) / static_cast<double>(std::max<Eigen::Index>(n - 1, 1)));
  largest = std::max(largest, 2 * inverse(x).lpNorm<1>() / (3 * static_cast<double>(n)));
  return norm_1(lower, d) * largest;
}

}  // namespace airybench
