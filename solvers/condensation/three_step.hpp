// Three-step condensation (the paper, section 3.2.3).
//
//   1  X = S⁻¹ [C_Fᵀ C_Cᵀ],  x = S⁻¹ q;   K = C X  in blocks K_FF, K_FC, K_CC
//   2  eliminate λ:   K_FF λ = C_F x − F − K_FC λ'
//   3  eliminate λ':  W = K_CC − K_CF K_FF⁻¹ K_FC,  D = W⁻¹,
//                     G = D (C_C x + F0 − K_CF K_FF⁻¹ (C_F x − F))
//
// K, K_FF and W are symmetric positive definite since C has full rank. Step 2 is left out where no
// force is prescribed, step 3 where there is no contact, x where there is no load. As in the paper
// X is stored whole: n (n_f + n_c) numbers, most of the method's memory; in a file, as the paper
// proposes; or not at all, a batch of columns giving way to the next once it is in K.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "assembly/airy_system.hpp"
#include "solvers/condensation/column_store.hpp"
#include "solvers/condensation/finish.hpp"

namespace airybench {

// X ← S⁻¹ X for a block of right-hand sides.
using SolveInPlace = std::function<void(Eigen::Ref<Eigen::MatrixXd>)>;

struct KeepX {
  enum class Where { memory, file, nowhere };
  Where where = Where::memory;
  int batch = 192;  // columns at a time, if nowhere
};

struct ThreeStep {
  contact::Problem condensed;         // empty without contact
  std::vector<int> row_of_column;     // column k of X belongs to row row_of_column[k] of [C_F; C_C]
  ColumnStore X;                      // n × (n_f + n_c), or empty if it is kept nowhere
  Eigen::VectorXd x;                  // S⁻¹ q; empty: zero
  Eigen::MatrixXd K_FF_inverse_K_FC;  // n_f × n_c
  Eigen::MatrixXd K_FF_factor;        // its Cholesky factor; none without force rows
  Eigen::VectorXd lambda_0;           // K_FF⁻¹ (C_F x − F); empty: zero

  std::size_t bytes() const;  // on the heap, without D and G
};

// Throws Breakdown when K_FF or W is not positive definite to rounding.
ThreeStep condense_in_three_steps(const AirySystem& system, const SolveInPlace& solve,
                                  const KeepX& keep = {});

// All that follows a factorisation of S, or its preconditioner: condenses, and finishes. owner: of
// what solve_S refers to, if the body can be kept for other load cases.
void solve_in_three_steps(const AirySystem& system, const RunControl& control,
                          const SolveInPlace& solve_S, const KeepX& keep, Refine refine,
                          Solution& solution, const std::shared_ptr<const void>& owner = nullptr);

// The scaled Airy unknowns and multipliers that belong to contact forces F_C (see AirySystem).
// `solve` is called once if X was kept nowhere.
SaddleVector recover_airy_unknowns(const ThreeStep& three_step, const AirySystem& system,
                                   const Eigen::VectorXd& F_C, const SolveInPlace& solve);

// Solves [S Cᵀ; C 0] for any right-hand side, in place: the three steps again. `solve` is called
// once, or twice if X was kept nowhere.
void solve_saddle(const ThreeStep& three_step, const AirySystem& system, const SolveInPlace& solve,
                  SaddleVector& v);

// Row k of [C_F; C_C].
SparseRows::InnerIterator constraint_row(const AirySystem& system, int k);

}  // namespace airybench
