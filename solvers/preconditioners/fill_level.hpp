// FLICk: incomplete Cholesky factorisation by level of fill (Gustafsson 1978; Saad, Iterative
// Methods for Sparse Linear Systems, 10.3).
//
// Entries of S have level 0; fill L_ij by L_ik L_jk has level(i,k) + level(j,k) + 1, the least over
// k; what is above k is never computed. Every row is made from the previous rows of the
// *incomplete* factor. S is no M-matrix, so a pivot may be too small: then S + shift · diag(S) is
// factorised instead, the shift doubled until it goes through (Manteuffel 1980).
#pragma once

#include "solvers/preconditioners/preconditioner.hpp"
#include "solvers/preconditioners/triangular_solve.hpp"

namespace airybench {

struct FillLevelFactor {
  IncompleteFactor factor;
  double shift = 0;
};

// Throws Breakdown when no shift up to 1 helps.
FillLevelFactor fill_level_factor(const SparseColumns& lower, int level,
                                  const Deadline& deadline = {});
Preconditioner fill_level_preconditioner(const SparseColumns& lower, double level,
                                         const Deadline& deadline = {});

}  // namespace airybench
