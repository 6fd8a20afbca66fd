// What bench reads: edge_displacements_mm.npy, F_C.mtx, log.txt, and answer.json at last.
#pragma once

#include <map>

#include "peers/petsc/edge_system.hpp"
#include "solvers/two_level/active_rows.hpp"

namespace airybench {

struct Said {
  double estimate = 0, time_s = 0;  // estimate: of what has converged
  std::map<std::string, double> stages;
  std::string coarse;
  PetscInt coarse_unknowns = 0;
};
// At rank 0, of the file's edges: x, y at the low vertex, x, y at the high one; of the rows' u,
// with the rigid motion; mm.
Eigen::Matrix4Xd gather_displacements(const EdgeSystem& system, const Eigen::VectorXd& u);

// Collective; rank 0 writes.
void write_answer(const std::filesystem::path& folder, const Eigen::Matrix4Xd& u,
                  const RowsResult& answer, const Said& said);

}  // namespace airybench
