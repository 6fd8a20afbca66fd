// The stiffness of the hybridized system (hybridized.hpp) as 4×4 blocks over edges.
//
//   K = L + D + Lᵀ,   L strictly lower, D block diagonal
//
// Vectors have four slots per edge, components as in EdgeUnknowns. Slots that are prescribed are
// there, too. A pair of edges is in one triangle at most: a block of L is one of K_e.
//
// The triangles, in their order, are cut into pieces; edges between two pieces come last:
//
//   ⎡ K_1         K_1sᵀ ⎤     edges of a piece in the order in which its triangles meet them, so
//   ⎢     K_2     K_2sᵀ ⎥     that neighbours are near each other in memory. Threads take pieces;
//   ⎣ K_1s  K_2s  K_s   ⎦     sums do not depend on how many threads there are.
#pragma once

#include <functional>
#include <vector>

#include "solvers/condensation/hybridized.hpp"

namespace airybench {

struct EdgeMatrix {
  int threads = 1;                    // that take pieces
  std::vector<int> block_of_edge;     // edge → block row
  std::vector<int> piece;             // its first block; after the last those of s
  std::vector<int> start;             // block row → its first block of L; one more at the end
  std::vector<int> column;            // per block of L
  std::vector<Eigen::Matrix4d> left;  // L, N/mm
  std::vector<Eigen::Matrix4d> diagonal;

  int blocks() const { return static_cast<int>(diagonal.size()); }
  Eigen::Index slots() const { return 4 * static_cast<Eigen::Index>(diagonal.size()); }
  std::size_t bytes() const {
    return (block_of_edge.size() + piece.size() + start.size() + column.size()) * sizeof(int) +
           (left.size() + diagonal.size()) * sizeof(Eigen::Matrix4d);
  }
  int pieces() const { return static_cast<int>(piece.size()) - 1; }
  // Calls work(begin, end) on the blocks of every piece.
  void visit_pieces(const std::function<void(int begin, int end)>& work) const;
  // y = K x.
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
};

EdgeMatrix make_edge_matrix(const Problem& problem, const HybridizedSystem& system,
                            int threads = 1);

// Slots that are prescribed.
std::vector<Eigen::Index> prescribed_slots(const EdgeMatrix& K, const EdgeUnknowns& unknown);
// ū0 in its slots, else zero.
Eigen::VectorXd prescribed_in_slots(const EdgeMatrix& K, const HybridizedSystem& system);
// From the numbering of EdgeUnknowns to slots and back; prescribed slots are zero.
Eigen::VectorXd to_slots(const EdgeMatrix& K, const EdgeUnknowns& unknown,
                         const Eigen::VectorXd& u);
Eigen::VectorXd from_slots(const EdgeMatrix& K, const EdgeUnknowns& unknown,
                           const Eigen::VectorXd& x, Eigen::Index unknowns);

}  // namespace airybench
