// Contact edges of bodies that press on each other, made to match one to one.
//
// Tractions that are polynomials on every edge pass exactly from one body to another only where
// their nodes match. So the contact triangles of each side are split at the nodes of the other: a
// new node is joined to the vertex across, and nothing spreads. A vertex nearer to one of the other
// side than 0.15 of the shorter edge at either is moved along its face to meet it instead,
// unless it is an end or a corner.
//
// Points match along the normals of the first face, which turn linearly between its vertices (the
// mean of two edges' there). The common normal n of two matched nodes is the mean of both faces'
// own, next to a roller that of its face. A face's curve (Scene, `face`) has the normals of that
// curve. The gap is
//   g0 = (x_2 − x_1)·n − t_1 − t_2,   x_i + t_i n_i on the curve that face i stands for (0: itself)
// at start, middle and end of an edge. In small displacements x_1 and x_2 transmit their forces as
// if they were one point, with a moment error of the tangential part of their distance.
//
// Edges that face none of the other group become free edges (`out_of_reach`).
#pragma once

#include <optional>
#include <vector>

#include "assembly/problem/scene.hpp"

namespace airybench {

struct MatchedEdge {
  int opposite = 0;        // row of Mesh::boundary, walked the other way
  ContactNormals normals;  // outward; at the same place the opposite edge has the opposite ones
  // At start, middle and end, without clearance. Zero on the second edge of a pair: the first has
  // that of both.
  std::array<double, 3> gap_mm{};
};

struct MatchedFaces {
  Mesh mesh;
  std::vector<std::optional<MatchedEdge>> edges;  // per row of Mesh::boundary
  Problem::Matching changes = {};
  std::vector<int> split_rows;  // of the given mesh's boundary, with vertices inserted
};

// Takes a valid mesh. Throws TransformError, "contacts: …": a label that is no contact group, or
// given twice; faces that do not face each other, that meet a place twice, or that overlap by more
// than a tenth of the mesh's size in a load step; a curve farther from its edges than 5 % of it.
MatchedFaces with_matched_faces(Mesh mesh, const Scene& scene);

}  // namespace airybench
