// The alternating direction method of multipliers for the condensed contact problem (Glowinski &
// Marroco 1975; Boyd et al. 2011, doi:10.1561/2200000016): forces F that obey D, and a copy z that
// obeys the law's bounds,
//
//   (D + W) F = G + ḡ + W (z − y),   z = P(F + y),   y ← y + F − z
//
// P is the projection of coulomb_law.hpp, W = w diag(W_p) one weight for a point, W_p the mean of
// its diagonal of D. At a fixed point F = z and r = D F − G − ḡ = −W y, so that the natural map is
// zero. Coulomb's law is no minimum, there is no proof of convergence; z counts by its natural map.
//
// How D + W is solved with: weighted_compliance.hpp. Of a D that is not quite symmetric that has
// the symmetric part; the rest acts on the last F.
//
// w is chosen while it runs: where F − z and the change of z, both in W's norm, are apart by more
// than 10, it is multiplied or divided by 2 (ibid., 3.4.1), and D + W is factorised again. It
// may change less and less often, so that it settles.
#pragma once

#include "solvers/contact/condensed.hpp"

namespace airybench {

ContactResult solve_contact_by_admm(const contact::Problem& problem,
                                    const ContactOptions& options = {},
                                    const Deadline& deadline = {});

}  // namespace airybench
