// Blind condensation (the paper, section 3.2.1, eq. (6)–(8)): the contact forces are condensed out
// of the whole system at once, whatever its blocks are.
//
//        ⎡ S   C_Fᵀ C_Cᵀ ⎤ ⎡ φ  ⎤   ⎡ q        ⎤
//   M₁₁  ⎢ C_F  0    0   ⎥ ⎢ λ  ⎥ = ⎢ F        ⎥ =  b + [0 0 I]ᵀ F_C,    λ' = −ū_C = G − D F_C
//        ⎣ C_C  0    0   ⎦ ⎣ λ' ⎦   ⎣ F_C − F0 ⎦
//
//   G = (M₁₁⁻¹ b)_λ',   D e_j = −(M₁₁⁻¹ e_j)_λ' with the unit vector of λ'_j:  1 + n_c solves
//
// S is positive definite and C has full rank: M₁₁ has n positive and n_f + n_c negative
// eigenvalues.
//
// A numbering in which every multiplier comes after all its unknowns makes the leading blocks of
// M₁₁ ones of the same kind, [S_k C_kᵀ; C_k 0] with whole rows of C. So M₁₁ = L D Lᵀ exists without
// pivoting, D positive at unknowns and negative at multipliers.
#pragma once

#include <Eigen/SparseCore>
#include <functional>
#include <vector>

#include "assembly/airy_system.hpp"
#include "solvers/condensation/finish.hpp"

namespace airybench {

struct BlindSystem {
  Eigen::SparseMatrix<double> lower;  // M₁₁, lower triangle
  Eigen::VectorXd load;               // b; empty: zero
  std::vector<int> position;          // of φ, λ, λ' in them
  std::size_t bytes() const;
};

// Positions of φ, λ, λ': in this order, or every multiplier right after the last of its unknowns,
// which keep their order.
enum class BlindNumbering { multipliers_last, multipliers_after_unknowns };
BlindSystem make_blind_system(const AirySystem& system, BlindNumbering numbering);

// X ← M₁₁⁻¹ X for a block of right-hand sides.
using BlindSolve = std::function<void(Eigen::Ref<Eigen::MatrixXd>)>;

// D and G, right-hand sides made a block of columns at a time. Throws Breakdown when D is not
// positive definite to rounding.
contact::Problem condense_blindly(const AirySystem& system, const BlindSystem& blind,
                                  const BlindSolve& solve, int columns_at_once);
// From the Schur complement −W of λ' and the reduced load: D = W⁻¹. Throws the same.
contact::Problem condense_blindly(const ContactPoints& points, const Eigen::MatrixXd& schur,
                                  const Eigen::VectorXd& reduced_load);

// The right-hand side that belongs to contact forces; vectors from and to φ, λ, λ'.
Eigen::VectorXd blind_right_hand_side(const AirySystem& system, const BlindSystem& blind,
                                      const Eigen::VectorXd& F_C);
SaddleVector by_blocks(const AirySystem& system, const BlindSystem& blind,
                       const Eigen::VectorXd& solution);
Eigen::VectorXd in_one(const AirySystem& system, const BlindSystem& blind, const SaddleVector& v);

// All that follows the factorisation of M₁₁, by solves: condenses, and finishes. owner: of `blind`
// and of what `solve` refers to.
void solve_blindly(const AirySystem& system, const RunControl& control, const BlindSystem& blind,
                   const BlindSolve& solve, int columns_at_once, Solution& solution,
                   const std::shared_ptr<const void>& owner);

// Throws Breakdown when the factor of M₁₁ has another number of negative pivots than expected.
void check_inertia(int negative_pivots, int expected);

}  // namespace airybench
