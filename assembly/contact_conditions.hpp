// Gap and friction on Γ_C: what a scene says of it all, and of groups of its edges.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "assembly/boundary_values.hpp"
#include "assembly/wall_gap.hpp"

namespace airybench {

// Of contact edges whose group has no value of its own.
struct ContactDefaults {
  double friction = 0, clearance_mm = 0;
  // Without a wall: clearance + d²/(2R), where d is the distance from the middle of the contact
  // face that the edge belongs to, the midpoint of the face's two ends. None: flat, as on closed
  // faces.
  std::optional<double> crown_radius_mm;
  std::optional<Wall> wall, face;
};

// The group of force edges that were contact edges.
inline constexpr std::string_view out_of_reach = "out of reach";
// Edges from which no wall is met, nearer than a hundred sizes of the body and at less than 87° to
// their normal, cannot touch: they become free edges of that group. An edge that is met in a part
// of it only has the largest gap that is seen from its ends and middle. Throws TransformError: a
// wall that no edge of a group meets, or that lies more than a tenth of the body's size inside it,
// clearance or not; a face that is farther from an edge than 5 % of that size.
Mesh with_reachable_contact(Mesh mesh, const BoundaryConditions& conditions,
                            const ContactDefaults& defaults);

// g0 of such a mesh, quadratic on every edge, through its values at both ends and the middle, and
// what that leaves out of the walls. Empty: zero.
struct ContactGap {
  std::function<double(const Eigen::Vector2d& x, int boundary_row)> gap_mm;
  std::vector<WallDetail> detail;  // per row of Mesh::boundary
};
ContactGap contact_gap(const Mesh& mesh, const BoundaryConditions& conditions,
                       const ContactDefaults& defaults);

// Per row of Mesh::boundary; empty: the edges' own.
std::vector<ContactNormals> contact_normals(const Mesh& mesh, const BoundaryConditions& conditions,
                                            const ContactDefaults& defaults);

// μ per row of Mesh::boundary.
std::vector<double> contact_friction(const Mesh& mesh, const BoundaryConditions& conditions,
                                     const ContactDefaults& defaults);

}  // namespace airybench
