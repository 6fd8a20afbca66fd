// Two contact faces whose meshes are made to match, node by node: what matched_faces.hpp builds on.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "assembly/problem/scene.hpp"

namespace airybench {

// Of the normals of two edges: where it is smaller, their face has a corner (20°).
inline constexpr double min_cosine_of_face = 0.94;

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
