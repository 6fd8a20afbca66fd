// The templates of hybridized.hpp, to be instantiated for another scalar.
#pragma once

#include <limits>

#include "assembly/edge_forces.hpp"
#include "solvers/condensation/hybrid_element_templates.hpp"
#include "solvers/condensation/hybrid_kernels.hpp"
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

// ū_e: what is prescribed, and the unknowns' values where there are any.
template <typename Scalar>
Eigen::Matrix<Scalar, 12, 1> element_displacement(const Problem& problem,
                                                  const HybridizedSystemIn<Scalar>& system,
                                                  const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& u,
                                                  int t) {
  Eigen::Matrix<Scalar, 12, 1> local = Eigen::Matrix<Scalar, 12, 1>::Zero();
  for (int k = 0; k < 3; ++k) {
    const int edge = problem.edges.of_triangle[t][k];
    if (!system.displacement.empty())
      local.template segment<4>(4 * k) = system.displacement[edge].template cast<Scalar>();
    if (u.size() > 0)
      for (int i = 0; i < 4; ++i)
        if (const int unknown = system.unknown[edge][i]; unknown != prescribed_unknown)
          local(4 * k + i) = u(unknown);
  }
  return local;
}

// b −= K ū0.
template <typename Scalar>
void subtract_prescribed(const Problem& problem, HybridizedSystemIn<Scalar>& system) {
  for (int t = 0; t < system.K.count(); ++t) {
    const Eigen::Matrix<Scalar, 12, 1> u0 = element_displacement(problem, system, {}, t);
    if (u0.isZero(0)) continue;
    const Eigen::Matrix<Scalar, 12, 1> f = system.K.product(t, u0);
    for (int j = 0; j < 12; ++j)
      if (const int unknown = system.K.unknown[t][j]; unknown != prescribed_unknown)
        system.b(unknown) -= f(j);
  }
}

template <typename Scalar>
std::size_t HybridizedSystemIn<Scalar>::bytes() const {
  return K.bytes() + static_cast<std::size_t>(b.size()) * sizeof(Scalar) +
         unknown.size() * sizeof(unknown[0]) + displacement.size() * sizeof(Eigen::Vector4d);
}

template <typename Scalar>
HybridKernels<Scalar> hybrid_kernels() {
  return {"one by one", 1,
          [](const HybridInput<Scalar>* input, bool loaded, HybridStiffness<Scalar>* result) {
            *result = hybrid_stiffness(*input, loaded);
          },
          [](const HybridInput<Scalar>* input, bool loaded, const Scalar* displacement,
             HybridStress<Scalar>* result) {
            const Eigen::Map<const Eigen::Matrix<Scalar, 12, 1>> u(displacement);
            *result = hybrid_stress<Scalar>(*input, loaded, u);
          }};
}

// Calls work(first triangle, how many, their inputs) until all have been at work; the inputs are
// as many as the kernels take, the last repeated where there are no more.
template <typename Scalar, typename Work>
void in_batches(const Problem& problem, const HybridKernels<Scalar>& kernels, Work work) {
  const std::vector<int> rows = rows_in_frame(problem);
  const int triangles = static_cast<int>(problem.mesh.triangles.size());
  std::vector<HybridInput<Scalar>> input(static_cast<std::size_t>(kernels.width));
  for (int first = 0; first < triangles; first += kernels.width) {
    const int count = std::min(kernels.width, triangles - first);
    for (int l = 0; l < kernels.width; ++l)
      input[l] = l < count ? hybrid_input<Scalar>(problem, rows, first + l) : input[count - 1];
    work(first, count, input.data());
  }
}

