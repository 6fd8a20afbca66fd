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
  if (m == 2)
    for (int p = 0; p < problem.points.count; ++p)
      weight.segment<2>(2 * p).setConstant(weight.segment<2>(2 * p).mean());

  Eigen::MatrixXd L;
  const auto factorise = [&] {
    L = problem.D;
    L.diagonal() += weight;
    L = cholesky(std::move(L), "ADMM: D with weights on its diagonal");
  };
  factorise();
  Eigen::VectorXd y = Eigen::VectorXd::Zero(problem.points.size());
  int iteration = 0, next_change = 1, pause = 1;
  return iterate_contact(problem, options, deadline, [&](Eigen::VectorXd& z) {
    Eigen::VectorXd F = offset + weight.cwiseProduct(z - y);
    solve_by_cholesky(L, F);
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
