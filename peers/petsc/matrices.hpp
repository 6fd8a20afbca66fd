// Matrices over the ranks: preallocation and near-nullspaces.
#pragma once

#include "peers/petsc/distributed_mesh.hpp"

namespace airybench {

struct Pair {
  int a, b;  // local entities
};
// A square matrix with equally many unknowns per entity, preallocated for all pairs; options with
// the prefix set its type and more.
parallel::OwnedMat square_matrix(const Numbering& entities, int unknowns,
                                 const std::vector<Pair>& pairs, const char* type, int block_size,
                                 const char* prefix);

struct FramedPoint {
  Eigen::Vector2d x = {0, 0};
  Eigen::Matrix2d frame = Eigen::Matrix2d::Identity();  // columns: directions of both displacements
};
// Sets the plane's rigid motions as near-nullspace of a matrix with two displacements per point.
// points: of this rank's rows, in pairs.
void set_rigid_modes(Mat matrix, const std::vector<FramedPoint>& points);

}  // namespace airybench
