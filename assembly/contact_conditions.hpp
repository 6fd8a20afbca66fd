// Gap and friction on Γ_C: what a scene says of it all, and of groups of its edges.
#pragma once

#include <string_view>
#include <vector>

#include "assembly/scene.hpp"
#include "assembly/wall_gap.hpp"

namespace airybench {

// The group of force edges that were contact edges.
inline constexpr std::string_view out_of_reach = "out of reach";

// A mesh whose contact edges can all meet their wall, and the pieces of g0 without clearance per
// row of Mesh::boundary; none where an edge has no wall. Neither changes along a path of load
// steps.
struct ReachableContact {
  Mesh mesh;
  std::vector<std::vector<GapPiece>> pieces;
};
// Edges from which no wall is met, nearer than a hundred sizes of the body and at less than 87° to
// their normal, cannot touch: they become free edges of the group above. An edge that is met in a
// part of it only has the largest gap that is seen from its ends and middle. Throws TransformError:
// a wall that no edge of a group meets, or that lies more than a tenth of the body's size inside
// it, clearance or not; a face that is farther from an edge than 5 % of that size.
ReachableContact with_reachable_contact(Mesh mesh, const Scene& scene);

// g0, quadratic on every edge, through its values at both ends and the middle, and what that leaves
// out of the walls. Without a wall it is clearance + d²/(2R), where d is the distance from the
// midpoint of the two ends of the edge's contact face. Empty: zero.
struct ContactGap {
  std::function<double(const Eigen::Vector2d& x, int boundary_row)> gap_mm;
  std::vector<WallDetail> detail;  // per row of Mesh::boundary
};
ContactGap contact_gap(const ReachableContact& contact, const Scene& scene);

// Per row of Mesh::boundary; empty: the edges' own.
std::vector<ContactNormals> contact_normals(const Mesh& mesh, const Scene& scene);

// μ per row of Mesh::boundary.
std::vector<double> contact_friction(const Mesh& mesh, const Scene& scene);

}  // namespace airybench
