// Gap and friction on Γ_C, for the whole scene and for groups of its edges.
#pragma once

#include <string_view>
#include <vector>

#include "assembly/matched_faces.hpp"
#include "assembly/scene.hpp"
#include "assembly/wall_gap.hpp"

namespace airybench {

inline constexpr std::string_view out_of_reach = "out of reach";

// A mesh whose contact edges can all meet their wall or another body. pieces: of g0 without
// clearance, per row of Mesh::boundary; none without a wall. Load steps change neither.
struct ReachableContact {
  Mesh mesh;
  std::vector<std::optional<MatchedEdge>> matched;  // per row
  Problem::Matching changes;
  std::vector<std::vector<GapPiece>> pieces;
};
// Throws TransformError if the curve that a contact edge stands for is farther from it.
void check_face(const Mesh& mesh, int row, const std::string& label, const Wall& face,
                double allowed_mm);
inline constexpr double most_of_face = 0.05;  // of the mesh's size

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

inline constexpr double max_friction = 1e6;  // more is no other law, and loses digits of μ F_n
// μ per row of Mesh::boundary.
std::vector<double> contact_friction(const ReachableContact& contact, const Scene& scene);

// Problem::opposite.
std::vector<int> opposite_edges(const ReachableContact& contact);

}  // namespace airybench
