#include "solvers/contact/admm.hpp"

#include <utility>

#include "solvers/contact/coulomb_law.hpp"
#include "solvers/direct/dense_factors.hpp"

namespace airybench {

ContactResult solve_contact_by_admm(const contact::Problem& problem, const ContactOptions& options,
                                    const Deadline& deadline) {
  constexpr double apart = 10, factor = 2;
  const int m = problem.points.components;
  const Eigen::VectorXd offset = contact_offset(problem);
  Eigen::VectorXd weight = problem.D.diagonal();
  for (int p = 0; p < problem.points.count; ++p) {
    auto of_point = weight.segment(m * p, m);
    of_point.setConstant(of_point.mean());
  }

  const Eigen::MatrixXd skew = problem.is_symmetric
                                   ? Eigen::MatrixXd()
                                   : Eigen::MatrixXd((problem.D - problem.D.transpose()) / 2);
  Eigen::MatrixXd L;
  const auto factorise = [&] {
    L = problem.D;
    if (!problem.is_symmetric) L -= skew;
    L.diagonal() += weight;
    L = cholesky(std::move(L), "ADMM: D with weights on its diagonal");
  };
  factorise();
  Eigen::VectorXd F =
      options.start.size() > 0 ? options.start : Eigen::VectorXd::Zero(problem.points.size());
  Eigen::VectorXd y = Eigen::VectorXd::Zero(problem.points.size());
  int iteration = 0, next_change = 1, pause = 1;
  return iterate_contact(problem, options, deadline, [&](Eigen::VectorXd& z) {
    Eigen::VectorXd next = offset + weight.cwiseProduct(z - y);
    if (!problem.is_symmetric) next -= times(skew, F);
    solve_by_cholesky(L, next);
    F = std::move(next);
    const Eigen::VectorXd projected = project_on_coulomb(problem.points, F + y);
    const Eigen::VectorXd root = weight.cwiseSqrt();
    const double gap = root.cwiseProduct(F - projected).norm();
    const double step = root.cwiseProduct(projected - z).norm();
    y += F - projected;
    const double change = (projected - z).norm() + (F - projected).norm();
    z = projected;
    // y is r in W's units: it follows W.
    if (++iteration >= next_change && (gap > apart * step || step > apart * gap)) {
      const double times = gap > apart * step ? factor : 1 / factor;
      weight *= times;
      y /= times;
      factorise();
      next_change = iteration + ++pause;
    }
    return change;
  });
}

}  // namespace airybench
