// Checks before a run that BLAS, OpenMP and the methods can have their threads. Later is too late:
// a BLAS thread asks for memory until it gets it, and a fork or the program's end waits for that
// thread; OpenMP ends a process that gets no thread.
#pragma once

#include <string>

namespace airybench {

int processors_at_hand();

// Why the address space (ulimit -v) is too small for `threads` or BLAS's own; empty if it is not.
std::string lack_of_address_space(int threads);

// The same before libraries are initialised: without memory OpenBLAS 0.3.29 never finishes that.
// For .preinit_array: ends the program with a line and exit code 2.
void end_for_lack_of_address_space(int, char**, char** environment);

// Throws UsageError if address space or threads (ulimit -u) are too few.
void require_threads(int threads);

}  // namespace airybench
