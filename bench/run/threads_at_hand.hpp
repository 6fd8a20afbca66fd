// Can BLAS, OpenMP and the methods have their threads? It is asked before: a thread of BLAS asks
// for memory until it gets it, and a fork or the end of the program waits for that thread; OpenMP
// ends a process that gets no thread.
#pragma once

#include <string>

namespace airybench {

// Processors that this process may run on.
int processors_at_hand();

// Why the address space (ulimit -v) is too small for so many threads, and for those that BLAS has
// started by itself; empty: it is not.
std::string lack_of_address_space(int threads);

// The same before libraries are initialised, which OpenBLAS 0.3.29 does not end without its memory:
// a function for the program's .preinit_array, which ends the program with a line and exit code 2.
void end_for_lack_of_address_space(int, char**, char** environment);

// Throws UsageError: not enough address space, or threads (ulimit -u).
void require_threads(int threads);

}  // namespace airybench
