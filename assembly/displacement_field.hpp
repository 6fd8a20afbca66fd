// Continuous displacement fields that are quadratic on each triangle, in Bernstein form, and what
// stresses and energies belong to them.
//
//   u = Σ_i U_i λ_i² + Σ_{i<j} U_ij 2 λ_i λ_j      one coefficient per vertex, one per edge; mm
//
// The values on an edge or a triangle are in the convex hull of its coefficients, so a bound that
// all of them meet holds at every point. U_ij is not the value at the edge's middle: that is
// (U_i + 2 U_ij + U_j)/4.
//
// The gradient is linear, with corner values ∇u(V_k) = 2 Σ_j U_kj ∇λ_jᵀ (U_kk = U_k); so are strain
// and stress.
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>

#include "assembly/stress_field.hpp"

namespace airybench {

// Coefficients in mm, rows x and y. Columns ("nodes"): every vertex, then every edge.
using DisplacementField = Eigen::Matrix2Xd;
int displacement_nodes(const Problem& problem);

// The nodes of a triangle: vertices V1 V2 V3, then edges V1V2, V2V3, V3V1.
std::array<int, 6> triangle_nodes(const Problem& problem, int triangle);
// The nodes of a boundary edge as Mesh::boundary walks it: start, edge, end.
std::array<int, 3> boundary_nodes(const Problem& problem, int row);

// The Bernstein coefficients of the quadratic through three samples along an edge.
template <typename Value>
std::array<Value, 3> edge_coefficients(const Value& start, const Value& middle, const Value& end) {
  return {start, Value(2 * middle - (start + end) / 2), end};
}

// Rows: xx, yy, 2xy at V1, V2, V3. Columns: x, y of the six nodes.
using QuadraticStrain = Eigen::Matrix<double, 9, 12>;
QuadraticStrain quadratic_strain(const TriangleVertices& v);

// ∫ ε(u_i):A:ε(u_j) over the triangle, 1 mm thick, N/mm; elasticity A = C⁻¹ in MPa. Symmetric,
// positive semidefinite; kernel: rigid motions.
using QuadraticStiffness = Eigen::Matrix<double, 12, 12>;
QuadraticStiffness quadratic_stiffness(const QuadraticStrain& strain, double area_mm2,
                                       const Eigen::Matrix3d& elasticity);
Eigen::Matrix3d elasticity_of(const Eigen::Matrix3d& compliance);  // its inverse

// u = w + ρ: with the rigid motion that the problem has been freed of.
DisplacementField with_rigid_motion(const Problem& problem, DisplacementField w);

// A ε(u), MPa.
StressField stress_of_displacement(const Problem& problem, const DisplacementField& u);

// ∫ σ:ε(u_i) of stresses that are linear on each triangle, N, per node; and the largest that a
// triangle contributes.
struct NodalForces {
  Eigen::Matrix2Xd sum;
  double largest = 0;
};
NodalForces nodal_forces(const Problem& problem, const StressField& stress);

// The work partners of the coefficients: ∫ b B_i + ∫_{Γ_F} f B_i, N.
Eigen::Matrix2Xd nodal_loads(const Problem& problem);

// What Γ_D prescribes: which nodes, and their coefficients (zero elsewhere). Exact where u0 is
// quadratic on every edge. Between two rollers that are not parallel a vertex is held fully.
struct PrescribedDisplacement {
  std::vector<bool> at;                   // per node: held fully
  std::map<int, Eigen::Vector2d> normal;  // nodes that only a roller holds: along this direction
  DisplacementField u;
};
PrescribedDisplacement prescribed_displacement(const Problem& problem);

// ∫ b·u + ∫_{Γ_F} f·u, N mm.
double work_of_loads(const Problem& problem, const DisplacementField& u);

}  // namespace airybench
