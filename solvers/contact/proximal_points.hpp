// Proximal points (Rockafellar 1976, doi:10.1137/0314056) for the condensed contact problem where
// active sets alone do not end: of many contacts, with a D that is singular or nearly so. With d
// the mean of D's diagonal
//
//   F ← the F' that meets the law with r = D F' + s d (F' − F) − G − ḡ
//
// by active sets from F, which take a few steps where s is not small; a fixed point meets the law
// itself. s starts at 0.01, is halved after three that ended, and tripled after one that did not.
#pragma once

#include "solvers/contact/condensed.hpp"

namespace airybench {

// Goes on from a result and replaces it by a better one, if it finds one, until the natural map is
// options.tolerance or has not been halved for long. D is dense or by rows.
void finish_by_proximal_points(const contact::Problem& problem, const ContactOptions& options,
                               const Deadline& deadline, ContactResult& result);

}  // namespace airybench
