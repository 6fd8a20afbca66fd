// Continuous displacement fields that are quadratic on each triangle, in Bernstein form, with their
// stresses and energies.
//
//   u = Σ_i U_i λ_i² + Σ_{i<j} U_ij 2 λ_i λ_j      one coefficient per vertex, one per edge; mm
//
// Values on an edge or a triangle lie in the convex hull of its coefficients, so a bound on all of
// them holds at every point. U_ij is not the value at the edge's middle, (U_i + 2 U_ij + U_j)/4.
//
// The gradient is linear, with corner values ∇u(V_k) = 2 Σ_j U_kj ∇λ_jᵀ (U_kk = U_k); so are strain
// and stress.
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>

#include "assembly/stress_field.hpp"

namespace airybench {

// Coefficients in mm; rows: x, y; columns ("nodes"): every vertex, then every edge.
using DisplacementField = Eigen::Matrix2Xd;
int displacement_nodes(const Problem& problem);

// Vertices V1 V2 V3, then edges V1V2, V2V3, V3V1.
std::array<int, 6> triangle_nodes(const Problem& problem, int triangle);
// In walking order of Mesh::boundary: start, edge, end.
std::array<int, 3> boundary_nodes(const Problem& problem, int row);

// Bernstein coefficients of the quadratic through three samples along an edge.
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

// u = w + ρ: adds the rigid motion back.
DisplacementField with_rigid_motion(const Problem& problem, DisplacementField w);

// A ε(u), MPa.
StressField stress_of_displacement(const Problem& problem, const DisplacementField& u);

// Per node ∫ σ:ε(u_i), N, of stresses linear on each triangle; a triangle's largest contribution.
struct NodalForces {
  Eigen::Matrix2Xd sum;
  double largest = 0;
};
NodalForces nodal_forces(const Problem& problem, const StressField& stress);

// ∫ b B_i + ∫_{Γ_F} f B_i, N: the work partners of the coefficients.
Eigen::Matrix2Xd nodal_loads(const Problem& problem);

// Nodes that Γ_D prescribes, with their coefficients (zero elsewhere). Exact if u0 is quadratic on
// every edge. Two rollers that are not parallel hold their common vertex fully.
struct PrescribedDisplacement {
  std::vector<bool> at;                   // per node: held fully
  std::map<int, Eigen::Vector2d> normal;  // nodes that one roller holds: its normal
  DisplacementField u;
};
PrescribedDisplacement prescribed_displacement(const Problem& problem);

// ∫ b·u + ∫_{Γ_F} f·u, N mm.
double work_of_loads(const Problem& problem, const DisplacementField& u);

}  // namespace airybench
