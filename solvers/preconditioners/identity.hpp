// NONE: M = I.
#pragma once

#include "solvers/preconditioners/preconditioner.hpp"

namespace airybench {

inline Preconditioner identity_preconditioner(const SparseColumns&, const Deadline&) {
  Preconditioner result;
  result.applier = [](int) { return [](LaneBlock&) {}; };
  return result;
}

}  // namespace airybench
