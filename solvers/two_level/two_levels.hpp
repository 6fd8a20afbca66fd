// Two levels for the hybridized system: x = M⁻¹ r by
//
//   (L + D) x = r                      a sweep over the edges' 4×4 blocks
//   x ← x + P (PᵀKP)⁻¹ Pᵀ (r − K x)    coarse displacements, exactly
//   (D + Lᵀ) (x⁺ − x) = r − K x        a sweep backwards
//
// symmetric, K ≤ M. Held slots are out of it: zero in x, and r is not asked for there. A sweep and
// the residual that follows read K's triangle once.
#pragma once

#include <memory>

#include "solvers/two_level/coarse_displacements.hpp"

namespace airybench {

// √cond(M⁻¹K), about: 2 with linear coarse displacements, 3.5 with one per edge.
inline constexpr double two_level_condition = 3;

class TwoLevelPreconditioner {
 public:
  TwoLevelPreconditioner(const EdgeMatrix& K, std::unique_ptr<CoarseDisplacements> coarse);
  // These slots and no others; those that are prescribed among them.
  void hold(const std::vector<Eigen::Index>& held);
  void apply(const Eigen::VectorXd& r, Eigen::VectorXd& x);
  const CoarseDisplacements& coarse() const { return *coarse_; }
  IterationTimes& times() { return times_; }
  std::size_t bytes() const;  // without the coarse factor

 private:
  // x_i = K_ii⁻¹ (r_i − Σ K_ij x_j) over the blocks j before i, whose rest_ loses K_ji x_i.
  void relax(int i, const Eigen::VectorXd& r, Eigen::VectorXd& x);
  void sweep_forward(const Eigen::VectorXd& r, Eigen::VectorXd& x);  // rest_ = r − K x
  void sweep_backward(const Eigen::VectorXd& r, Eigen::VectorXd& x);

  const EdgeMatrix& K_;
  std::unique_ptr<CoarseDisplacements> coarse_;
  std::vector<Eigen::Matrix4d> inverse_;  // of D on what is not held
  std::vector<Eigen::Index> held_;
  Eigen::VectorXd rest_;
  IterationTimes times_;
};

}  // namespace airybench
