#include "solvers/contact/sparse_freedoms.hpp"

#include "solvers/direct/sparse_lu.hpp"

namespace airybench {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

SparseRows forces_of(const std::vector<Freedom>& freedoms, int m, Eigen::Index n_c) {
  Triplets entries;
  for (int k = 0; k < static_cast<int>(freedoms.size()); ++k)
    for (int i = 0; i < m; ++i)
      if (freedoms[k].force(i) != 0)
        entries.emplace_back(freedoms[k].first + i, k, freedoms[k].force(i));
  SparseRows P(n_c, static_cast<Eigen::Index>(freedoms.size()));
  P.setFromTriplets(entries.begin(), entries.end());
  return P;
}

SparseRows relations_of(const std::vector<Freedom>& freedoms, int m, Eigen::Index n_c) {
  Triplets entries;
  for (int k = 0; k < static_cast<int>(freedoms.size()); ++k) {
    const Freedom& of = freedoms[k];
    if (of.component != across_slip)
      entries.emplace_back(k, of.first + of.component, 1.0);
    else
      for (int i = 1; i < m; ++i) entries.emplace_back(k, of.first + i, of.force(i));
  }
  SparseRows Q(static_cast<Eigen::Index>(freedoms.size()), n_c);
  Q.setFromTriplets(entries.begin(), entries.end());
  return Q;
}

void append(const SparseRows& block, Eigen::Index row, Eigen::Index column, double factor,
            Triplets& entries) {
  for (Eigen::Index i = 0; i < block.outerSize(); ++i)
    for (SparseRows::InnerIterator entry(block, i); entry; ++entry)
      entries.emplace_back(static_cast<int>(row + i), static_cast<int>(column + entry.col()),
                           factor * entry.value());
}

Eigen::VectorXd solve_with_bodies(const contact::Bodies& bodies,
                                  const std::vector<Freedom>& freedoms, const SparseRows& P,
                                  const SparseRows& Q, const Eigen::VectorXd& b) {
  const Eigen::Index n = bodies.M.rows(), count = b.size();
  Triplets entries;
  append(SparseRows(bodies.M), 0, 0, 1, entries);
  append(SparseRows(bodies.H) * P, 0, n, -1, entries);
  append(Q * SparseRows(bodies.H.transpose()), n, 0, 1, entries);
  for (Eigen::Index k = 0; k < count; ++k)
    entries.emplace_back(static_cast<int>(n + k), static_cast<int>(n + k), freedoms[k].diagonal);
  SparseRows matrix(n + count, n + count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Triplets().swap(entries);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n + count);
  right.tail(count) = b;
  return solve_by_sparse_lu(matrix, right).tail(count);
}

}  // namespace

Eigen::VectorXd solve_sparse_freedoms(const contact::Problem& problem,
                                      const std::vector<Freedom>& freedoms,
                                      const Eigen::VectorXd& b) {
  const int m = problem.points.components;
  const SparseRows P = forces_of(freedoms, m, problem.points.size()),
                   Q = relations_of(freedoms, m, problem.points.size());
  if (problem.bodies) return solve_with_bodies(*problem.bodies, freedoms, P, Q, b);
  SparseRows matrix = SparseRows(Q * problem.rows) * P;
  for (Eigen::Index k = 0; k < b.size(); ++k) matrix.coeffRef(k, k) += freedoms[k].diagonal;
  return solve_by_sparse_lu(matrix, b);
}

}  // namespace airybench
