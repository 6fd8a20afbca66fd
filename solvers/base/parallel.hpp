// Right-hand sides in parallel.
#pragma once

#include <functional>

namespace airybench {

// Calls work(begin, end) on `threads` neighbouring ranges that make up [0, count), each on a thread
// of its own with BLAS on one thread; on this thread when threads is 1. Exceptions are rethrown
// here; when every failure is a TimeoutReached, as the one that was furthest from its
// end, with the fraction done of all ranges.
void in_parallel(int threads, int count, const std::function<void(int begin, int end)>& work);

}  // namespace airybench
