// SKY: M = S, factorised in skyline storage.
#include <memory>

#include "solvers/direct/skyline.hpp"
#include "solvers/preconditioners/preconditioner.hpp"

namespace airybench {

// Throws Breakdown when S is not positive definite.
static Preconditioner exact_preconditioner(const SparseColumns& lower, double,
                                           const Deadline& deadline) {
  const auto factor =
      std::make_shared<const SkylineFactor>(factor_ldlt(analyse_skyline(lower), lower, deadline));
  if (!(factor->diagonal.array() > 0).all())
    throw Breakdown("skyline Cholesky: the matrix is not positive definite");
  const auto applier = [factor](int lanes) -> Apply {
    return [factor, columns = Eigen::MatrixXd(factor->profile.n, lanes)](LaneBlock& X) mutable {
      columns = X;
      solve_in_place(*factor, columns);
      X = columns;
    };
  };
  Preconditioner result;
  result.applier = applier;
  result.bytes = factor->bytes();
  result.entries = factor->profile.profile;
  result.flops = factor->profile.factor_flops;
  result.workspace_rows = factor->profile.n;
  return result;
}

PreconditionerKind exact_kind() { return {"SKY", {""}, "SKY", {}, exact_preconditioner}; }

}  // namespace airybench
