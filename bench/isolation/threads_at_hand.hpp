// Can BLAS, OpenMP and the methods have their threads? A thread of BLAS asks for memory again and
// again until it gets it, a fork waits for that thread, and so does the end of the program; OpenMP
// ends a process that gets no thread. So it is asked before.
#pragma once

#include <string>

namespace airybench {

// Processors that this process may run on.
int processors_at_hand();

// Why the address space (ulimit -v) is too small for so many threads, and for those that BLAS has
// started by itself; empty: it is not.
std::string lack_of_address_space(int threads);

// Throws UsageError: not enough address space, or threads (ulimit -u).
void require_threads(int threads);

}  // namespace airybench
