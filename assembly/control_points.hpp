// The contact law at the control points of displacements of degree p: the nodes of
// displacement_field.hpp on Γ_C, vertices and p − 1 on each edge.
//
// At each, r = u − g0 n in Bernstein coefficients and its work partner F = ∫ t B ds follow the
// contact law (contact_problem.hpp). If the coefficients satisfy r_n ≤ 0, so does the polynomial
// on its edge, and B ≥ 0: u_n ≤ g0 holds at every point of Γ_C. On curved sides u is its
// interpolant along the curve, in the law's frames there, and its coefficients are traces
// (curved_traces.hpp).
//
// A vertex between two contact edges has one normal, their mean. Then u_n ≤ g0 is no longer strict
// on a face that is not straight. A vertex on Γ_D is prescribed and has no law. Where a roller of
// normal m meets Γ_C, u = d m + a t moves along t ⊥ m only: the law's normal is ±t with n·t > 0,
// and u_n ≤ g0 becomes ±a ≤ (g0 − d n·m)/|n·t|. Its slip in contact is known, and Coulomb's law
// gives the friction against it, which the roller bears.
#pragma once

#include <string>
#include <vector>

#include "assembly/contact_system.hpp"
#include "assembly/displacement_field.hpp"

namespace airybench {

// Columns: the unit normal n, its tangent.
inline Eigen::Matrix2d normal_frame(const Eigen::Vector2d& n) {
  Eigen::Matrix2d q;
  q << n.x(), -n.y(), n.y(), n.x();
  return q;
}

struct ControlPoints {
  ContactPoints law;      // gap: coefficients of g0 − ρ_n, −ρ_t; at a vertex of two
                          // edges the smaller g0 and the smaller μ
  std::vector<int> node;  // per point
  std::vector<Eigen::Vector2d> normal;  // outward unit vector; tangent: (−n_y, n_x)
  std::vector<bool> on_roller;          // u along the tangent is prescribed: minus it is in law.gap

  Eigen::Matrix2d frame(int point) const { return normal_frame(normal[point]); }
};
// Of a problem whose vertices each face one other, or walls.
ControlPoints control_points(const Problem& problem, int degree = 2);
// Empty for such a problem.
std::string why_no_control_points(const Problem& problem);

// u at them, from its traces d, in the rows of their forces; along a roller 0.
Eigen::VectorXd displacement_at(const ControlPoints& points, const DisplacementField& d);

// Contact forces of displacements at their control points: nodal forces of their stresses without
// the loads, N. Per point normal, tangential (μ = 0: normal).
Eigen::VectorXd contact_reactions(const Problem& problem, const ControlPoints& points,
                                  const DisplacementField& w);

}  // namespace airybench
