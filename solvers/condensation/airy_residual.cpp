#include "solvers/condensation/airy_residual.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "assembly/elements/edge_forces.hpp"
#include "assembly/hct_action.hpp"
#include "assembly/row_order.hpp"

namespace airybench {
namespace {

template <int rows>
using WideColumn = Eigen::Matrix<Wide, rows, 1>;
template <typename Scalar>
using Column = Eigen::VectorX<Scalar>;

// φ of some unknowns; the gauge is zero.
template <typename Scalar, std::size_t count>
Eigen::Matrix<Scalar, static_cast<int>(count), 1> gather(const AirySystem& system,
                                                         const Column<Scalar>& x,
                                                         const std::array<int, count>& dofs) {
  Eigen::Matrix<Scalar, static_cast<int>(count), 1> phi;
  for (std::size_t k = 0; k < count; ++k)
    phi(static_cast<int>(k)) =
        dofs[k] == DofNumbering::gauge ? 0 : Scalar(system.scale(dofs[k])) * x(dofs[k]);
  return phi;
}

template <std::size_t count, typename Values, typename Vector>
void scatter(const AirySystem& system, const std::array<int, count>& dofs, const Values& values,
             Vector& r) {
  for (std::size_t k = 0; k < count; ++k)
    if (dofs[k] != DofNumbering::gauge)
      r(dofs[k]) += system.scale(dofs[k]) * values(static_cast<int>(k));
}

// Moves sums of such terms as rounding may have: to which side is as good as random,
// and the same in every run.
void add_rounding(const Eigen::VectorXd& terms, int number, WideVector& r) {
  std::minstd_rand sign(static_cast<unsigned>(number) + 1);
  const Wide part = std::numeric_limits<Wide>::epsilon() / 4;
  for (Eigen::Index i = 0; i < r.size(); ++i)
    r(i) += (sign() % 2 == 0 ? 1 : -1) * part * Wide(terms(i));
}

template <typename Scalar>
struct TriangleStress {
  HctAction<Scalar> of_dofs;
  ElementStressIn<Scalar> stress;
  std::array<int, 12> dofs;
};

// Without the particular stress.
template <typename Scalar>
TriangleStress<Scalar> homogeneous_stress(const AirySystem& system, const Column<Scalar>& x,
                                          int t) {
  const Problem& problem = *system.problem;
  const TriangleVertices v = problem.vertices_of(t);
  const EdgeSigns outward = problem.edge_signs(t);
  const std::array<int, 12> dofs = system.dofs.of_triangle(problem, t);
  Eigen::Matrix<Scalar, 12, 1> phi = gather<Scalar>(system, x, dofs);
  subtract_affine_part(v, outward, phi);
  const HctAction<Scalar> of_dofs(v, outward);
  return {of_dofs, of_dofs.stress(phi), dofs};
}

TriangleStress<Wide> triangle_stress(const AirySystem& system, const WideVector& x, int t) {
  const Problem& problem = *system.problem;
  TriangleStress<Wide> result = homogeneous_stress<Wide>(system, x, t);
  if (problem.loads.has_body_force()) result.stress += particular_element_stress<Wide>(problem, t);
  return result;
}

// The rows of one boundary edge: forces at its ends as functionals of φ.
struct EdgeRows {
  EdgeForcesIn<Wide> forces;
  std::array<int, 7> dofs;
};

EdgeRows edge_rows(const AirySystem& system, int row) {
  const Problem& problem = *system.problem;
  const auto [a, b] = problem.mesh.boundary[row].vertices;
  const auto &xa = problem.mesh.vertices[a], &xb = problem.mesh.vertices[b];
  return {edge_forces<Wide>(xa, xb, a < b ? 1 : -1),
          system.dofs.of_edge_walk(a, b, problem.edges.of_boundary[row])};
}

// Adds what an edge's displacements ū, x and y at its two ends, do to r.
void add_displacements(const AirySystem& system, const EdgeRows& edge, const WideColumn<4>& u,
                       WideVector& r) {
  scatter(system, edge.dofs, WideColumn<7>(edge.forces.transpose() * u), r);
}

void add_prescribed_displacements(const AirySystem& system, WideVector& r) {
  const Problem& problem = *system.problem;
  if (!problem.loads.displacement_mm) return;
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
    if (problem.mesh.boundary[row].role != BoundaryRole::displacement) continue;
    const WideColumn<4> u = problem.prescribed_moments(row).reshaped().cast<Wide>();
    add_displacements(system, edge_rows(system, row), u, r);
  }
}

// Γ_F, Γ_C and rollers in the order of the rows of C_F and C_C: their residuals, and their
// multipliers in r.
void add_boundary_forces(const AirySystem& system, const LongSaddleVector& answer,
                         const Eigen::VectorXd& F_C, LongSaddleVector& residual) {
  int row_F = 0, row_C = 0;
  const auto visit = [&](int row) {
    const EdgeCondition condition = system.problem->condition(row);
    const EdgeRows edge = edge_rows(system, row);
    const WideColumn<4> forces = edge.forces * gather<Wide>(system, answer.x, edge.dofs);
    WideColumn<4> u = WideColumn<4>::Zero();  // −λ in x and y
    for (int end = 0; end < 2; ++end) {
      const EdgeFrameIn<Wide> frame = system.problem->frame_of_moment<Wide>(row, 1, end);
      for (int k = 0; k < 2; ++k) {
        if (condition.component[k] == Known::displacement ||
            system.problem->free.pins_down(row, end, k))
          continue;
        const Eigen::Vector2<Wide> axis = condition.in_frame
                                              ? (k == 0 ? frame.normal : frame.tangent)
                                              : Eigen::Vector2<Wide>(k == 0, k == 1);
        const Wide force = axis.dot(forces.segment<2>(2 * end));
        const bool condensed = condition.component[k] == Known::contact_law;
        const Wide lambda = condensed ? answer.lambda_C(row_C) : answer.lambda_F(row_F);
        u.segment<2>(2 * end) -= lambda * axis;
        if (condensed) {
          const Wide F0 = system.F0.size() > 0 ? system.F0(row_C) : 0;
          residual.lambda_C(row_C) = F_C(row_C) - F0 - force;
          ++row_C;
        } else {
          residual.lambda_F(row_F) = (system.F.size() > 0 ? system.F(row_F) : 0) - force;
          ++row_F;
        }
      }
    }
    add_displacements(system, edge, u, residual.x);
  };
  for_each_boundary_row(system.problem->mesh, visit);
}

// The terms |σ(φ_i)|:|C|:Σ|σ(φ_j) x_j| that S x sums, scaled as it is.
Eigen::VectorXd residual_terms(const AirySystem& system, const Eigen::VectorXd& x) {
  const Problem& problem = *system.problem;
  Eigen::VectorXd terms = Eigen::VectorXd::Zero(system.n());
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    const TriangleVertices v = problem.vertices_of(t);
    const EdgeSigns outward = problem.edge_signs(t);
    const std::array<int, 12> dofs = system.dofs.of_triangle(problem, t);
    Eigen::Matrix<double, 12, 1> phi = gather<double>(system, x, dofs);
    subtract_affine_part(v, outward, phi);
    const HctStress size = hct_stress(v, outward).cwiseAbs();
    ElementStress stress;
    stress.reshaped() = size.lazyProduct(phi.cwiseAbs());
    const Eigen::Matrix<double, 12, 1> work = size.transpose().lazyProduct(
        stress_dual<double>(stress, problem.area_mm2(t), problem.compliance_of(t).cwiseAbs())
            .reshaped());
    scatter(system, dofs, work, terms);
  }
  return terms;
}

}  // namespace

