// The contact law at the control points of quadratic displacements: the nodes of
// displacement_field.hpp on Γ_C, vertices and edges.
//
// At each, r = u − g0 n in Bernstein coefficients and F = ∫ t B ds, its work partner, follow the
// law of dual_system.hpp. A quadratic with coefficients r_n ≤ 0 is ≤ 0 on its edge, and B ≥ 0: u_n
// ≤ g0 holds at every point of Γ_C, not at nodes only.
//
// A vertex between two contact edges has one normal, their mean. Where the two differ, on a face
// that is not straight, u_n ≤ g0 is no longer strict. A vertex that is also on Γ_D is prescribed
// and has no law. Where a roller of normal m meets Γ_C, u = d m + a t is left to move along t ⊥ m
// only: there the law's normal is ±t with n·t > 0, u_n ≤ g0 being ±a ≤ (g0 − d n·m)/|n·t|, and its
// tangential force is zero.
#pragma once

#include "assembly/displacement_field.hpp"
#include "assembly/dual_system.hpp"

namespace airybench {

// Columns: a unit normal, its tangent.
inline Eigen::Matrix2d normal_frame(const Eigen::Vector2d& n) {
  Eigen::Matrix2d q;
  q << n.x(), -n.y(), n.y(), n.x();
  return q;
}

struct ControlPoints {
  ContactPoints law;                    // gap: coefficients of g0 − ρ_n, −ρ_t; of g0
                                        // and μ at a vertex of two edges the smaller one
  std::vector<int> node;                // per point
  std::vector<Eigen::Vector2d> normal;  // outward unit vector; tangent: (−n_y, n_x)
  std::vector<bool> on_roller;          // u along the tangent is prescribed

  Eigen::Matrix2d frame(int point) const { return normal_frame(normal[point]); }
};
ControlPoints control_points(const Problem& problem);

// The forces that hold quadratic displacements at the control points, by their stresses: what nodal
// forces there differ from the loads. Per point normal, tangential (μ = 0: normal).
Eigen::VectorXd contact_reactions(const Problem& problem, const StressField& stress);

}  // namespace airybench
