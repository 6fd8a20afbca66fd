// The stiffness of the hybridized system (hybridized.hpp) as 4×4 blocks over edges.
//
//   K = L + D + Lᵀ,   L strictly lower, D block diagonal
//
// Vectors have four slots per edge, components as in EdgeUnknowns, edges in the order in which the
// triangles meet them: neighbours stay near each other in memory. Slots that are prescribed are
// there, too. A pair of edges is in one triangle at most: a block of L is one of K_e.
#pragma once

#include <vector>

#include "solvers/condensation/hybridized.hpp"

namespace airybench {

struct EdgeMatrix {
  std::vector<int> block_of_edge;     // edge → block row
  std::vector<int> start;             // block row → its first block of L; one more at the end
  std::vector<int> column;            // per block of L
  std::vector<Eigen::Matrix4d> left;  // L, N/mm
  std::vector<Eigen::Matrix4d> diagonal;

  int blocks() const { return static_cast<int>(diagonal.size()); }
  Eigen::Index slots() const { return 4 * static_cast<Eigen::Index>(diagonal.size()); }
  std::size_t bytes() const {
    return (block_of_edge.size() + start.size() + column.size()) * sizeof(int) +
           (left.size() + diagonal.size()) * sizeof(Eigen::Matrix4d);
  }
  // y = K x.
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
};

EdgeMatrix make_edge_matrix(const Problem& problem, const HybridizedSystem& system);

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
