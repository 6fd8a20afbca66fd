// A contact problem with the unknowns v of bodies in it, as FCLIB's global problems are:
//
//   M v = H r + f,  u = Hᵀ v + w;   W = Hᵀ M⁻¹ H,  q = w + Hᵀ M⁻¹ f,  so that u = W r + q
//
// r, u: forces and velocities (or displacements) at the contacts, in the file's units. The factor
// of M is CHOLMOD's.
//
// Which entries of W can differ from zero is known from M's blocks, the bodies: those of two
// contacts on one body. W is held sparse or dense by their number (held_sparse()); where they would
// take much more memory than M and H, it is not formed.
#pragma once

#include <cstdint>

#include "assembly/contact_problem.hpp"

namespace airybench {

// A matrix of this size with so many entries that are not zero: by rows, else dense. Small ones are
// dense: there BLAS is faster.
bool held_sparse(std::int64_t size, std::int64_t entries);

struct CondensationLimit {
  // W is formed with at most this many entries, or so many times those of M and H.
  std::int64_t entries = 2'000'000, times = 10;
};

// D = W, G = q, and how; the caller adds the points, of so many components. M: n × n, symmetric,
// whole; H: n × n_c. Throws Breakdown if M is not positive definite to rounding.
contact::Problem condense_global(Eigen::SparseMatrix<double> M, Eigen::SparseMatrix<double> H,
                                 const Eigen::VectorXd& f, const Eigen::VectorXd& w,
                                 const CondensationLimit& limit = {});

}  // namespace airybench
