// The BLAS that the dynamic linker gave the program.
//
// Any library may stand for libblas.so.3, so its own functions, of OpenBLAS or BLIS, are looked up
// when the program runs: in the library that cblas_dgemm is in and those that it needs, since
// another BLAS may be loaded too.
//
// OpenBLAS chooses its kernels when it is loaded, from a table of processors. One that is newer
// than the library it takes for the oldest that it knows, Prescott of 2004 (0.3.21 does so on
// Emerald Rapids): dgemm then has a third of its rate. OPENBLAS_CORETYPE, read at that moment only,
// overrules the table.
#pragma once

#include <string>

namespace airybench {

// Name and version as OpenBLAS or BLIS tells them; of another library its file.
std::string blas_name();

// The kernels that it computes with; "unknown" where it does not tell.
std::string blas_core();

// Where the library has no such setting it has one thread, and setting changes nothing.
int blas_threads();
void set_blas_threads(int threads);

// What OPENBLAS_CORETYPE should be; empty: BLAS is not OpenBLAS, or it took what fits, or was told
// what to take.
std::string better_blas_core();

// Restarts the program with that setting, which programs that it starts inherit. Returns where
// there is none to make, or it cannot be made. Throws std::bad_alloc: the program must end then,
// because a dlopen() that has once run out of memory finds no symbols of dependencies later.
void restart_with_better_blas_core(char* const* argv);

}  // namespace airybench
