// LDLᵀ factorisation in skyline storage.
//
// S = L D Lᵀ with unit lower triangular L and diagonal D. Row i of L begins where row i of S does,
// so the skyline (profile, envelope) of S is kept: Jennings 1966; George & Liu, Computer Solution
// of Large Sparse Positive Definite Systems, ch. 4. There is no pivoting; S is symmetric positive
// definite, or at least has non-singular leading blocks.
//
// Rows are kept in panels so that the work is matrix–matrix products:
//
//        c        r         r+m       panel of rows r..r+m−1, from its leading column c:
//   c.. ┌─────────┬─────────┐         one dense column-major block, m × (r+m−c);
//       │  left   │  corner │  m rows the corner's upper triangle is not used
//       └─────────┴─────────┘
//
// Up-looking by panels: with W = L D, panel I takes for every earlier panel K it reaches
//   W_IK = (A_IK − Σ_J W_IJ L_KJᵀ) L_KK⁻ᵀ,   then L_I = W_I D⁻¹,  L_II D_I L_IIᵀ = A_II − W_I L_Iᵀ.
#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

#include "solvers/solution.hpp"

namespace airybench {

struct SkylinePanel {
  int row;              // its first row
  int rows;             // m
  int column;           // its leading column, ≤ row
  std::int64_t offset;  // where its block begins in SkylineFactor::values
  int left() const { return row - column; }
  int width() const { return row + rows - column; }
};

// Symbolic analysis: the panels, from the pattern alone.
struct SkylineProfile {
  int n = 0;
  std::vector<SkylinePanel> panels;
  std::vector<int> panel_of_row;
  std::int64_t profile = 0;  // Σ_i (i − first column of row i + 1), the classical skyline
  std::int64_t stored = 0;   // entries of all panels, ≥ profile
  // Additions and multiplications that the skyline itself needs, padding not counted.
  double factor_flops = 0;                                                   // Σ_i h_i²
  double solve_flops() const { return 4.0 * static_cast<double>(profile); }  // per dense column
};

// lower: lower triangle with sorted columns. panel_rows: the most rows a panel may have.
SkylineProfile analyse_skyline(const Eigen::SparseMatrix<double>& lower, int panel_rows = 64);

struct SkylineFactor {
  SkylineProfile profile;
  std::vector<double> values;  // L in panels
  Eigen::VectorXd diagonal;    // D
  std::size_t bytes() const {
    return (values.size() + static_cast<std::size_t>(diagonal.size())) * sizeof(double);
  }
};

// Throws Breakdown with row and value at a pivot that is zero or not finite; TimeoutReached.
SkylineFactor factor_ldlt(SkylineProfile profile, const Eigen::SparseMatrix<double>& lower,
                          const Deadline& deadline = {});

// X ← S⁻¹ X for n × k right-hand sides. Rows above the first non-zero of a block of columns are
// skipped in the forward sweep, so neighbouring columns should begin alike.
void solve_in_place(const SkylineFactor& factor, Eigen::Ref<Eigen::MatrixXd> X,
                    const Deadline& deadline = {});

}  // namespace airybench
