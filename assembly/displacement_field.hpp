// Continuous displacement fields of degree p on each triangle, in Bernstein form, with their
// stresses and energies. For stresses of degree k, p = k + 1. For p = 2:
//
//   u = Σ_i U_i λ_i² + Σ_{i<j} U_ij 2 λ_i λ_j      one coefficient per vertex, one per edge; mm
//
// Values on an edge or a triangle lie in the convex hull of its coefficients, so a bound on all of
// them holds at every point. U_ij is not the value at the edge's middle, (U_i + 2 U_ij + U_j)/4.
//
// Where a side stands for a curve (Problem::round) its triangle's polynomial goes on to it; what is
// asked of it there is in curved_traces.hpp.
//
// The gradient has the degree p − 1, and so have strain and stress. For p = 2 its values at corners
// are ∇u(V_k) = 2 Σ_j U_kj ∇λ_jᵀ (U_kk = U_k).
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <map>

#include "assembly/elements/displacement_triangle.hpp"
#include "assembly/stress_field.hpp"

namespace airybench {

// Coefficients in mm; rows: x, y; columns ("nodes"): every vertex, then p − 1 per edge from its low
// vertex on, then (p − 1)(p − 2)/2 per triangle.
using DisplacementField = Eigen::Matrix2Xd;
int displacement_nodes(const Problem& problem, int degree = 2);
// p, from the number of columns; std::invalid_argument: no field of this mesh.
int displacement_degree(const Problem& problem, const DisplacementField& u);

// Vertices V1 V2 V3, then edges V1V2, V2V3, V3V1 as walked, then inner ones (displacement_place()).
DisplacementTriangle::Nodes triangle_nodes(const Problem& problem, int degree, int triangle);
// In walking order of Mesh::boundary: start, edge, end.
template <int p = 2>
std::array<int, p + 1> boundary_nodes(const Problem& problem, int row);

// The offset on an edge of Γ_C, as Bernstein coefficients of degree p. std::invalid_argument: its
// slip has a higher degree.
template <int p>
std::array<ContactOffset, p + 1> offset_coefficients(const Problem& problem, int row);

// The coefficients of a triangle.
DisplacementTriangle::Displacement of_triangle(const Problem& problem, int degree,
                                               const DisplacementField& u, int triangle);

Eigen::Matrix3d elasticity_of(const Eigen::Matrix3d& compliance);   // its inverse
std::vector<Eigen::Matrix3d> elasticities(const Problem& problem);  // per row of mesh.body_names

// u at λ_1, λ_2, λ_3 of a triangle; its mean over a boundary edge. mm, of fields of any degree.
Eigen::Vector2d displacement_at(const Problem& problem, const DisplacementField& u, int triangle,
                                const Eigen::Vector3d& lambda);
Eigen::Vector2d mean_on_edge(const Problem& problem, const DisplacementField& u, int row);

// Adds a linear displacement, at x on the piece that a vertex belongs to.
using Motion = std::function<Eigen::Vector2d(const Eigen::Vector2d& x, int vertex)>;
DisplacementField with_motion(const Problem& problem, DisplacementField w, const Motion& motion);

// The same field with the coefficients of a higher degree.
DisplacementField elevated(const Problem& problem, const DisplacementField& u, int degree);

// σ* = A ε0 of a triangle's thermal strain, MPa: Bernstein coefficients of degree k on all of it,
// as of DisplacementTriangle::strain().
Eigen::Matrix3Xd thermal_stress(const Problem& problem, int triangle, int k);
// ∫ σ : ε0, N mm.
double thermal_work(const Problem& problem, const StressField& stress);

// A (ε(u) − ε0), MPa, of degree p − 1; and A ε(u).
StressField stress_of_displacement(const Problem& problem, const DisplacementField& u);
StressField stress_of_strain(const Problem& problem, const DisplacementField& u);

// The first of displacements that follow the curved sides of the body, if it has any
// (Problem::round). That of P2 is then given as of degree 2: stresses of degree 1 are those of
// the body between the chords.
StressField own_stress(const Problem& problem, const DisplacementField& u);

// Nodes that Γ_D prescribes, with their coefficients (zero elsewhere). Exact if u0 is quadratic on
// every edge. Two rollers that are not parallel hold their common vertex fully. roller_normal: at
// the i-th node of an edge; empty: its chord's.
struct PrescribedDisplacement {
  std::vector<bool> at;                   // per node: held fully
  std::map<int, Eigen::Vector2d> normal;  // nodes that one roller holds: its normal
  DisplacementField u;
};
using RollerNormal = std::function<Eigen::Vector2d(int row, int i)>;
PrescribedDisplacement prescribed_displacement(const Problem& problem, int degree = 2,
                                               const RollerNormal& roller_normal = {});

}  // namespace airybench
