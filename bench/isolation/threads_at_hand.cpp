#include "bench/isolation/threads_at_hand.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <future>
#include <system_error>
#include <thread>
#include <vector>

#include "solvers/base/blas_library.hpp"
#include "support/errors.hpp"

namespace airybench {
namespace {

// All at once.
bool can_start(int threads) {
  std::promise<void> end;
  const std::shared_future<void> ended = end.get_future().share();
  std::vector<std::jthread> started;
  bool all = true;
  try {
    for (int k = 0; k < threads; ++k) started.emplace_back([ended] { ended.wait(); });
  } catch (const std::system_error&) {
    all = false;
  }
  end.set_value();
  return all;
}

}  // namespace

int processors_at_hand() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

std::string lack_of_address_space(int threads) {
  constexpr std::uint64_t MiB = 1024 * 1024;
  // A thread's stack and BLAS's buffer of 128 MiB; the program itself.
  constexpr std::uint64_t of_thread = 136 * MiB, of_program = 96 * MiB;
  rlimit limit = {};
  const int most = std::max(threads, blas_threads());
  const std::uint64_t needed = of_program + static_cast<std::uint64_t>(most) * of_thread;
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ||
      limit.rlim_cur >= needed)
    return {};
  return fmt::format(
      "the address space is limited to {} MiB (ulimit -v; allowed: from {} MiB on for BLAS on {} "
      "threads{})",
      limit.rlim_cur / MiB, needed / MiB, most,
      most > threads ? ", fewer with OPENBLAS_NUM_THREADS=1" : "");
}

void require_threads(int threads) {
  if (const std::string lack = lack_of_address_space(threads); !lack.empty())
    throw UsageError(lack);
  // Of BLAS, of OpenMP and of a method, and the processes of a scene and a case.
  if (threads > 1 && !can_start(3 * threads + 2))
    throw UsageError(fmt::format(
        "--threads: {} (allowed: fewer, as the machine has no more to give: ulimit -u)", threads));
}

}  // namespace airybench
