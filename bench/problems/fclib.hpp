// Contact problems in the FCLIB format, HDF5 (Acary, Brémond, Koziara & Pérignon, INRIA report
// RT-0444, 2014), which Siconos and LMGC90 read and write. Components per contact point: normal,
// one tangential in the plane, two in space:
//
//   u = W r + q,   r_n ≥ 0, u_n ≥ 0, r_n u_n = 0;   |r_t| ≤ μ r_n, sliding opposed
//
// Written, spacedim 2:
//
//   r = −F_C in N,  u = −s (ū_C − ḡ) in N,  W = s D,  q = s (G + ḡ),  s = 1/mean diag D in N/mm
//
// The factor s makes errors that add r and u independent of the unit of length. Without friction
// the tangential rows of W are those of the identity and q and μ are zero there: r_t = u_t = 0.
//
//   /fclib_local   spacedim = 2; W, square, in compressed rows, all entries; vectors/q, mu; info
//   /solution      u, r: an answer to compare with
//   /airybench     scale_N_per_mm: s; and contact_arrays() by name, without D
//
// Read, spacedim 2 or 3:
//
//   /fclib_local   W; vectors/q, mu
//   /fclib_global  M, H; vectors/f, w, mu: condensed (solvers/condensation/global_problem.hpp)
//
// with matrices in compressed rows (nz = −2), compressed columns (−1) or triplets. W and M must be
// symmetric to 1 % of the largest diagonal entry; what differs is kept. Only libhdf5 reads them:
// FCLIB's own library ends the process on a bad file.
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
// W or M is not symmetric, W has a diagonal entry ≤ 0, M is not positive definite, or if there are
// equality constraints.
contact::Problem read_fclib(const std::filesystem::path& file);
// Which libhdf5 may end, if the file is damaged; the function above tries it in another.
contact::Problem read_fclib_in_this_process(const std::filesystem::path& file);

}  // namespace airybench
