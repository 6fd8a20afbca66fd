// Triangulated plane bodies with the role of every boundary edge.
//
// The boundary is split into three parts, Γ = Γ_D ∪ Γ_F ∪ Γ_C: prescribed displacement, prescribed
// traction, contact with a rigid wall or another body. A valid mesh has one or more pieces that no
// triangle joins, each with any number of holes: a piece's boundary is one closed curve and another
// around each hole, which the body has on its left, too.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/edge_curve.hpp"
#include "support/errors.hpp"

namespace airybench {

enum class BoundaryRole : std::uint8_t { displacement, force, contact };
inline constexpr std::array<std::string_view, 3> boundary_role_names = {"displacement", "force",
                                                                        "contact"};

struct BoundaryEdge {
  static constexpr int no_group = -1;
  std::array<int, 2> vertices;  // start, end; the body lies on the left (counter-clockwise walk)
  BoundaryRole role;
  int group = no_group;  // row of Mesh::boundary_groups
  // What the edge stands for: a curve from its start to its end, which refinement follows.
  EdgeCurve curve = {};
};

struct Mesh {
  std::string name;                           // "Mesh3", or the file's name; for messages, records
  std::vector<Eigen::Vector2d> vertices;      // mm
  std::vector<std::array<int, 3>> triangles;  // vertex numbers, counter-clockwise
  std::vector<int> triangle_body;             // per triangle: its row in body_names
  std::vector<std::string> body_names;        // at least one
  std::vector<BoundaryEdge> boundary;         // every boundary edge once, any order
  std::vector<std::string> boundary_groups;   // names; "top" of edges that are "force:top"
  bool is_polygon = false;                    // no edge stands for a curve, even if it looks so
};

// The group of edges that an edge belongs to: its role, "force", or its role and the name of its
// group, "force:top". Edges of one name and two roles are two groups.
std::string boundary_label(const Mesh& mesh, const BoundaryEdge& edge);

// From the direction into a corner of the boundary to that out of it, in [−π, π): −π at the tip of
// a crack, where the body is all around.
double turning_angle(const Eigen::Vector2d& in, const Eigen::Vector2d& out);

// Where a boundary edge is cut, at a parameter of its curve or chord, and how: it keeps the first
// part, the second is returned. vertex: at that place.
Eigen::Vector2d point_on(const Mesh& mesh, const BoundaryEdge& edge, double t);
BoundaryEdge cut_at(BoundaryEdge& edge, int vertex, double t);

// Per row of Mesh::boundary.
Mesh with_roles(Mesh mesh, const std::vector<BoundaryRole>& roles);

// The row of a name in Mesh::boundary_groups, which is added if it is new; no_group for no name.
int boundary_group(Mesh& mesh, std::string_view name);

// The role and the group's name (empty: none) that a label stands for; none when it is no label.
struct BoundaryLabel {
  BoundaryRole role;
  std::string_view name;
};
std::optional<BoundaryLabel> parse_boundary_label(std::string_view label);
inline constexpr std::string_view boundary_labels_allowed =
    "displacement, force, contact, or one of these with a name: force:top";

// A mesh or a mesh file that cannot be used. what() is one line: file or mesh name, entity, what is
// wrong, what is allowed. Vertices, triangles and boundary edges are counted from 1 there.
struct MeshError : InputError {
  using InputError::InputError;
};

// Twice the signed area of triangle abc, mm²; positive when counter-clockwise. Computed in Scalar.
template <typename Scalar = double>
Scalar cross_area(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const auto x = [&](const Eigen::Vector2d& p) { return Scalar(p.x()) - Scalar(a.x()); };
  const auto y = [&](const Eigen::Vector2d& p) { return Scalar(p.y()) - Scalar(a.y()); };
  return x(b) * y(c) - y(b) * x(c);
}

// Twice a triangle's area, relative to its longest edge squared, below which it counts as flat.
inline constexpr double flat_triangle_tolerance = 1e-13;

// Throws MeshError on the first of: no triangles; a vertex that is not finite, or in no triangle; a
// triangle with a vertex out of range, of (numerically) zero area or clockwise; an edge shared by
// more than two triangles; a boundary edge that is not on the boundary, given twice, walked against
// its triangle, or of a group that does not exist; a boundary edge without a role; neither
// displacement nor contact edges; within a piece a boundary that touches or crosses itself or,
// around a hole, another one; triangles that overlap; a curve that does not start and end at its
// edge's vertices. Different pieces may touch and overlap, and contact edges of one piece lie on
// each other: the faces of a crack, whose tips are single vertices.
void validate(const Mesh& mesh);

// Parts that no triangle joins, numbered in the order of their lowest vertices.
struct MeshPieces {
  int count = 0;
  std::vector<int> of_vertex;
};
MeshPieces pieces_of(const Mesh& mesh);

// Of a valid mesh, by Euler's formula: vertices − edges + triangles = pieces − holes.
int hole_count(const Mesh& mesh);

// The edges of a valid mesh.
struct MeshEdges {
  std::vector<std::array<int, 2>> vertices;     // per edge: low vertex, high vertex
  std::vector<std::array<int, 3>> of_triangle;  // per triangle: edge k joins its vertices k, k+1
  std::vector<int> of_boundary;                 // per row of Mesh::boundary: its edge
  int count() const { return static_cast<int>(vertices.size()); }
};
MeshEdges number_edges(const Mesh& mesh);

// The boundary edges of one role, as chains: each inner vector lists rows of Mesh::boundary that
// follow one another, the body on their left. A closed one starts at its lowest row; the chains
// start at the mesh's lowest such row.
std::vector<std::vector<int>> boundary_chains(const Mesh& mesh, BoundaryRole role);

// Sizes as the paper's Tab. 1 counts them.
struct MeshSizes {
  int n_phi = 0;  // 3 vertices + edges: all HCT degrees of freedom, the 3 of the gauge too
  int n_f = 0;    // 4 per force edge
  int n_c = 0;    // 4 per contact edge
  int displacement_edges = 0;
  int force_edges = 0;
  int contact_edges = 0;
};
MeshSizes mesh_sizes(const Mesh& mesh);

// The body's measures. Meshes of one body agree in them, but for what a curved side loses.
struct MeshExtent {
  double area_mm2 = 0, contact_length_mm = 0, width_mm = 0, height_mm = 0;
  double diagonal_mm() const { return std::hypot(width_mm, height_mm); }
};
MeshExtent extent_of(const Mesh& mesh);

}  // namespace airybench
