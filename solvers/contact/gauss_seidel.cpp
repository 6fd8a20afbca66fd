#include "solvers/contact/gauss_seidel.hpp"

#include <algorithm>
#include <cmath>

#include "solvers/contact/coulomb_law.hpp"

namespace airybench {
namespace {

// One sweep; returns the squared norm of the change of F.
template <int components>
double sweep(const CondensedSystem& condensed, const Eigen::VectorXd& offset, double mu,
             Eigen::VectorXd& F) {
  using Local = Eigen::Matrix<double, components, 1>;
  const Eigen::MatrixXd& D = condensed.D;
  double change = 0;
  for (Eigen::Index i = 0; i < F.size(); i += components) {
    const Eigen::Matrix<double, components, components> D_pp =
        D.template block<components, components>(i, i);
    const Local old = F.template segment<components>(i);
    Local b;
    for (int k = 0; k < components; ++k) b(k) = D.col(i + k).dot(F) - offset(i + k);
    b -= D_pp * old;
    Local solved;
    if constexpr (components == 2)
      solved = solve_coulomb_law(D_pp, b, mu);
    else
      solved(0) = solve_signorini_law(D_pp(0), b(0));
    F.template segment<components>(i) = solved;
    change += (solved - old).squaredNorm();
  }
  return change;
}

}  // namespace

ContactResult solve_contact_by_gauss_seidel(const CondensedSystem& condensed,
                                            const ContactPoints& contact, const RunControl& control,
                                            const Eigen::VectorXd& start) {
  ContactResult result;
  Eigen::VectorXd offset = condensed.G;  // G + ḡ
  if (contact.gap.size() > 0) offset += contact.gap;
  Eigen::VectorXd& F = result.F_C;
  if (start.size() > 0)
    F = start;
  else
    F.setZero(contact.size());

  const auto meets_the_law = [&](double norm) {
    const Eigen::VectorXd u = condensed.D * F - condensed.G;
    const double residual = natural_map(contact, condensed.D.diagonal(), F, u).norm();
    result.natural_map_residual = norm > 0 ? residual / norm : residual;
    return residual <= control.contact_tolerance * norm;
  };

  while (result.sweeps < control.contact_sweeps && !result.converged) {
    const double change =
        std::sqrt(contact.components == 2 ? sweep<2>(condensed, offset, contact.friction, F)
                                          : sweep<1>(condensed, offset, contact.friction, F));
    ++result.sweeps;
    const double norm = F.norm();
    if (!std::isfinite(norm)) break;
    if (control.histories) result.history.push_back(norm > 0 ? change / norm : 0);
    // A small change makes it worth asking the law, which decides.
    if (change <= control.contact_tolerance * norm) result.converged = meets_the_law(norm);
    if (result.sweeps % 64 == 0) control.deadline.check("the contact sweeps");
  }
  if (!result.converged && result.sweeps > 0) {
    const double norm = F.norm();
    result.converged = meets_the_law(norm) ||
                       (norm > 0 && result.natural_map_residual <= control.contact_acceptable);
  }
  return result;
}

}  // namespace airybench
