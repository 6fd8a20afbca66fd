// Space for a matrix over the ranks before anything is put into it.
#pragma once

#include "peers/petsc/distributed_mesh.hpp"

namespace airybench {

// Rows and columns of a square matrix with as many unknowns per entity: what every pair of entities
// needs there. Creates it with that space, type and further options by its prefix.
struct Pair {
  int a, b;  // local entities
};
void create_square_matrix(const Numbering& entities, int unknowns, const std::vector<Pair>& pairs,
                          const char* type, int block_size, const char* prefix,
                          parallel::OwnedMat& matrix);

}  // namespace airybench
