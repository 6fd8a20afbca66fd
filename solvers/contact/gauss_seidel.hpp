// Nonlinear Gauss–Seidel for the condensed contact problem (NSGS; Jean & Moreau; Bisegna, Lebon &
// Maceri 2004): sweep over the points, solve each point's law exactly with all others held.
//
//   for every point p:  b = Σ_{q≠p} D_pq F_q − G_p − ḡ_p,   F_p from the law with r = D_pp F_p + b
#pragma once

#include "solvers/contact/condensed.hpp"

namespace airybench {

class GaussSeidel {
 public:
  // The problem must outlive this. Throws Breakdown unless its D is formed.
  explicit GaussSeidel(const contact::Problem& problem);
  // One sweep from F, in place; returns the norm of the change. Nothing is allocated.
  double sweep(Eigen::VectorXd& F) const;

 private:
  const contact::Problem* problem_;
  Eigen::VectorXd offset_;      // contact_offset()
  Eigen::MatrixXd transposed_;  // of a dense D that is not symmetric; else empty
};

// Not converged after options.max_iterations, unless to options.acceptable, or when a force is
// not finite.
ContactResult solve_contact_by_gauss_seidel(const contact::Problem& problem,
                                            const ContactOptions& options = {},
                                            const Deadline& deadline = {});

}  // namespace airybench
