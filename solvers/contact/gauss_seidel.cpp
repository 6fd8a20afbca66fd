#include "solvers/contact/gauss_seidel.hpp"

#include <cblas.h>

#include <cmath>

#include "solvers/contact/coulomb_law.hpp"

namespace airybench {
namespace {

// One sweep; returns the squared norm of the change of F.
template <int components>
double sweep(const contact::Problem& problem, const Eigen::VectorXd& offset, Eigen::VectorXd& F) {
  using Local = Eigen::Matrix<double, components, 1>;
  const Eigen::MatrixXd& D = problem.D;
  const auto n = static_cast<int>(F.size());
  double change = 0;
  for (int p = 0; p < problem.points.count; ++p) {
    const Eigen::Index i = components * p;
    const Eigen::Matrix<double, components, components> D_pp =
        D.template block<components, components>(i, i);
    const Local old = F.template segment<components>(i);
    Local b;
    for (int k = 0; k < components; ++k)
      b(k) = cblas_ddot(n, D.col(i + k).data(), 1, F.data(), 1) - offset(i + k);
    b -= D_pp * old;
    Local solved;
    if constexpr (components == 2)
      solved = solve_coulomb_law(D_pp, b, problem.points.friction_at(p));
    else
      solved(0) = solve_signorini_law(D_pp(0), b(0));
    F.template segment<components>(i) = solved;
    change += (solved - old).squaredNorm();
  }
  return change;
}

}  // namespace

double gauss_seidel_sweep(const contact::Problem& problem, const Eigen::VectorXd& offset,
                          Eigen::VectorXd& F) {
  return std::sqrt(problem.points.components == 2 ? sweep<2>(problem, offset, F)
                                                  : sweep<1>(problem, offset, F));
}

ContactResult solve_contact_by_gauss_seidel(const contact::Problem& problem,
                                            const ContactOptions& options,
                                            const Deadline& deadline) {
  const Eigen::VectorXd offset = contact_offset(problem);
  return iterate_contact(problem, options, deadline, [&](Eigen::VectorXd& F) {
    return gauss_seidel_sweep(problem, offset, F);
  });
}

}  // namespace airybench
