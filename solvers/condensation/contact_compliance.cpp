#include "solvers/condensation/contact_compliance.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

#include "assembly/rough_compliance.hpp"

namespace airybench {

ContactCompliance::ContactCompliance(const Problem& problem)
    : problem_(problem), is_near_(static_cast<std::size_t>(problem.edges.count())) {
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

void ContactCompliance::add(int triangle, const ElementMatrices::Matrix& K_e) {
  for (int k = 0; k < 3; ++k) {
    const int edge = problem_.edges.of_triangle[triangle][k];
    if (!is_near_[edge]) continue;
    near_[edge].stiffness += K_e.block<4, 4>(4 * k, 4 * k);
    ++near_[edge].triangles;
  }
  if (const auto found = at_contact_.find(triangle); found != at_contact_.end())
    found->second = K_e;
}

// Which of an edge's four unknowns may move.
std::array<bool, 4> ContactCompliance::free_unknowns(int edge) const {
  const auto row = row_of_edge_.find(edge);
  if (row == row_of_edge_.end()) {
    const bool whole = near_.at(edge).triangles == 2;
    return {whole, whole, whole, whole};
  }
  const EdgeCondition condition = problem_.condition(row->second);
  const bool first = condition.component[0] != Known::displacement,
             second = condition.component[1] != Known::displacement;
  return {first, second, first, second};
}

Eigen::Matrix4Xd ContactCompliance::from_below() const {
  Eigen::Matrix4Xd compliance =
      Eigen::Matrix4Xd::Zero(4, static_cast<Eigen::Index>(problem_.mesh.boundary.size()));
  for (const auto& [triangle, K_e] : at_contact_) {
    const std::array<int, 3>& edges = problem_.edges.of_triangle[triangle];
    ElementMatrices::Matrix K_PP = K_e;
    for (int k = 0; k < 3; ++k) {
      K_PP.block<4, 4>(4 * k, 4 * k) = near_.at(edges[k]).stiffness;
      const std::array<bool, 4> is_free = free_unknowns(edges[k]);
      for (int i = 0; i < 4; ++i) {
        if (is_free[i]) continue;
        K_PP.row(4 * k + i).setZero();
        K_PP.col(4 * k + i).setZero();
        K_PP(4 * k + i, 4 * k + i) = 1;
      }
    }
    const Eigen::LLT<ElementMatrices::Matrix> factor(K_PP);
    const ElementMatrices::Matrix inverse = factor.solve(ElementMatrices::Matrix::Identity());
    for (int k = 0; k < 3; ++k)
      if (is_contact(edges[k]))
        compliance.col(row_of_edge_.at(edges[k])) = inverse.diagonal().segment<4>(4 * k);
  }
  return compliance;
}

Eigen::VectorXd at_contact_points(const Eigen::Matrix4Xd& of_rows, const Problem& problem,
                                  const ContactPoints& contact) {
  double stiffest = std::numeric_limits<double>::infinity();
  for (const Eigen::Matrix3d& C : problem.compliance) stiffest = std::min(stiffest, C(0, 0));
  const int m = contact.components;
  Eigen::VectorXd of_points(contact.size());
  for (int p = 0; p < contact.count; ++p)
    of_points.segment(m * p, m) = of_rows.col(contact.boundary[p]).segment(2 * (p % 2), m);
  return of_points.cwiseMax(
      0.5 * rough_compliance(Eigen::VectorXd::Constant(of_rows.cols(), stiffest), contact));
}

}  // namespace airybench
