#include "peers/petsc/matrices.hpp"

#include <algorithm>

namespace airybench {

using namespace parallel;

// Blocks per own row, in columns of this rank and of others. Other ranks send their blocks of our
// rows as both, since a column that is not theirs may be ours. A pair on the border counts twice.
OwnedMat square_matrix(const Numbering& entities, int unknowns, const std::vector<Pair>& pairs,
                       const char* type, int block_size, const char* prefix) {
  std::vector<PetscInt> in(entities.global.size(), 0), out(in);
  for (int e = 0; e < entities.count(); ++e) in[e] = entities.is_owned(e);
  for (const Pair& pair : pairs)
    for (const auto& [row, column] : {std::pair{pair.a, pair.b}, std::pair{pair.b, pair.a}}) {
      const bool own_row = entities.is_owned(row), own_column = entities.is_owned(column);
      in[row] += own_row == own_column;
      out[row] += !own_row || !own_column;
    }
  const PetscInt per_entity = unknowns / block_size;
  const auto in_rows = [&](const std::vector<PetscInt>& counts, PetscInt most) {
    std::vector<PetscInt> of_row(static_cast<std::size_t>(entities.owned), 0), result;
    to_rows(entities.to_owned, MPIU_INT, counts.data(), of_row.data(), MPI_SUM);
    for (const PetscInt count : of_row)
      result.insert(result.end(), static_cast<std::size_t>(per_entity),
                    per_entity * std::min(count, most));
    return result;
  };
  const std::vector<PetscInt> in_row = in_rows(in, entities.owned),
                              out_row = in_rows(out, entities.all - entities.owned);
  OwnedMat matrix;
  const PetscInt own = unknowns * entities.owned;
  check(MatCreate(PETSC_COMM_WORLD, matrix.put()));
  check(MatSetOptionsPrefix(matrix, prefix));
  check(MatSetSizes(matrix, own, own, PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetType(matrix, type));
  check(MatSetBlockSize(matrix, block_size));
  check(MatSetFromOptions(matrix));
  check(
      MatXAIJSetPreallocation(matrix, block_size, in_row.data(), out_row.data(), nullptr, nullptr));
  check(MatSetOption(matrix, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  return matrix;
}

void set_rigid_modes(Mat matrix, const std::vector<FramedPoint>& points) {
  Eigen::MatrixX3d modes(2 * points.size(), 3);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto& [x, frame] = points[p];
    Eigen::Matrix<double, 2, 3> motions;
    motions << 1, 0, -x.y(), 0, 1, x.x();
    modes.middleRows<2>(2 * static_cast<Eigen::Index>(p)) = frame.transpose() * motions;
  }
  std::array<Vec, 3> of_modes{};
  for (int m = 0; m < 3; ++m) {
    for (int before = 0; before < m; ++before)
      modes.col(m) -= sum(modes.col(m).dot(modes.col(before))) * modes.col(before);
    modes.col(m) /= std::sqrt(sum(modes.col(m).squaredNorm()));
    check(MatCreateVecs(matrix, nullptr, &of_modes[m]));
    check(VecCopy(as_vec(modes.col(m)), of_modes[m]));
  }
  MatNullSpace space = nullptr;
  check(MatNullSpaceCreate(PETSC_COMM_WORLD, PETSC_FALSE, 3, of_modes.data(), &space));
  check(MatSetNearNullSpace(matrix, space));
  check(MatNullSpaceDestroy(&space));
  for (Vec& mode : of_modes) check(VecDestroy(&mode));
}

}  // namespace airybench
