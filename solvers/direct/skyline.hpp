// LDLᵀ factorisation in skyline storage.
//
// S = L D Lᵀ with unit lower triangular L and diagonal D. Row i of L begins where row i of S does,
// so the skyline (profile, envelope) of S is kept: Jennings 1966; George & Liu, Computer Solution
// of Large Sparse Positive Definite Systems, ch. 4. There is no pivoting; S is symmetric positive
// definite, or at least has non-singular leading blocks.
//
// Rows are kept in panels so that the work is matrix–matrix products. In a reverse Cuthill–McKee
// numbering tall rows alternate with short ones, so inside a panel the tall rows are put first, and
// each kind has its own leading column:
//
//        column     short_column    row
//          ┌──────────────────────┬───────┐  tall     three dense column-major blocks:
//          │         tall         │       │  rows     tall, short, corner; the corner's
//          └──────────┬───────────┤corner │           upper triangle is not used
//                     │   short   │       │  the
//                     └───────────┴───────┘  rest
//
// Up-looking by panels: with W = L D, panel I takes for every earlier panel K it reaches
//   W_IK = (A_IK − Σ_J W_IJ L_KJᵀ) L_KK⁻ᵀ,   then L_I = W_I D⁻¹,  L_II D_I L_IIᵀ = A_II − W_I L_Iᵀ.
#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <functional>
#include <vector>

#include "solvers/base/solution.hpp"

namespace airybench {

struct SkylinePanel {
  int row = 0;           // its first row
  int rows = 0;          // how many
  int tall = 0;          // how many of them are tall; these come first
  int column = 0;        // leading column of the tall rows, ≤ row
  int short_column = 0;  // leading column of the others, between column and row
  std::int64_t size() const {
    return std::int64_t{tall} * (row - column) + std::int64_t{rows - tall} * (row - short_column) +
           std::int64_t{rows} * rows;
  }
};

// Symbolic analysis: from the pattern alone.
struct SkylineProfile {
  int n = 0;
  std::vector<SkylinePanel> panels;
  std::vector<int> panel_of_row;
  std::vector<int> position;  // of every row of S, in its panel's order; it stays in its panel
  std::int64_t profile = 0;  // Σ_i h_i, h_i = i − first column of row i + 1: the classical skyline
  std::int64_t stored = 0;  // entries of all panels, ≥ profile
  // Additions and multiplications that the skyline itself needs, padding not counted.
  double factor_flops = 0;     // Σ_i h_i²
  std::size_t bytes() const {  // of the analysis itself
    return panels.size() * sizeof(SkylinePanel) +
           (panel_of_row.size() + position.size()) * sizeof(int);
  }
  double solve_flops() const { return 4.0 * static_cast<double>(profile); }  // per dense column
};

// Order of the rows inside a panel: tall ones first, or as they are numbered (more padding).
enum class PanelOrder { tall_first, as_numbered };

// lower: lower triangle with sorted columns. panel_rows: rows per panel, 1 … max_panel_rows; the
// last may have fewer. More rows make faster products and more padding (Mesh7: 1.19 of the profile
// is stored with 48, 1.25 with 64).
inline constexpr int max_panel_rows = 256;
SkylineProfile analyse_skyline(const Eigen::SparseMatrix<double>& lower, int panel_rows = 48,
                               PanelOrder order = PanelOrder::tall_first);

struct SkylineFactor {
  SkylineProfile profile;
  std::vector<std::vector<double>> values;  // L, the three blocks of each panel
  Eigen::VectorXd diagonal;                 // D, in the panels' order
  std::int64_t entries() const { return profile.profile; }
  double flops() const { return profile.factor_flops; }
  std::size_t bytes() const {
    return static_cast<std::size_t>(profile.stored + diagonal.size()) * sizeof(double) +
           profile.bytes();
  }
};

// Throws Breakdown with value and place, in the order of its panel, at a pivot that is zero or not
// finite; TimeoutReached.
SkylineFactor factor_ldlt(SkylineProfile profile, const Eigen::SparseMatrix<double>& lower,
                          const Deadline& deadline = {});

// The same with its analysis, as the stages `order` and `factor` of a solution, counted.
SkylineFactor factor_in_stages(const Eigen::SparseMatrix<double>& lower, const Deadline& deadline,
                               Solution& solution);

// Row by row and without keeping the whole: calls visit(i, j, l, d) for every row i in order, with
// l = L_ij, L_i,j+1, …, L_i,i−1 and d = D_j, …, D_i, both valid during the call only. What no later
// row needs is forgotten, so the memory is that of the rows within a band. Rows are as numbered.
// Returns SkylineProfile::factor_flops.
using VisitRow = std::function<void(int i, int j, const double* l, const double* d)>;
double visit_ldlt_rows(const Eigen::SparseMatrix<double>& lower, const VisitRow& visit,
                       const Deadline& deadline = {});

// X ← S⁻¹ X for n × k right-hand sides, in parallel by columns. Panels above the first non-zero of
// a block of columns are skipped in the forward sweep, so neighbouring columns should begin alike.
inline constexpr int skyline_columns_at_once = 192;  // as wide as the products need, in the cache
void solve_in_place(const SkylineFactor& factor, Eigen::Ref<Eigen::MatrixXd> X,
                    const Deadline& deadline = {}, int threads = 1);

}  // namespace airybench
