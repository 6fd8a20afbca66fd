// What bench reads: edge_displacements_mm.npy, F_C.mtx, log.txt, and answer.json at last.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "peers/petsc/active_sets.hpp"

namespace airybench {

// At rank 0, of the file's edges: x, y at the low vertex, x, y at the high one; of u, with the
// rigid motion; mm.
using EdgeDisplacements = Eigen::Matrix4Xd;
EdgeDisplacements gather_displacements(const EdgeSystem& system, Vec u);

struct Said {
  bool converged = false;
  double estimate = 0, time_s = 0;
  std::map<std::string, double> stages;
  std::string coarse;
  PetscInt coarse_unknowns = 0;
};
// Collective; rank 0 writes.
void write_answer(const std::filesystem::path& folder, const EdgeDisplacements& u,
                  const ContactAnswer& answer, const Said& said);

}  // namespace airybench
