// How ill-conditioned a symmetric matrix is, from its factor: a few solves, no matrix but A itself.
//
//   κ₁ = ‖Â‖₁ ‖Â⁻¹‖₁,  Â = d A d with d_i = 1/√A_ii; where A_ii is not positive (a multiplier's
//   row),
//                       d_i makes the row's largest entry 1
//
// ‖Â‖₁ is exact. ‖Â⁻¹‖₁ = max ‖Â⁻¹x‖₁ over ‖x‖₁ = 1 is a convex function's maximum on a polytope;
// one walks from vertex to vertex along its subgradient (Hager 1984, doi:10.1137/0905023), and one
// more solve with an alternating vector guards against what that overlooks (Higham 1988,
// doi:10.1145/50063.214386, algorithm SONEST). The result is a lower bound of κ₁, seldom below a
// third of it.
#pragma once

#include <Eigen/SparseCore>
#include <functional>

namespace airybench {

// lower: A's lower triangle. solve: X ← A⁻¹ X. At most 12 solves, most often 4 or 5. Infinite when
// a solve gives a value that is not finite.
double estimate_condition(const Eigen::SparseMatrix<double>& lower,
                          const std::function<void(Eigen::Ref<Eigen::MatrixXd>)>& solve);

}  // namespace airybench
