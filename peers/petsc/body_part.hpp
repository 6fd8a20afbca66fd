// The body of a part as a Problem of its own, and the whole boundary, which every rank has: it is
// the square root of the body.
//
// The part's vertices keep the order of their numbers in the file, so that edges keep their
// direction. Its boundary has rows for those edges of the whole boundary that the part has, and
// none for edges that it shares with other parts.
#pragma once

#include "assembly/dual_system.hpp"
#include "peers/petsc/distributed_mesh.hpp"

namespace airybench {

struct BodyPart {
  MeshPart mesh;
  // Triangles of the part; numbers are local. Its rigid motion is that of the whole body.
  Problem problem;
  // Without triangles and edges, but the vertices of the boundary only: every row of it.
  Problem boundary;
  std::vector<int> row_of_part;  // row of problem.mesh.boundary → row of boundary.mesh.boundary
  std::vector<int> boundary_vertex;  // local vertex of the part → vertex of `boundary`, or −1
  ContactPoints contact;             // of the whole boundary
  Eigen::VectorXd compliance;        // rough, of every row of F_C
};
// A rank's own triangles; `file` has the boundary.
BodyPart make_body_part(MeshPart mesh, NpzSlices& file);

}  // namespace airybench
