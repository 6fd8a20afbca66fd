// The bodies that contact alone holds (free_motions.hpp) as rigid ones: what contact can do for
// them at all, whatever the mesh within the bodies and the stresses.
//
//   r = N q − ḡ,   M q = l + Nᵀ F   with the law of contact_problem.hpp
//
// F are forces at both ends of every contact edge: on a straight edge they have the resultants of
// all pressures. q are amounts of the free motions, as the bodies would start to move if they had
// the same density.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "assembly/problem/held_points.hpp"
#include "assembly/problem/problem.hpp"

namespace airybench {

struct RigidContact {
  static constexpr int held = -1;  // no free piece
  struct End {
    Eigen::Vector2d at_mm;
    double edge_mm, friction;
    double gap_mm;              // at least 0: an overlap presses bodies, it does not hold them
    std::array<int, 2> pieces;  // on which F acts
    int face;                   // straight contact edges in a row have the same
  };
  std::vector<FreeMotion> motions;
  std::vector<std::string> bodies;     // per motion, for messages
  Eigen::VectorXd loads_N;             // l
  std::vector<End> ends;               // those that resist a motion; of a pair one
  Eigen::MatrixXd normal, tangential;  // N, ends × motions
  double rounding_N = 0;               // of l
  double rounding_on_points_N = 0;     // the same of loads that balance in the digits of an input
  HeldPoints points;

  // Of loads that need no contact: rounding_N, and 1e-9 of the largest.
  double negligible_N() const;
  // M: per motion the body's area over the largest.
  Eigen::VectorXd masses() const;
};

// For problems with free motions. degree: of the stresses (work_on_free_motion()).
RigidContact rigid_contact(const Problem& problem, int degree = 1);

// Bases, columns, in amounts of the motions, orthonormal in M: of those that no contact resists, as
// along faces without friction, and of those across. Resistance to 1e-8 of a motion is none.
struct MotionSpaces {
  Eigen::MatrixXd open, resisted;
};
MotionSpaces motion_spaces(const RigidContact& contact);

// "(2, 0)"; "along (0.6, 0.8)".
std::string words_of_place(const Eigen::Vector2d& x);
std::string words_of_direction(const Eigen::Vector2d& v);
// "no contact resists, and no load moves, the body up along (1, 0)"; empty: there is none, or
// points hold them.
std::string words_of_open_motions(const RigidContact& contact);

// Pieces that move alike, as one rigid body.
struct RigidGroup {
  std::vector<int> pieces;
  std::string bodies;                 // "the body low and the body high"
  Eigen::Vector2d velocity = {0, 0};  // of the common centroid
  double turn = 0;                    // ω
  Eigen::Vector2d centroid = {0, 0}, force_N = {0, 0};
  double moment_Nmm = 0;  // about the centroid
  double size_mm = 0;     // ω of this radius is compared with velocities

  bool turns() const;
  Eigen::Vector2d pole() const;  // at rest, if it turns
  double moment_about(const Eigen::Vector2d& x) const;
};
// With the piece on which M q is largest.
RigidGroup fastest_group(const RigidContact& contact, const Eigen::VectorXd& q,
                         const Eigen::VectorXd& unbalanced_N);
// The same with other loads on its motions.
RigidGroup with_loads(const RigidContact& contact, RigidGroup group,
                      const Eigen::VectorXd& loads_N);

}  // namespace airybench
