#include "solvers/condensation/contact_compliance.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

#include "assembly/rough_compliance.hpp"

namespace airybench {

ContactCompliance::ContactCompliance(const Problem& problem, int degree)
    : problem_(problem),
      of_edge_(2 * (degree + 1)),
      is_near_(static_cast<std::size_t>(problem.edges.count())) {
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row)
    row_of_edge_[problem.edges.of_boundary[row]] = row;
  for (int t = 0; t < static_cast<int>(problem.edges.of_triangle.size()); ++t) {
    const std::array<int, 3>& edges = problem.edges.of_triangle[t];
    if (std::ranges::any_of(edges, [&](int edge) { return is_contact(edge); })) {
      at_contact_[t];
      for (const int edge : edges) is_near_[edge] = true;
    }
  }
}

bool ContactCompliance::is_contact(int edge) const {
  const auto row = row_of_edge_.find(edge);
  return row != row_of_edge_.end() &&
         problem_.mesh.boundary[row->second].role == BoundaryRole::contact;
}

bool ContactCompliance::asks_for(int triangle) const {
  return std::ranges::any_of(problem_.edges.of_triangle[triangle],
                             [&](int edge) { return is_near_[edge]; });
}

void ContactCompliance::add(int triangle, const Eigen::Ref<const Eigen::MatrixXd>& K_e) {
  const Eigen::Index n = of_edge_;
  for (int k = 0; k < 3; ++k) {
    const int edge = problem_.edges.of_triangle[triangle][k];
    if (!is_near_[edge]) continue;
    Near& near = near_[edge];
    if (near.triangles++ == 0) near.stiffness.setZero(n, n);
    near.stiffness += K_e.block(n * k, n * k, n, n);
  }
  if (const auto found = at_contact_.find(triangle); found != at_contact_.end())
    found->second = K_e;
}

// Which components of an edge's unknowns may move.
std::array<bool, 2> ContactCompliance::free_components(int edge) const {
  const auto row = row_of_edge_.find(edge);
  if (row == row_of_edge_.end()) {
    const bool whole = near_.at(edge).triangles == 2;
    return {whole, whole};
  }
  const EdgeCondition condition = problem_.condition(row->second);
  return {condition.component[0] != Known::displacement,
          condition.component[1] != Known::displacement};
}

Eigen::MatrixXd ContactCompliance::from_below() const {
  const Eigen::Index n = of_edge_, size = 3 * n;
  Eigen::MatrixXd compliance =
      Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(problem_.mesh.boundary.size()));
  for (const auto& [triangle, K_e] : at_contact_) {
    const std::array<int, 3>& edges = problem_.edges.of_triangle[triangle];
    Eigen::MatrixXd K_PP = K_e;
    for (int k = 0; k < 3; ++k) {
      K_PP.block(n * k, n * k, n, n) = near_.at(edges[k]).stiffness;
      const std::array<bool, 2> is_free = free_components(edges[k]);
      for (Eigen::Index i = 0; i < n; ++i) {
        if (is_free[i % 2]) continue;
        K_PP.row(n * k + i).setZero();
        K_PP.col(n * k + i).setZero();
        K_PP(n * k + i, n * k + i) = 1;
      }
    }
    const Eigen::MatrixXd inverse = K_PP.llt().solve(Eigen::MatrixXd::Identity(size, size));
    for (int k = 0; k < 3; ++k)
      if (is_contact(edges[k]))
        compliance.col(row_of_edge_.at(edges[k])) = inverse.diagonal().segment(n * k, n);
  }
  return compliance;
}

Eigen::VectorXd at_contact_points(const Eigen::MatrixXd& of_rows, const Problem& problem,
                                  const ContactPoints& contact) {
  double stiffest = std::numeric_limits<double>::infinity();
  for (const Eigen::Matrix3d& C : problem.compliance) stiffest = std::min(stiffest, C(0, 0));
  const int m = contact.components;
  Eigen::VectorXd of_points(contact.size());
  for (int p = 0; p < contact.count; ++p)
    of_points.segment(m * p, m) =
        of_rows.col(contact.boundary[p]).segment(2 * (p % contact.per_edge), m);
  const double share = contact.per_edge == 2 ? 0.5 : 0.4;
  return of_points.cwiseMax(
      share * rough_compliance(Eigen::VectorXd::Constant(of_rows.cols(), stiffest), contact));
}

Eigen::VectorXd compliance_from_below(const Problem& problem, const ElementMatrices& K,
                                      const ContactPoints& contact) {
  ContactCompliance near_contact(problem, contact.per_edge - 1);
  for (int t = 0; t < K.count(); ++t)
    if (near_contact.asks_for(t)) near_contact.add(t, from_lower(K.lower[t].data(), K.size));
  return at_contact_points(near_contact.from_below(), problem, contact);
}

}  // namespace airybench
