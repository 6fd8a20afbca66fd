// Contact problems in FCLIB's format, HDF5 (Acary, Brémond, Koziara & Pérignon, INRIA
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
//   /airybench     scale_N_per_mm: s; and contact_arrays() but for D, each by its name
//
// Files of other programs are read as they are: /fclib_local with spacedim 2, W in compressed rows
// (nz = −2) or columns (−1) or as triplets, symmetric but for rounding, which is left in it. They
// are read with libhdf5 alone: FCLIB's own library ends the process over a bad file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/problems/problem_arrays.hpp"

namespace airybench {

// answer: empty, none is given away. arrays: contact_arrays() and more. title: for readers.
std::string fclib_file(const contact::Problem& problem, const Eigen::VectorXd& answer,
                       const std::vector<ProblemArray>& arrays, const std::string& title);

// D = W, G = q, F = −r. Throws FileError, one line: file, dataset, value, what is allowed; also
// where W has a diagonal entry ≤ 0 or is not symmetric, and where there are equality constraints.
contact::Problem read_fclib(const std::filesystem::path& file);

}  // namespace airybench
