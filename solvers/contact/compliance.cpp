#include "solvers/contact/compliance.hpp"

#include "solvers/base/dense_products.hpp"
#include "solvers/base/solution.hpp"

namespace airybench {

Eigen::VectorXd D_times(const contact::Problem& problem, const Eigen::VectorXd& F) {
  if (problem.bodies) {
    const contact::Bodies& bodies = *problem.bodies;
    return bodies.H.transpose() * bodies.solve(bodies.H * F);
  }
  if (problem.is_dense()) return times(problem.D, F);
  return problem.rows * F;
}

Eigen::VectorXd D_diagonal(const contact::Problem& problem) {
  if (problem.bodies) return problem.bodies->D_diagonal;
  if (problem.is_dense()) return problem.D.diagonal();
  return problem.rows.diagonal();
}

Eigen::MatrixXd D_of_point(const contact::Problem& problem, int p) {
  const int m = problem.points.components, first = m * p;
  if (problem.is_dense()) return problem.D.block(first, first, m, m);
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(m, m);
  for (int k = 0; k < m; ++k)
    for (SparseRows::InnerIterator entry(problem.rows, first + k); entry; ++entry)
      if (entry.col() >= first && entry.col() < first + m)
        block(k, entry.col() - first) = entry.value();
  return block;
}

void need_formed(const contact::Problem& problem, const char* who) {
  if (problem.bodies)
    throw Breakdown(std::string(who) +
                    ": takes the rows of W, which is not formed (--contact=newton,admm take M, H)");
}

}  // namespace airybench
