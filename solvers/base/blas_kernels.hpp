// The kernels that BLAS computes with.
//
// OpenBLAS chooses them when it is loaded, from a table of processors. One that is newer than the
// library it takes for the oldest that it knows, Prescott of 2004 (0.3.21 does so on Emerald
// Rapids): dgemm then has a third of its rate. OPENBLAS_CORETYPE, read at that moment only,
// overrules the table.
#pragma once

#include <string>

namespace airybench {

// What OPENBLAS_CORETYPE should be; empty: OpenBLAS took what fits, or was told what to take.
std::string better_blas_core();

// Starts the program anew with that setting, which programs that it starts inherit. Returns where
// there is none to make, or it cannot be made.
void restart_with_better_blas_core(char* const* argv);

}  // namespace airybench
