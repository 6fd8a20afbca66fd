// A part of the body as a Problem, and the whole boundary, which every rank has: its size is about
// the square root of the body's.
//
// The part's vertices keep the order of their numbers in the file, so that edges keep their
// direction. Its boundary rows are the edges of the whole boundary that it has, not edges shared
// with other parts.
#pragma once

#include "peers/petsc/distributed_mesh.hpp"
#include "solvers/condensation/hybridized.hpp"

namespace airybench {

struct ContactEdge {
  int edge, first_point;  // local edge; contact point at its start
};

struct BodyPart {
  Numbering vertices, edges;
  // Triangles of the part, with local numbers; the rigid motion is the whole body's.
  Problem problem;
  // Every row of the boundary with its vertices and edges; no triangles.
  Problem boundary;
  std::vector<int> row_of_part;  // row of problem.mesh.boundary → row of boundary.mesh.boundary
  std::vector<int> boundary_vertex;  // local vertex of the part → vertex of `boundary`, or −1
  ContactPoints contact;             // of the whole boundary
  std::vector<ContactEdge> contact_edges;  // of own triangles
  Eigen::VectorXd compliance;              // rough, per row of F_C
  HybridizedSystem system;                 // unknowns: slots of local edges; no K, no loads
};
BodyPart make_body_part(MeshPart own, const NpzSlices& file);

// Sums columns per row of the parts' boundaries into the rows of the whole one. Collective.
Eigen::MatrixXd of_whole_boundary(const BodyPart& part, const Eigen::MatrixXd& of_part);

}  // namespace airybench
