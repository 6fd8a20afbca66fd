#include "solvers/base/parallel.hpp"

#include <algorithm>
#include <exception>
#include <thread>
#include <vector>

#include "solvers/base/blas_library.hpp"
#include "solvers/base/solution.hpp"
#include "support/memory_owner.hpp"

namespace airybench {
namespace {

// BLAS on one thread while threads of our own call it.
class SingleThreadedBlas {
 public:
  SingleThreadedBlas() { set_blas_threads(1); }
  ~SingleThreadedBlas() { set_blas_threads(before_); }
  SingleThreadedBlas(const SingleThreadedBlas&) = delete;
  SingleThreadedBlas& operator=(const SingleThreadedBlas&) = delete;

 private:
  int before_ = blas_threads();
};

struct Range {
  int begin, end;
  std::exception_ptr failure;
};

void rethrow(const std::vector<Range>& ranges, int count) {
  double done = 0;
  std::optional<TimeoutReached> timeout;
  bool all_told = true;  // every range that ran out of time says how far it came
  for (const Range& range : ranges) {
    double share = 1;
    if (range.failure) {
      try {
        std::rethrow_exception(range.failure);
      } catch (const TimeoutReached& reached) {
        all_told = all_told && reached.done_fraction;
        share = reached.done_fraction.value_or(0);
        if (!timeout || reached.error_so_far > timeout->error_so_far) timeout = reached;
      }  // anything else goes on
    }
    done += share * (range.end - range.begin);
  }
  if (!timeout) return;
  timeout->done_fraction.reset();
  if (all_told) timeout->done_fraction = done / count;
  throw *timeout;
}

}  // namespace

void in_parallel(int threads, int count, const std::function<void(int begin, int end)>& work) {
  if (threads <= 1 || count <= 1) {
    work(0, count);
    return;
  }
  const SingleThreadedBlas single;
  threads = std::min(threads, count);
  std::vector<Range> ranges;
  for (int t = 0; t < threads; ++t)
    ranges.push_back({static_cast<int>(std::int64_t{count} * t / threads),
                      static_cast<int>(std::int64_t{count} * (t + 1) / threads), nullptr});
  std::vector<std::jthread> workers;
  for (Range& range : ranges)
    workers.emplace_back([&range, &work, owner = current_memory_owner] {
      const OwnerScope scope(owner);
      try {
        work(range.begin, range.end);
      } catch (...) {
        range.failure = std::current_exception();
      }
    });
  workers.clear();  // joins
  rethrow(ranges, count);
}

}  // namespace airybench
