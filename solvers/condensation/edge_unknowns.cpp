#include "solvers/condensation/edge_unknowns.hpp"

#include <algorithm>

#include "assembly/edge_forces.hpp"

namespace airybench {

std::vector<bool> contact_edges(const Problem& problem) {
  std::vector<bool> is_contact(static_cast<std::size_t>(problem.edges.count()), false);
  for (std::size_t row = 0; row < problem.mesh.boundary.size(); ++row)
    is_contact[problem.edges.of_boundary[row]] =
        problem.mesh.boundary[row].role == BoundaryRole::contact;
  return is_contact;
}

int number_unknowns(const Problem& problem, const ContactPoints& contact, EdgeUnknowns& unknown) {
  const Mesh& mesh = problem.mesh;
  unknown.assign(static_cast<std::size_t>(problem.edges.count()), {0, 0, 0, 0});
  for (std::size_t row = 0; row < mesh.boundary.size(); ++row)
    if (mesh.boundary[row].role == BoundaryRole::displacement)
      unknown[problem.edges.of_boundary[row]].fill(prescribed_unknown);
  // Contact unknowns are marked by −2 − row until the inner ones are counted.
  for (int p = 0; p < contact.count; ++p) {
    auto& edge = unknown[problem.edges.of_boundary[contact.boundary[p]]];
    const int end = p % 2;  // points come in pairs: start and end of an edge
    for (int k = 0; k < contact.components; ++k)
      edge[2 * end + k] = -2 - (contact.components * p + k);
  }
  int inner = 0;
  for (auto& edge : unknown)
    for (int& number : edge)
      if (number == 0) number = inner++;
  for (auto& edge : unknown)
    for (int& number : edge)
      if (number <= -2) number = inner + (-2 - number);
  return inner;
}

std::vector<Eigen::Vector4d> prescribed_displacements(const Problem& problem) {
  std::vector<Eigen::Vector4d> displacement;
  const auto& u0 = problem.loads.displacement_mm;
  if (!u0) return displacement;
  displacement.assign(static_cast<std::size_t>(problem.edges.count()), Eigen::Vector4d::Zero());
  for (std::size_t row = 0; row < problem.mesh.boundary.size(); ++row) {
    if (problem.mesh.boundary[row].role != BoundaryRole::displacement) continue;
    const int edge = problem.edges.of_boundary[row];
    const auto [low, high] = problem.edges.vertices[edge];
    const auto &a = problem.mesh.vertices[low], &b = problem.mesh.vertices[high];
    const auto [start, end] = edge_moments(u0(a), u0((a + b) / 2), u0(b));
    displacement[edge] << start, end;
  }
  return displacement;
}

std::array<int, 12> element_unknowns(const Problem& problem, const EdgeUnknowns& unknown, int t) {
  std::array<int, 12> numbers;
  for (int k = 0; k < 3; ++k)
    std::copy_n(unknown[problem.edges.of_triangle[t][k]].begin(), 4, numbers.begin() + 4 * k);
  return numbers;
}

}  // namespace airybench