AiryResidual airy_residual(const AirySystem& system, const LongSaddleVector& answer,
                           const Eigen::VectorXd& F_C, int number) {
  const Problem& problem = *system.problem;
  LongSaddleVector residual{WideVector::Zero(system.n()), WideVector::Zero(system.n_f()),
                            WideVector::Zero(system.n_c())};
  Wide stress_squared = 0;
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    const TriangleStress<Wide> at = triangle_stress(system, answer.x, t);
    ElementStressIn<Wide> dual =
        stress_dual<Wide>(at.stress, problem.area_mm2(t), problem.compliance_of(t));
    stress_squared += at.stress.cwiseProduct(dual).sum();
    if (problem.is_warm(t)) dual += thermal_dual<Wide>(problem, t);
    scatter(system, at.dofs, WideColumn<12>(-at.of_dofs.transposed(dual)), residual.x);
  }
  add_prescribed_displacements(system, residual.x);
  add_boundary_forces(system, answer, F_C, residual);
  add_rounding(residual_terms(system, answer.x.cast<double>()), number, residual.x);
  return {std::move(residual), std::sqrt(static_cast<double>(stress_squared))};
}

AiryProduct airy_product(const AirySystem& system, const Eigen::VectorXd& x) {
  const Problem& problem = *system.problem;
  AiryProduct result{0, Eigen::VectorXd::Zero(system.n())};
  double squared = 0;
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    const TriangleStress<double> at = homogeneous_stress<double>(system, x, t);
    const ElementStress dual =
        stress_dual<double>(at.stress, problem.area_mm2(t), problem.compliance_of(t));
    squared += at.stress.cwiseProduct(dual).sum();
    scatter(system, at.dofs, at.of_dofs.transposed(dual), result.S_x);
  }
  result.stress_norm = std::sqrt(squared);
  return result;
}

StressField airy_stress(const AirySystem& system, const WideVector& x) {
  StressField field(system.problem->mesh.triangles.size());
  for (int t = 0; t < static_cast<int>(field.size()); ++t)
    field[t] = triangle_stress(system, x, t).stress.cast<double>();
  return field;
}

}  // namespace airybench
