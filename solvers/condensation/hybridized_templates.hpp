// The templates of hybridized.hpp, to be instantiated for another scalar.
#pragma once

#include <functional>
#include <limits>

#include "assembly/elements/curved_element.hpp"
#include "assembly/traction_forces.hpp"
#include "solvers/condensation/hybrid_element_templates.hpp"
#include "solvers/condensation/hybrid_kernels.hpp"
#include "solvers/condensation/hybridized.hpp"

namespace airybench {

// Adds the prescribed forces on Γ_F to b.
template <typename Scalar>
void add_tractions(const Problem& problem, const EdgeUnknowns& unknown, Eigen::VectorX<Scalar>& b) {
  if (!problem.loads.traction_MPa) return;
  const int degree = unknown.length() / 2 - 1;
  for (std::size_t row = 0; row < problem.mesh.boundary.size(); ++row) {
    if (problem.mesh.boundary[row].role != BoundaryRole::force) continue;
    const auto [a, b_end] = problem.mesh.boundary[row].vertices;
    const Eigen::Matrix2X<Scalar> forces =
        traction_forces<Scalar>(problem, static_cast<int>(row), degree);
    for (int j = 0; j <= degree; ++j)
      for (int k = 0; k < 2; ++k)
        if (const int number = unknown[problem.edges.of_boundary[row]][2 * j + k];
            number != prescribed_unknown)
          b(number) += forces(k, a < b_end ? j : degree - j);
  }
}

// ū_e − ū_th: of what is prescribed, and of the unknowns' values where there are any.
template <typename Scalar>
void element_displacement(const Problem& problem, const HybridizedSystemIn<Scalar>& system,
                          const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& u, int t,
                          Eigen::Ref<Eigen::VectorX<Scalar>> local) {
  local.setZero();
  const int per_edge = system.unknown.length();
  for (int k = 0; k < 3; ++k) {
    const int edge = problem.edges.of_triangle[t][k];
    if (system.displacement.cols() > 0)
      local.segment(per_edge * k, per_edge) = system.displacement.col(edge).template cast<Scalar>();
    if (u.size() > 0)
      for (int i = 0; i < per_edge; ++i)
        if (const int unknown = system.unknown[edge][i]; unknown != prescribed_unknown)
          local(per_edge * k + i) = u(unknown);
  }
  if (system.thermal.cols() > 0) local -= system.thermal.col(t).template cast<Scalar>();
}

template <typename Scalar>
PrescribedForces<Scalar> prescribed_forces(const Problem& problem,
                                           const HybridizedSystemIn<Scalar>& system) {
  PrescribedForces<Scalar> prescribed;
  if (system.displacement.cols() == 0 && system.thermal.cols() == 0) return prescribed;
  prescribed.forces.setZero(system.K.order);
  Eigen::VectorX<Scalar> u0(system.K.size), f(system.K.size);
  for (int t = 0; t < system.K.count(); ++t) {
    element_displacement<Scalar>(problem, system, {}, t, u0);
    if (u0.isZero(0)) continue;
    system.K.multiply(t, u0.data(), f.data());
    prescribed.energy += u0.dot(f);
    for (int j = 0; j < system.K.size; ++j)
      if (const int unknown = system.K.unknown[t][j]; unknown != prescribed_unknown)
        prescribed.forces(unknown) += f(j);
  }
  return prescribed;
}

template <typename Scalar>
void subtract_prescribed(const Problem& problem, HybridizedSystemIn<Scalar>& system) {
  system.displacement = prescribed_displacements(problem, system.degree());
  system.thermal = thermal_moments(problem, system.degree());
  const PrescribedForces<Scalar> prescribed = prescribed_forces(problem, system);
  if (prescribed.forces.size() > 0) system.b -= prescribed.forces;
}

template <typename Scalar>
std::size_t HybridizedSystemIn<Scalar>::bytes() const {
  return K.bytes() + static_cast<std::size_t>(b.size()) * sizeof(Scalar) + unknown.bytes() +
         static_cast<std::size_t>(displacement.size() + thermal.size()) * sizeof(double);
}

template <typename Scalar, int k>
HybridKernels<Scalar, k> hybrid_kernels() {
  return {"one by one", 1,
          [](const HybridInput<Scalar, k>* input, bool loaded, HybridStiffness<Scalar, k>* result) {
            *result = hybrid_stiffness(*input, loaded);
          },
          [](const HybridInput<Scalar, k>* input, bool loaded, const Scalar* displacement,
             HybridStress<Scalar, k>* result) {
            const Eigen::Matrix<Scalar, StressDegree<k>::size, 1> u(displacement);
            *result = hybrid_stress(*input, loaded, u);
          }};
}

// Calls work(first triangle, how many, their inputs) until all have been at work; the inputs are
// as many as the kernels take, the last repeated where there are no more.
template <typename Scalar, int k, typename Work>
void in_batches(const Problem& problem, const HybridKernels<Scalar, k>& kernels, Work work) {
  const std::vector<int> rows = rows_in_frame(problem);
  const int triangles = static_cast<int>(problem.mesh.triangles.size());
  std::vector<HybridInput<Scalar, k>> input(static_cast<std::size_t>(kernels.width));
  for (int first = 0; first < triangles; first += kernels.width) {
    const int count = std::min(kernels.width, triangles - first);
    for (int l = 0; l < kernels.width; ++l)
      input[l] = l < count ? hybrid_input<Scalar, k>(problem, rows, first + l) : input[count - 1];
    work(first, count, input.data());
  }
}

// What the kernels do, of a triangle with curved sides.
template <typename Scalar>
CurvedElement<Scalar> curved_element(const Problem& problem, int triangle, int degree,
                                     const CurvedSides& curves) {
  return {problem.vertices_of(triangle), problem.compliance_of(triangle), curves, degree};
}

// K_e's lower triangle, f_e and the independence of an element's stresses.
template <typename Scalar>
struct StiffnessOfTriangle {
  const Scalar *lower, *load;
  Scalar independence;
};
// As in HybridStress.
template <typename Scalar>
struct StressOfTriangle {
  const Scalar *stress, *forces, *defect;
  Scalar defect_energy;
};

// Calls visit(triangle, its stiffness). Throws Breakdown where there is none.
template <typename Scalar>
void visit_stiffness(const Problem& problem, int degree,
                     const std::function<void(int, const StiffnessOfTriangle<Scalar>&)>& visit) {
  constexpr double few_roundings = 100 * std::numeric_limits<double>::epsilon();
  const auto checked = [&](int t, const StiffnessOfTriangle<Scalar>& of_triangle) {
    if (!(of_triangle.independence > few_roundings))
      throw Breakdown("hybridized: triangle " + std::to_string(t + 1) +
                      ": its flexibility is not positive definite to rounding");
    visit(t, of_triangle);
  };
  const bool loaded = problem.loads.has_body_force();
  with_degree(degree, [&](auto k) {
    const auto kernels = hybrid_kernels<Scalar, k>();
    std::vector<HybridStiffness<Scalar, k>> result(static_cast<std::size_t>(kernels.width));
    in_batches(problem, kernels, [&](int first, int count, const HybridInput<Scalar, k>* input) {
      kernels.stiffness(input, loaded, result.data());
      for (int l = 0; l < count; ++l) {
        if constexpr (k > 1)
          if (const auto curves = problem.curves_of(first + l, k))
            result[l] = stiffness_of(curved_element<Scalar>(problem, first + l, k, *curves),
                                     input[l], loaded);
        checked(first + l, {result[l].lower, result[l].load, result[l].independence});
      }
    });
  });
}

// b −= f_e of an element with these unknowns.
template <typename Scalar>
void subtract_load(std::span<const int> unknown, const Scalar* load, Eigen::VectorX<Scalar>& b) {
  for (std::size_t j = 0; j < unknown.size(); ++j)
    if (unknown[j] != prescribed_unknown) b(unknown[j]) -= load[j];
}

template <typename Scalar>
HybridizedSystemIn<Scalar> assemble_hybridized(const Problem& problem,
                                               const ContactPoints& contact) {
  HybridizedSystemIn<Scalar> system;
  system.n_c = contact.size();
  const int n = number_unknowns(problem, contact, system.unknown) + system.n_c;
  system.b = Eigen::VectorX<Scalar>::Zero(n);
  system.K = ElementMatricesIn<Scalar>(3 * system.unknown.length());
  system.K.order = n;
  system.K.reserve(problem.mesh.triangles.size());

  std::vector<int> unknown;
  visit_stiffness<Scalar>(problem, system.degree(),
                          [&](int t, const StiffnessOfTriangle<Scalar>& element) {
                            element_unknowns(problem, system.unknown, t, unknown);
                            system.K.add(unknown, centre_of(problem.vertices_of(t)), element.lower);
                            subtract_load(unknown, element.load, system.b);
                          });
  subtract_prescribed(problem, system);
  add_tractions(problem, system.unknown, system.b);
  return system;
}

template <typename Scalar>
void set_load_case(const Problem& problem, HybridizedSystemIn<Scalar>& system) {
  system.b.setZero();
  if (problem.loads.has_body_force())
    visit_stiffness<Scalar>(problem, system.degree(),
                            [&](int t, const StiffnessOfTriangle<Scalar>& element) {
                              subtract_load(system.K.unknown[t], element.load, system.b);
                            });
  subtract_prescribed(problem, system);
  add_tractions(problem, system.unknown, system.b);
}

// Calls visit(triangle, the stress that u makes of its edges).
template <typename Scalar>
void visit_stresses(const Problem& problem, const HybridizedSystemIn<Scalar>& system,
                    const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& u,
                    const std::function<void(int, const StressOfTriangle<Scalar>&)>& visit) {
  const bool loaded = problem.loads.has_body_force();
  with_degree(system.degree(), [&](auto k) {
    const auto kernels = hybrid_kernels<Scalar, k>();
    std::vector<HybridStress<Scalar, k>> result(static_cast<std::size_t>(kernels.width));
    Eigen::MatrixX<Scalar> local =
        Eigen::MatrixX<Scalar>::Zero(StressDegree<k>::size, kernels.width);
    in_batches(problem, kernels, [&](int first, int count, const HybridInput<Scalar, k>* input) {
      for (int l = 0; l < count; ++l)
        element_displacement<Scalar>(problem, system, u, first + l, local.col(l));
      kernels.stress(input, loaded, local.data(), result.data());
      for (int l = 0; l < count; ++l) {
        if constexpr (k > 1)
          if (const auto curves = problem.curves_of(first + l, k))
            result[l] = stress_of(curved_element<Scalar>(problem, first + l, k, *curves), input[l],
                                  loaded, local.col(l));
        visit(first + l, StressOfTriangle<Scalar>{result[l].stress, result[l].forces,
                                                  result[l].defect, result[l].defect_energy});
      }
    });
  });
}

template <typename Scalar>
StressField hybridized_stress(const Problem& problem, const HybridizedSystemIn<Scalar>& system,
                              const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& u) {
  StressField field(problem.mesh.triangles.size(), system.degree());
  visit_stresses<Scalar>(
      problem, system, u, [&](int t, const StressOfTriangle<Scalar>& of_triangle) {
        auto own = field[static_cast<std::size_t>(t)];
        own = Eigen::Map<const Eigen::Matrix3X<Scalar>>(of_triangle.stress, 3, own.cols())
                  .template cast<double>();
      });
  return field;
}

}  // namespace airybench
