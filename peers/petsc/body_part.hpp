// A part of the body as a Problem, and the whole boundary, which every rank has: its size is about
// the square root of the body's.
//
// The part's vertices keep the order of their numbers in the file, so that edges keep their
// direction. Its boundary has rows for those edges of the whole boundary that the part has, and
// none for edges that it shares with other parts.
#pragma once

#include "peers/petsc/distributed_mesh.hpp"
#include "solvers/condensation/hybridized.hpp"

namespace airybench {

struct ContactEdge {
  int edge, first_point;  // local; of its start
};

struct BodyPart {
  Numbering vertices, edges;
  // Triangles of the part; numbers are local. Its rigid motion is that of the whole body.
  Problem problem;
  // Without triangles, but the vertices and edges of the boundary only: every row of it.
  Problem boundary;
  std::vector<int> row_of_part;  // row of problem.mesh.boundary → row of boundary.mesh.boundary
  std::vector<int> boundary_vertex;  // local vertex of the part → vertex of `boundary`, or −1
  ContactPoints contact;             // of the whole boundary
  std::vector<ContactEdge> contact_edges;  // of own triangles
  Eigen::VectorXd compliance;              // rough, of every row of F_C
  HybridizedSystem system;  // slots of local edges are its unknowns; without K and loads
};
// A rank's own triangles; `file` has the boundary.
BodyPart make_body_part(MeshPart own, const NpzSlices& file);

// Columns, or numbers, of a part's rows of the boundary, in their rows of the whole one.
Eigen::MatrixXd of_whole_boundary(const BodyPart& part, const Eigen::MatrixXd& of_part);

}  // namespace airybench
