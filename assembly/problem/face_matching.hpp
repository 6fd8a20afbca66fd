// Two contact faces whose meshes are made to match, node by node: what matched_faces.hpp builds on.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "assembly/problem/scene.hpp"

namespace airybench {

// What a contact edge stands for: the curve that the scene gives its group, or else the circle
// through the ends and the middle of the mesh's own curve; none: itself.
std::optional<Wall> curve_of(const Mesh& mesh, int boundary_row, const Scene& scene);

// At x on an edge of normal m that stands for the curve; m where the curve has none.
Eigen::Vector2d normal_of_curve(const Wall& curve, const Eigen::Vector2d& x,
                                const Eigen::Vector2d& m);

// The edges of one or more groups, with a normal at every vertex.
struct MatchingFace {
  std::vector<int> rows;                     // of Mesh::boundary
  std::map<int, std::optional<Wall>> curve;  // per row
  std::map<int, Eigen::Vector2d> normal;     // per vertex: the mean of two edges', or the curve's
  std::set<int> fixed;                       // vertices that must stay: ends and corners
};
MatchingFace face_of(const Mesh& mesh, const std::vector<std::string>& labels, const Scene& scene);
double diagonal_mm(const Mesh& mesh);

// Throws TransformError if the curve that a contact edge stands for is farther from it.
void check_face(const Mesh& mesh, int row, const std::string& label, const Wall& face,
                double allowed_mm);
inline constexpr double max_of_face = 0.05;  // of the mesh's size

struct FaceMatching {
  std::map<int, int> twin;  // per vertex of the first face, the vertex of the second that it faces
  std::array<std::map<int, Eigen::Vector2d>, 2> normal;  // per face and vertex
  Problem::Matching changes;
  std::vector<int> split_rows;  // of Mesh::boundary, with vertices inserted
};

// A vertex nearer to one of the other face than this share of the shorter edge at either is moved.
inline constexpr double snapping = 0.15;

// Puts the vertices of each face into the other, or moves those that nearly match. Vertices farther
// apart than the mesh's diagonal do not face each other. Throws TransformError: a place is met
// twice, and the mesh of no use.
FaceMatching match_faces(Mesh& mesh, const ContactPair& pair, const Scene& scene);

}  // namespace airybench
