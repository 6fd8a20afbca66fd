// Contact only where it may be: D has rows for the candidates, a part of the contact edges.
//
// D costs n_c³ operations, and of a pin in its hole three quarters of the edges are open. Edges
// that are no candidates stay free edges of the body, without force. Afterwards r_n ≤ 0 is asked of
// them: where it does not hold they and their neighbours become candidates, and the body is solved
// again. So the answer is that of all points, to rounding.
#pragma once

#include <vector>

#include "solvers/base/method.hpp"

namespace airybench {

// The law at the points of these rows of Mesh::boundary alone.
ContactPoints at_rows(const ContactPoints& points, const std::vector<bool>& rows);

// `solve` with these candidates, per row of Mesh::boundary; of a pair both rows are. It must return
// EdgeDisplacements. Where nearly all contact edges are candidates it is `solve` itself.
Solve on_candidates(Solve solve, const Problem& problem, std::vector<bool> rows);

// Contact edges that have had force, to choose candidates on a finer mesh of the same bodies.
class ClosedEdges {
 public:
  // Of an answer of one load step; steps add up.
  void add(const ContactSystem& system, const Solution& answer);
  // Those nearer to a closed edge of their group than two of its lengths. Empty: none was closed.
  std::vector<bool> candidates(const Mesh& finer) const;

 private:
  struct Closed {
    std::string label;
    Eigen::Vector2d from, to;
  };
  std::vector<Closed> closed_;
};

}  // namespace airybench
