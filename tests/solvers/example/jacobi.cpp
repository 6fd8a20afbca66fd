// JACOBI: M = diag(S). S is equilibrated, so it is equivalent to NONE.
#include <memory>

#include "solvers/preconditioners/preconditioner.hpp"

namespace airybench {

static Preconditioner jacobi_preconditioner(const SparseColumns& lower, double, const Deadline&) {
  const auto diagonal = std::make_shared<const Eigen::ArrayXd>(lower.diagonal().array());
  if (!(*diagonal > 0).all()) throw Breakdown("JACOBI: a diagonal entry is not positive");
  Preconditioner result;
  result.applier = [diagonal](int) -> Apply {
    return [diagonal](LaneBlock& X) { X.array().colwise() /= *diagonal; };
  };
  result.bytes = static_cast<std::size_t>(diagonal->size()) * sizeof(double);
  result.entries = diagonal->size();
  return result;
}

PreconditionerKind jacobi_kind() { return {"JACOBI", {""}, "JACOBI", {}, jacobi_preconditioner}; }

}  // namespace airybench
