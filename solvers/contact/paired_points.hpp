// Bodies that press on each other: the contact law between both points of a pair.
//
// Methods condense bodies with a force at every point of each (contact_problem.hpp): ū = D F − G.
// In their opposite frames both points of a pair have the same F, and the law acts on the sum of
// their displacements less gaps. With T, a one for each point in the column of its pair or its own,
//
//   F = T F',   r' = D' F' − G' − ḡ',   D' = Tᵀ D T,   G' = Tᵀ G,   ḡ' = Tᵀ ḡ
//
// is a problem like that of one body and a wall; D' is positive definite where D is.
#pragma once

#include "assembly/contact_problem.hpp"

namespace airybench {

// The first point of every pair, and those at walls; without pairs all.
ContactPoints joined(const ContactPoints& points);
// The problem of F'. D must be dense where there are pairs.
contact::Problem joined(const contact::Problem& problem);
// Rows of joined points from rows of all: of the first point of each pair; of both, added.
Eigen::VectorXd of_first(const ContactPoints& points, const Eigen::VectorXd& rows);
Eigen::VectorXd of_both(const ContactPoints& points, const Eigen::VectorXd& rows);
// T F'.
Eigen::VectorXd at_both(const ContactPoints& points, const Eigen::VectorXd& F);

// Both rows of a pair become their sum.
template <typename Vector>
Vector sums_of_pairs(const ContactPoints& points, Vector rows) {
  const int m = points.components;
  for (int p = 0; p < points.count; ++p)
    if (const int q = points.opposite_of(p); q > p) {
      rows.segment(m * p, m) += rows.segment(m * q, m).eval();
      rows.segment(m * q, m) = rows.segment(m * p, m);
    }
  return rows;
}
// Both become their mean, of these weights.
void set_means_of_pairs(const ContactPoints& points,
                        const Eigen::Ref<const Eigen::VectorXd>& weight,
                        Eigen::Ref<Eigen::VectorXd> rows);

}  // namespace airybench