// Calls visit(triangle, K_e and f_e). Throws Breakdown where there is no K_e.
template <typename Scalar, typename Visit>
void visit_stiffness(const Problem& problem, Visit visit) {
  constexpr double few_roundings = 100 * std::numeric_limits<double>::epsilon();
  const HybridKernels<Scalar> kernels = hybrid_kernels<Scalar>();
  std::vector<HybridStiffness<Scalar>> result(static_cast<std::size_t>(kernels.width));
  const bool loaded = problem.loads.has_body_force();
  in_batches(problem, kernels, [&](int first, int count, const HybridInput<Scalar>* input) {
    kernels.stiffness(input, loaded, result.data());
    for (int l = 0; l < count; ++l) {
      if (!(result[l].independence > few_roundings))
        throw Breakdown("hybridized: triangle " + std::to_string(first + l + 1) +
                        ": its flexibility is not positive definite to rounding");
      visit(first + l, result[l]);
    }
  });
}

// b −= f_e.
template <typename Scalar>
void subtract_load(const Problem& problem, int t, const HybridStiffness<Scalar>& element,
                   HybridizedSystemIn<Scalar>& system) {
  const std::array<int, 12> unknown = element_unknowns(problem, system.unknown, t);
  const Eigen::Map<const Eigen::Matrix<Scalar, 12, 1>> f(element.load);
  for (int j = 0; j < 12; ++j)
    if (unknown[j] != prescribed_unknown) system.b(unknown[j]) -= f(j);
}

template <typename Scalar>
HybridizedSystemIn<Scalar> assemble_hybridized(const Problem& problem,
                                               const ContactPoints& contact) {
  HybridizedSystemIn<Scalar> system;
  system.n_c = contact.size();
  const int n = number_unknowns(problem, contact, system.unknown) + system.n_c;
  system.displacement = prescribed_displacements(problem);
  system.b = Eigen::VectorX<Scalar>::Zero(n);
  system.K.order = n;
  system.K.reserve(problem.mesh.triangles.size());

  visit_stiffness<Scalar>(problem, [&](int t, const HybridStiffness<Scalar>& element) {
    system.K.add(element_unknowns(problem, system.unknown, t), centre_of(problem.vertices_of(t)),
                 element.lower);
    subtract_load(problem, t, element, system);
  });
  if (!system.displacement.empty()) subtract_prescribed(problem, system);
  add_tractions(problem, system.unknown, system.b);
  return system;
}

template <typename Scalar>
void set_load_case(const Problem& problem, HybridizedSystemIn<Scalar>& system) {
  system.displacement = prescribed_displacements(problem);
  system.b.setZero();
  if (problem.loads.has_body_force())
    visit_stiffness<Scalar>(problem, [&](int t, const HybridStiffness<Scalar>& element) {
      subtract_load(problem, t, element, system);
    });
  if (!system.displacement.empty()) subtract_prescribed(problem, system);
  add_tractions(problem, system.unknown, system.b);
}

// Calls visit(triangle, hybrid_stress of what u makes of its edges).
template <typename Scalar, typename Visit>
void visit_stresses(const Problem& problem, const HybridizedSystemIn<Scalar>& system,
                    const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& u, Visit visit) {
  const HybridKernels<Scalar> kernels = hybrid_kernels<Scalar>();
  std::vector<HybridStress<Scalar>> result(static_cast<std::size_t>(kernels.width));
  Eigen::Matrix<Scalar, 12, Eigen::Dynamic> local =
      Eigen::Matrix<Scalar, 12, Eigen::Dynamic>::Zero(12, kernels.width);
  const bool loaded = problem.loads.has_body_force();
  in_batches(problem, kernels, [&](int first, int count, const HybridInput<Scalar>* input) {
    for (int l = 0; l < count; ++l)
      local.col(l) = element_displacement(problem, system, u, first + l);
    kernels.stress(input, loaded, local.data(), result.data());
    for (int l = 0; l < count; ++l) visit(first + l, result[l]);
  });
}

template <typename Scalar>
StressField hybridized_stress(const Problem& problem, const HybridizedSystemIn<Scalar>& system,
                              const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& u) {
  StressField field(problem.mesh.triangles.size());
  visit_stresses(problem, system, u, [&](int t, const HybridStress<Scalar>& of_triangle) {
    field[t] =
        Eigen::Map<const ElementStressIn<Scalar>>(of_triangle.stress).template cast<double>();
  });
  return field;
}

}  // namespace airybench
