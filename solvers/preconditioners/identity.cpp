// NONE: M = I.
#include "solvers/preconditioners/preconditioner.hpp"

namespace airybench {

static Preconditioner identity_preconditioner(const SparseColumns&, double, const Deadline&) {
  Preconditioner result;
  result.applier = [](int) { return [](LaneBlock&) {}; };
  return result;
}

PreconditionerKind identity_kind() { return {"NONE", {""}, "NONE", {}, identity_preconditioner}; }

}  // namespace airybench
