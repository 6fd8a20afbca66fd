#include "peers/petsc/square_matrix.hpp"

#include <algorithm>

namespace airybench {

using namespace parallel;

void create_square_matrix(const Numbering& entities, int unknowns, const std::vector<Pair>& pairs,
                          const char* type, int block_size, const char* prefix, OwnedMat& matrix) {
  // Blocks per own row: in columns of this rank, and of others. What others know of a row of ours
  // they send; a pair on the border is counted by both.
  const PetscInt per_entity = unknowns / block_size;
  OwnedVec inside, outside;
  check(VecCreateMPI(PETSC_COMM_WORLD, entities.owned, PETSC_DETERMINE, inside.put()));
  check(VecDuplicate(inside, outside.put()));
  check(VecSet(inside, 1));
  check(VecSet(outside, 0));
  std::vector<PetscInt> rows;
  std::vector<PetscScalar> in_values, out_values;
  std::vector<double> in(entities.global.size(), 0), out(entities.global.size(), 0);
  // A column that is not ours may be the row's owner's: count it as both there.
  for (const Pair& pair : pairs)
    for (const auto& [row, column] : {std::pair{pair.a, pair.b}, std::pair{pair.b, pair.a}}) {
      const bool own_row = entities.is_owned(row), own_column = entities.is_owned(column);
      if (own_row) {
        ++(own_column ? in : out)[row];
      } else {
        ++out[row];
        if (!own_column) ++in[row];
      }
    }
  for (std::size_t e = 0; e < entities.global.size(); ++e) {
    rows.push_back(entities.global[e]);
    in_values.push_back(in[e]);
    out_values.push_back(out[e]);
  }
  const auto add = [&](Vec to, const std::vector<PetscScalar>& values) {
    check(VecSetValues(to, static_cast<PetscInt>(rows.size()), rows.data(), values.data(),
                       ADD_VALUES));
    check(VecAssemblyBegin(to));
    check(VecAssemblyEnd(to));
  };
  add(inside, in_values);
  add(outside, out_values);
  const auto counts = [&](Vec of) {
    const PetscScalar* values = nullptr;
    check(VecGetArrayRead(of, &values));
    std::vector<PetscInt> result;
    for (PetscInt e = 0; e < entities.owned; ++e)
      for (PetscInt k = 0; k < per_entity; ++k)
        result.push_back(per_entity * static_cast<PetscInt>(values[e]));
    check(VecRestoreArrayRead(of, &values));
    return result;
  };
  std::vector<PetscInt> in_row = counts(inside), out_row = counts(outside);
  PetscInt total = 0;
  check(VecGetSize(inside, &total));
  for (PetscInt& count : in_row) count = std::min(count, per_entity * entities.owned);
  for (PetscInt& count : out_row) count = std::min(count, per_entity * (total - entities.owned));
  check(MatCreate(PETSC_COMM_WORLD, matrix.put()));
  check(MatSetOptionsPrefix(matrix, prefix));
  check(MatSetSizes(matrix, unknowns * entities.owned, unknowns * entities.owned, PETSC_DETERMINE,
                    PETSC_DETERMINE));
  check(MatSetType(matrix, type));
  check(MatSetBlockSize(matrix, block_size));
  check(MatSetFromOptions(matrix));
  check(
      MatXAIJSetPreallocation(matrix, block_size, in_row.data(), out_row.data(), nullptr, nullptr));
}

}  // namespace airybench
