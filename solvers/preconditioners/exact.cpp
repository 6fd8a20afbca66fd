#include "solvers/preconditioners/exact.hpp"

#include <memory>

#include "solvers/direct/skyline.hpp"

namespace airybench {

Preconditioner exact_preconditioner(const SparseColumns& lower, const Deadline& deadline) {
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
  return {applier, factor->bytes(), 0};
}

}  // namespace airybench
