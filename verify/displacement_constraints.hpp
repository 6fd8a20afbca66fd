// What makes a displacement admissible, node by node: u0 on Γ_D, and the walls on Γ_C; with the
// contact terms of e² that act on a node.
#pragma once

#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "assembly/contact_system.hpp"
#include "assembly/curved_traces.hpp"
#include "assembly/displacement_field.hpp"

namespace airybench {

// A wall in front of a node: normal·w ≤ limit.
struct Barrier {
  Eigen::Vector2d normal;
  double limit;
  double excess(const Eigen::Vector2d& w) const { return normal.dot(w) - limit; }
};

// A node at a wall; or a node and its partner on the other face, for the difference of their
// displacements.
struct ContactNode {
  static constexpr int none = -1;
  int partner = none;
  std::vector<Barrier> walls;  // one or two
  ContactOffset offset;
  Eigen::Vector2d force = {0, 0};                             // ∫ σn B over Γ_C, N
  double friction = std::numeric_limits<double>::infinity();  // smallest μ of its edges

  Eigen::Vector2d normal() const {  // of two walls the mean
    const Eigen::Vector2d& n = walls.front().normal;
    return walls.size() == 1 ? n : (n + walls.back().normal).normalized();
  }
};

class DisplacementConstraints {
 public:
  // F_C: of stresses of one degree less than the displacements, which are given by their traces.
  DisplacementConstraints(const ContactSystem& system, const CurvedTraces& traces,
                          const Eigen::VectorXd& F_C);

  // Sets w to u0 on Γ_D. On Γ_C it takes the proximal step of the contact terms: minimises
  //
  //   ½ d |w − w_0|² + F_n (w_n − g) + μ|F_n||Δ| + F_t Δ,   Δ = w_t + ρ_t − s
  //
  // behind the walls, d the node's `stiffness`. A closed node moves to the wall, a sticking one
  // back to its old place.
  void apply(const Eigen::VectorXd& stiffness, DisplacementField& w) const;

  std::vector<bool> nodes() const;  // those that it acts on
  // Vertices with more than one partner or wall, where three bodies meet, are only kept behind
  // these.
  std::vector<int> joint_nodes() const;
  const PrescribedDisplacement& given() const { return given_; }
  const std::map<int, ContactNode>& contact() const { return contact_; }  // without joints
  bool is_given(int node) const {
    return given_.at[static_cast<std::size_t>(node)] || given_.normal.contains(node);
  }

 private:
  void move(int one, const ContactNode& node, const Eigen::VectorXd& stiffness,
            DisplacementField& w) const;
  void move_pair(int one, const ContactNode& node, const Eigen::VectorXd& stiffness,
                 DisplacementField& w) const;

  PrescribedDisplacement given_;
  std::map<int, ContactNode> contact_;
  std::vector<std::pair<int, ContactNode>> joints_;  // without forces and friction
};

}  // namespace airybench
