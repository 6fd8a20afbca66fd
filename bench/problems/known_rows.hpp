// Which force each row of C_F and C_C is.
#pragma once

#include <vector>

#include "assembly/problem.hpp"

namespace airybench {

struct KnownRow {
  int boundary_row;  // of Mesh::boundary
  int end;           // 0: start of its walk, 1: end
  Eigen::Vector2d direction;
};

// Known::force: the rows of C_F, Known::contact_law: those of C_C, in their order
// (dual_system.hpp).
std::vector<KnownRow> known_rows(const Problem& problem, Known known);

}  // namespace airybench
