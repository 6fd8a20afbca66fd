// What a factor holds and what it took to make it, into the solution of the method that uses it:
// bytes, non-zeros, flops, and the library's own count where it has one.
#pragma once

#include "solvers/direct/cholmod.hpp"
#include "solvers/direct/multifrontal.hpp"
#include "solvers/direct/mumps.hpp"
#include "solvers/direct/skyline.hpp"

namespace airybench {

void count_factor(const SkylineFactor& factor, Solution& solution);
void count_factor(const MultifrontalFactor& factor, Solution& solution);
// Makes it, too, in the stages `order` and `factor`.
SkylineFactor factor_in_stages(const Eigen::SparseMatrix<double>& lower, const Deadline& deadline,
                               Solution& solution);
// After the solves: their workspace stays, and counts.
void count_factor(const CholmodFactor& factor, Solution& solution);
void count_factor(const MumpsFactor& factor, Solution& solution);

}  // namespace airybench
