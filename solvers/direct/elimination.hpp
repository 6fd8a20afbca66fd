// In which order unknowns are eliminated, and by which fronts: the symbolic half of a multifrontal
// factorisation (Duff & Reid 1983, doi:10.1145/356044.356047; Liu 1992, doi:10.1137/1034004).
//
// Unknowns that the same elements have are alike (those of an edge, of a node). They are ordered,
// and their fill is found, as one vertex of a compressed graph (Ashcraft 1995,
// doi:10.1137/0916081): by minimum degree, within the parts of a nested dissection where there are
// many (dissection.hpp); the last `trailing` unknowns stay last. Minimum degree (CAMD), elimination
// tree and supernodes are CHOLMOD's.
#pragma once

#include <cstdint>
#include <vector>

#include "solvers/base/element_matrices.hpp"
#include "solvers/base/index_lists.hpp"

namespace airybench {

// A supernode: pivots and the rows below them, by place in the order.
struct Front {
  int first = 0, pivots = 0;  // places first … first + pivots − 1
  std::size_t rows_at = 0;    // its rows in Elimination::rows: pivots, then those below
  int rows = 0;               // pivots and below, ascending
  std::size_t panel_at = 0;   // rows × pivots entries of the factor
  int below() const { return rows - pivots; }
  std::size_t update_doubles() const {  // of what it leaves to its parent
    return static_cast<std::size_t>(below()) * static_cast<std::size_t>(below());
  }
};

struct Elimination {
  std::vector<int> place;  // of every unknown
  std::vector<Front> fronts;
  IndexLists children;     // of each front, in the order in which they are to be done
  IndexLists elements;     // whose first pivot is one of the front's
  std::vector<int> order;  // of the fronts: every one after its children
  std::vector<int> rows;
  int trailing = 0;
  int max_rows = 0;                // of a front
  std::size_t panel_entries = 0;   // of all fronts
  std::size_t update_doubles = 0;  // most at a time, by the fronts' order
  std::int64_t entries() const;    // of L, with the zeros that supernodes store
  double flops() const;            // additions and multiplications, Σ (rows of a pivot)²
};

// Throws std::bad_alloc.
Elimination analyse_elimination(const ElementMatrices& K, int trailing);

}  // namespace airybench
