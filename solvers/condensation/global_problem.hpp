// A contact problem with the unknowns v of bodies in it, as FCLIB's global problems are:
//
//   M v = H r + f,  u = Hᵀ v + w;   W = Hᵀ M⁻¹ H,  q = w + Hᵀ M⁻¹ f,  so that u = W r + q
//
// r, u: forces and velocities (or displacements) at the contacts, in the file's units.
#pragma once

#include <Eigen/SparseCore>

#include "assembly/contact_problem.hpp"

namespace airybench {

// D = W, G = q; the caller adds the points. M: n × n, symmetric, whole; H: n × n_c. The factor of M
// is CHOLMOD's. Throws Breakdown if M is not positive definite to rounding.
contact::Problem condense_global(const Eigen::SparseMatrix<double>& M,
                                 const Eigen::SparseMatrix<double>& H, const Eigen::VectorXd& f,
                                 const Eigen::VectorXd& w);

}  // namespace airybench
