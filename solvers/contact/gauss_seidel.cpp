#include "solvers/contact/gauss_seidel.hpp"

#include <cblas.h>

#include <cmath>

#include "solvers/contact/coulomb_law.hpp"

namespace airybench {

GaussSeidel::GaussSeidel(const contact::Problem& problem)
    : problem_(&problem), offset_(contact_offset(problem)) {
  if (!problem.is_symmetric) transposed_ = problem.D.transpose();
}

template <int components>
double GaussSeidel::squared_change(Eigen::VectorXd& F) const {
  using Local = Eigen::Matrix<double, components, 1>;
  const Eigen::MatrixXd& rows = transposed_.size() > 0 ? transposed_ : problem_->D;  // as columns
  const auto n = static_cast<int>(F.size());
  double change = 0;
  for (int p = 0; p < problem_->points.count; ++p) {
    const Eigen::Index i = components * p;
    const auto D_pp = rows.template block<components, components>(i, i);
    // The law at one point is solved for the symmetric part; the rest is in b.
    const Eigen::Matrix<double, components, components> symmetric = (D_pp + D_pp.transpose()) / 2;
    const Local old = F.template segment<components>(i);
    Local b;
    for (int k = 0; k < components; ++k)
      b(k) = cblas_ddot(n, rows.col(i + k).data(), 1, F.data(), 1) - offset_(i + k);
    b -= symmetric * old;
    Local solved;
    if constexpr (components == 1)
      solved(0) = solve_signorini_law(symmetric(0), b(0));
    else
      solved = solve_coulomb_law(symmetric, b, problem_->points.friction_at(p));
    F.template segment<components>(i) = solved;
    change += (solved - old).squaredNorm();
  }
  return change;
}

double GaussSeidel::sweep(Eigen::VectorXd& F) const {
  switch (problem_->points.components) {
    case 1:
      return std::sqrt(squared_change<1>(F));
    case 2:
      return std::sqrt(squared_change<2>(F));
    default:
      return std::sqrt(squared_change<3>(F));
  }
}

ContactResult solve_contact_by_gauss_seidel(const contact::Problem& problem,
                                            const ContactOptions& options,
                                            const Deadline& deadline) {
  const GaussSeidel by(problem);
  return iterate_contact(problem, options, deadline,
                         [&](Eigen::VectorXd& F) { return by.sweep(F); });
}

}  // namespace airybench
