// Contact problems in the FCLIB format, HDF5 (Acary, Brémond, Koziara & Pérignon, INRIA report
// RT-0444, 2014), which Siconos and LMGC90 read. Two components per contact point, normal first:
//
//   u = W r + q,   r_n ≥ 0, u_n ≥ 0, r_n u_n = 0;   |r_t| ≤ μ r_n, sliding opposed
//   r = −F_C in N,  u = −s (ū_C − ḡ) in N,  W = s D,  q = s (G + ḡ),  s = 1/mean diag D in N/mm
//
// The factor s makes errors that add r and u independent of the unit of length. Without friction
// the tangential rows of W are those of the identity and q and μ are zero there: r_t = u_t = 0.
//
//   /fclib_local   spacedim = 2; W, square, in compressed rows, all entries; vectors/q, mu; info
//   /solution      u, r: an answer to compare with
//   /airybench     scale_N_per_mm: s; and contact_arrays() by name, without D
//
// Files of other programs need /fclib_local with spacedim 2 and W in compressed rows (nz = −2),
// compressed columns (−1) or triplets. W must be symmetric up to rounding, which is kept. Only
// libhdf5 reads them: FCLIB's own library ends the process on a bad file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/problems/problem_arrays.hpp"

namespace airybench {

// answer: empty to leave out /solution. arrays: contact_arrays() and more. title: for readers.
std::string fclib_file(const contact::Problem& problem, const Eigen::VectorXd& answer,
                       const std::vector<ProblemArray>& arrays, const std::string& title);

// D = W, G = q, F = −r. Throws FileError (one line: file, dataset, value, what is allowed), also if
// W is not symmetric or has a diagonal entry ≤ 0, or if there are equality constraints.
contact::Problem read_fclib(const std::filesystem::path& file);

}  // namespace airybench
