#include "peers/petsc/rigid_modes.hpp"

#include <array>

namespace airybench {

using parallel::check;

void set_rigid_modes(Mat matrix, const std::vector<FramedPoint>& points) {
  std::array<Vec, 3> modes{};
  for (int m = 0; m < 3; ++m) {
    check(MatCreateVecs(matrix, nullptr, &modes[m]));
    PetscScalar* values = nullptr;
    check(VecGetArray(modes[m], &values));
    for (const auto& [x, frame] : points) {
      const std::array<Eigen::Vector2d, 3> motion = {
          Eigen::Vector2d::UnitX(), Eigen::Vector2d::UnitY(), {-x.y(), x.x()}};
      const Eigen::Vector2d own = frame.transpose() * motion[m];
      *values++ = own.x();
      *values++ = own.y();
    }
    values -= 2 * points.size();
    check(VecRestoreArray(modes[m], &values));
    for (int before = 0; before < m; ++before) {
      PetscScalar part = 0;
      check(VecDot(modes[m], modes[before], &part));
      check(VecAXPY(modes[m], -part, modes[before]));
    }
    check(VecNormalize(modes[m], nullptr));
  }
  MatNullSpace space = nullptr;
  check(MatNullSpaceCreate(PETSC_COMM_WORLD, PETSC_FALSE, 3, modes.data(), &space));
  check(MatSetNearNullSpace(matrix, space));
  check(MatNullSpaceDestroy(&space));
  for (Vec& mode : modes) check(VecDestroy(&mode));
}

}  // namespace airybench
