// The condensed contact problem in FCLIB's format, HDF5 (Acary, Brémond, Koziara & Pérignon, INRIA
// report RT-0444, 2014), which Siconos and LMGC90 read. Two components per contact point, normal
// first:
//
//   u = W r + q,   r_n ≥ 0, u_n ≥ 0, r_n u_n = 0;   |r_t| ≤ μ r_n, sliding opposed
//   r = −F_C in N,  u = −s (ū_C − ḡ) in N,  W = s D,  q = s (G + ḡ),  s = 1/mean diag D in N/mm
//
// With s, measures of errors that add r to u do not depend on the unit of length. Without friction
// the tangential rows of W are those of the identity, and q and μ zero there: r_t = u_t = 0.
//
//   /fclib_local   spacedim = 2; W, square, in compressed rows, all entries; vectors/q, mu; info
//   /solution      u, r: an answer to compare with
//   /airybench     scale_N_per_mm: s; and condensed_arrays() but for D, each by its name
#pragma once

#include <string>
#include <vector>

#include "bench/problems/problem_arrays.hpp"

namespace airybench {

// title: what a reader of the file shall see. arrays: condensed_arrays() of the same.
std::string fclib_file(const CondensedProblem& condensed, const std::vector<ProblemArray>& arrays,
                       const std::string& title);

}  // namespace airybench
