#include "solvers/contact/gauss_seidel.hpp"

#include <cblas.h>

#include <cmath>

#include "solvers/contact/compliance.hpp"
#include "solvers/contact/coulomb_law.hpp"

namespace airybench {

GaussSeidel::GaussSeidel(const contact::Problem& problem)
    : problem_(&problem), offset_(contact_offset(problem)) {
  need_formed(problem, "Gauss-Seidel");
  if (problem.is_dense() && !problem.is_symmetric) transposed_ = problem.D.transpose();
}

// D F at the point whose first row is i; D_pp: its block of D.
template <int components>
Eigen::Matrix<double, components, 1> GaussSeidel::product(
    Eigen::Index i, const Eigen::VectorXd& F,
    Eigen::Matrix<double, components, components>& D_pp) const {
  Eigen::Matrix<double, components, 1> result;
  if (problem_->is_dense()) {
    const Eigen::MatrixXd& rows = transposed_.size() > 0 ? transposed_ : problem_->D;  // as columns
    const auto n = static_cast<int>(F.size());
    D_pp = rows.template block<components, components>(i, i).transpose();
    for (int k = 0; k < components; ++k)
      result(k) = cblas_ddot(n, rows.col(i + k).data(), 1, F.data(), 1);
    return result;
  }
  for (int k = 0; k < components; ++k) {
    double sum = 0;
    for (SparseRows::InnerIterator entry(problem_->rows, i + k); entry; ++entry) {
      sum += entry.value() * F(entry.col());
      const Eigen::Index other = entry.col() - i;
      if (other >= 0 && other < components) D_pp(k, other) = entry.value();
    }
    result(k) = sum;
  }
  return result;
}

template <int components>
double GaussSeidel::squared_change(Eigen::VectorXd& F) const {
  using Local = Eigen::Matrix<double, components, 1>;
  using Block = Eigen::Matrix<double, components, components>;
  double change = 0;
  Block D_pp = Block::Zero();
  for (int p = 0; p < problem_->points.count; ++p) {
    const Eigen::Index i = components * p;
    const Local old = F.template segment<components>(i);
    Local b = product<components>(i, F, D_pp) - offset_.template segment<components>(i);
    // The law at one point is solved for the symmetric part; the rest is in b.
    const Block symmetric = (D_pp + D_pp.transpose()) / 2;
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
