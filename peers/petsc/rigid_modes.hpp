// The rigid motions of the plane as near-nullspace of a matrix with two displacements per point.
#pragma once

#include "peers/petsc/parallel.hpp"

namespace airybench {

struct FramedPoint {
  Eigen::Vector2d x = {0, 0};
  Eigen::Matrix2d frame = Eigen::Matrix2d::Identity();  // columns: directions of the two
};
// points: of this rank's rows, two by two.
void set_rigid_modes(Mat matrix, const std::vector<FramedPoint>& points);

}  // namespace airybench
