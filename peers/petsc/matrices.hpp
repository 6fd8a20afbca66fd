// Matrices over the ranks: room for their entries, and near-nullspaces.
#pragma once

#include "peers/petsc/distributed_mesh.hpp"

namespace airybench {

struct Pair {
  int a, b;  // local entities
};
// A square matrix with as many unknowns per entity: creates it with room for what every pair needs
// there, and type and further options by its prefix.
parallel::OwnedMat square_matrix(const Numbering& entities, int unknowns,
                                 const std::vector<Pair>& pairs, const char* type, int block_size,
                                 const char* prefix);

struct FramedPoint {
  Eigen::Vector2d x = {0, 0};
  Eigen::Matrix2d frame = Eigen::Matrix2d::Identity();  // columns: directions of the two
};
// The rigid motions of the plane as near-nullspace of a matrix with two displacements per point.
// points: of this rank's rows, two by two.
void set_rigid_modes(Mat matrix, const std::vector<FramedPoint>& points);

}  // namespace airybench
