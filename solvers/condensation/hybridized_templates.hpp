// The templates of hybridized.hpp, for whoever instantiates them for a scalar of their own.
#pragma once

#include "assembly/edge_forces.hpp"
#include "solvers/condensation/hybrid_element.hpp"
#include "solvers/condensation/hybridized.hpp"

namespace airybench {

// Adds the prescribed forces on Γ_F to b.
template <typename Scalar>
void add_tractions(const Problem& problem, const EdgeUnknowns& unknown, Eigen::VectorX<Scalar>& b) {
  if (!problem.loads.traction_MPa) return;
  for (std::size_t row = 0; row < problem.mesh.boundary.size(); ++row) {
    if (problem.mesh.boundary[row].role != BoundaryRole::force) continue;
    const int edge = problem.edges.of_boundary[row];
    const auto [start, stop] = problem.mesh.boundary[row].vertices;
    const EdgeFrame frame = edge_frame(problem.mesh.vertices[start], problem.mesh.vertices[stop]);
    for (int end = 0; end < 2; ++end) {
      const auto& at = problem.mesh.vertices[problem.edges.vertices[edge][end]];
      const Eigen::Vector2d force =
          frame.length_mm / 2 * problem.loads.traction_MPa(at, frame.normal, static_cast<int>(row));
      for (int k = 0; k < 2; ++k) b(unknown[edge][2 * end + k]) += force(k);
    }
  }
}

template <typename Scalar>
std::size_t HybridizedSystemIn<Scalar>::bytes() const {
  return K.bytes() + static_cast<std::size_t>(b.size()) * sizeof(Scalar) +
         unknown.size() * sizeof(unknown[0]) + displacement.size() * sizeof(Eigen::Vector4d);
}

template <typename Scalar>
HybridizedSystemIn<Scalar> assemble_hybridized(const Problem& problem,
                                               const ContactPoints& contact) {
  HybridizedSystemIn<Scalar> system;
  system.n_c = contact.size();
  const int n = number_unknowns(problem, contact, system.unknown) + system.n_c;
  system.displacement = prescribed_displacements(problem);
  const std::vector<bool> in_frame = edges_in_frame(problem);
  system.b = Eigen::VectorX<Scalar>::Zero(n);
  system.K.order = n;
  system.K.reserve(problem.mesh.triangles.size());

  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    const auto element = make_hybrid_element<Scalar>(problem, in_frame, t);
    const std::array<int, 12> unknown = element_unknowns(problem, system.unknown, t);
    const Eigen::Matrix<Scalar, 12, 12> K = element.stiffness();
    Eigen::Matrix<Scalar, 12, 1> f = element.load();  // f_e + K_e ū0
    if (!system.displacement.empty())
      for (int k = 0; k < 3; ++k)
        f += K.template middleCols<4>(4 * k) *
             system.displacement[problem.edges.of_triangle[t][k]].template cast<Scalar>();

    system.K.add(unknown, K);
    for (int j = 0; j < 12; ++j)
      if (unknown[j] != prescribed_unknown) system.b(unknown[j]) -= f(j);
  }
  add_tractions(problem, system.unknown, system.b);
  return system;
}

// Calls visit(triangle, element, its edge displacements, its unknowns, the stress that they make).
template <typename Scalar, typename Visit>
void visit_stresses(const Problem& problem, const HybridizedSystemIn<Scalar>& system,
                    const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& u, Visit visit) {
  const std::vector<bool> in_frame = edges_in_frame(problem);
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    const std::array<int, 12> unknown = element_unknowns(problem, system.unknown, t);
    Eigen::Matrix<Scalar, 12, 1> local;
    for (int k = 0; k < 12; ++k) {
      const int edge = problem.edges.of_triangle[t][k / 4];
      if (unknown[k] != prescribed_unknown)
        local(k) = u(unknown[k]);
      else
        local(k) = system.displacement.empty() ? 0 : system.displacement[edge](k % 4);
    }
    const auto element = make_hybrid_element<Scalar>(problem, in_frame, t);
    visit(t, element, local, unknown, element.stress_at(local));
  }
}

template <typename Scalar>
StressField hybridized_stress(const Problem& problem, const HybridizedSystemIn<Scalar>& system,
                              const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& u) {
  StressField field(problem.mesh.triangles.size());
  visit_stresses(problem, system, u,
                 [&](int t, const auto&, const auto&, const auto&, const auto& stress) {
                   field[t] = stress.template cast<double>();
                 });
  return field;
}

}  // namespace airybench
