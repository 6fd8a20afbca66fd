// Gap and friction on Γ_C, for the whole scene and for groups of its edges.
#pragma once

#include <string_view>
#include <vector>

#include "assembly/problem/matched_faces.hpp"
#include "assembly/problem/scene.hpp"
#include "assembly/problem/wall_gap.hpp"

namespace airybench {

// A mesh whose contact edges can all meet their wall or another body. pieces: of g0 without
// clearance, per row of Mesh::boundary; none without a wall. Load steps change neither.
struct ReachableContact {
  Mesh mesh;
  std::vector<std::optional<MatchedEdge>> matched;  // per row
  Problem::Matching changes;
  std::vector<std::vector<GapPiece>> pieces;
};
// Contact edges that meet no wall within a hundred sizes of the body and at less than 87° to their
// normal become free edges of the group `out_of_reach`. An edge that meets a wall only in part has
// the largest gap seen from its ends and middle. Throws TransformError: a wall that no edge of a
// group meets, or that lies more than a tenth of the body's size inside it, whatever the clearance;
// a face farther from an edge than 5 % of that size.
ReachableContact with_reachable_contact(MatchedFaces faces, const Scene& scene);

// g0 as a quadratic on every edge through its values at both ends and the middle, and the detail of
// walls that this omits. Without a wall or another body g0 is clearance + d²/(2R), d the distance
// from the midpoint of the two ends of the edge's contact face. gap_mm is empty if zero.
struct ContactGap {
  std::function<double(const Eigen::Vector2d& x, int boundary_row)> gap_mm;
  std::vector<WallDetail> detail;  // per row of Mesh::boundary
};
ContactGap contact_gap(const ReachableContact& contact, const Scene& scene);

// Per row of Mesh::boundary; empty: the edges' own normals.
std::vector<ContactNormals> contact_normals(const ReachableContact& contact, const Scene& scene);
// Problem::curve_normals: of the wall, or of the face; of a pair the mean of both curves' own.
std::vector<ContactNormals> curve_normals(const ReachableContact& contact, const Scene& scene);

// μ per row of Mesh::boundary.
std::vector<double> contact_friction(const ReachableContact& contact, const Scene& scene);

// Problem::opposite.
std::vector<int> opposite_edges(const ReachableContact& contact);

}  // namespace airybench
