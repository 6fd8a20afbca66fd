#include "solvers/condensation/global_problem.hpp"

#include <algorithm>

#include "solvers/direct/cholmod.hpp"

namespace airybench {

contact::Problem condense_global(const Eigen::SparseMatrix<double>& M,
                                 const Eigen::SparseMatrix<double>& H, const Eigen::VectorXd& f,
                                 const Eigen::VectorXd& w) {
  constexpr Eigen::Index columns_at_once = 32;
  const Eigen::SparseMatrix<double> lower = M.triangularView<Eigen::Lower>();
  CholmodFactor factor;
  factor.analyse(lower);
  factor.factor(lower);
  contact::Problem problem;
  Eigen::MatrixXd v = f;
  factor.solve_in_place(v);
  problem.G = w + H.transpose() * v;
  problem.D.resize(H.cols(), H.cols());
  for (Eigen::Index first = 0; first < H.cols(); first += columns_at_once) {
    const Eigen::Index count = std::min(columns_at_once, H.cols() - first);
    v = H.middleCols(first, count);
    factor.solve_in_place(v);
    problem.D.middleCols(first, count) = H.transpose() * v;
  }
  problem.D = ((problem.D + problem.D.transpose()) / 2).eval();
  return problem;
}

}  // namespace airybench
