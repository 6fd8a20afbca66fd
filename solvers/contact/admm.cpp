#include "solvers/contact/admm.hpp"

#include "solvers/base/dense_products.hpp"
#include "solvers/contact/compliance.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "solvers/contact/weighted_compliance.hpp"

namespace airybench {

ContactResult solve_contact_by_admm(const contact::Problem& problem, const ContactOptions& options,
                                    const Deadline& deadline) {
  constexpr double apart = 10, factor = 2;
  const int m = problem.points.components;
  const Eigen::VectorXd offset = contact_offset(problem);
  Eigen::VectorXd weight = D_diagonal(problem);
  for (int p = 0; p < problem.points.count; ++p) {
    auto of_point = weight.segment(m * p, m);
    of_point.setConstant(of_point.mean());
  }
  WeightedCompliance D_with_weight(problem);
  D_with_weight.factorise(weight);
  const auto skew_times = [&](const Eigen::VectorXd& x) {  // (D − Dᵀ) x / 2
    if (problem.is_dense())
      return Eigen::VectorXd((times(problem.D, x) - transposed_times(problem.D, x)) / 2);
    return Eigen::VectorXd((problem.rows * x - problem.rows.transpose() * x) / 2);
  };
  Eigen::VectorXd F =
      options.start.size() > 0 ? options.start : Eigen::VectorXd::Zero(problem.points.size());
  Eigen::VectorXd y = Eigen::VectorXd::Zero(problem.points.size());
  int iteration = 0, next_change = 1, pause = 1;
  return iterate_contact(problem, options, deadline, [&](Eigen::VectorXd& z) {
    deadline.check("ADMM's iterations");  // each is a solve, and some a factorisation
    Eigen::VectorXd next = offset + weight.cwiseProduct(z - y);
    if (!problem.is_symmetric) next -= skew_times(F);
    D_with_weight.solve(next, F);
    const Eigen::VectorXd projected = project_on_coulomb(problem.points, F + y);
    const Eigen::VectorXd root = weight.cwiseSqrt();
    const double gap = root.cwiseProduct(F - projected).norm();
    const double step = root.cwiseProduct(projected - z).norm();
    y += F - projected;
    const double change = (projected - z).norm() + (F - projected).norm();
    z = projected;
    // y is r in W's units: it follows W.
    if (++iteration >= next_change && (gap > apart * step || step > apart * gap)) {
      const double larger = gap > apart * step ? factor : 1 / factor;
      weight *= larger;
      y /= larger;
      D_with_weight.factorise(weight);
      next_change = iteration + ++pause;
    }
    return change;
  });
}

}  // namespace airybench
