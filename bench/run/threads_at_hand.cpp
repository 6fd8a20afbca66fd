#include "bench/run/threads_at_hand.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <future>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "solvers/base/blas_library.hpp"
#include "support/errors.hpp"

namespace airybench {
namespace {

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

rlim_t address_space() {
  rlimit limit = {};
  return getrlimit(RLIMIT_AS, &limit) == 0 ? limit.rlim_cur : RLIM_INFINITY;
}

std::string lack_of_address_space(int most, int asked) {
  constexpr std::uint64_t MiB = 1024 * 1024;
  // of_thread: a thread's stack and BLAS's buffer of 128 MiB.
  constexpr std::uint64_t of_thread = 136 * MiB, of_program = 96 * MiB;
  const std::uint64_t needed = of_program + static_cast<std::uint64_t>(most) * of_thread;
  const rlim_t limit = address_space();
  if (limit == RLIM_INFINITY || limit >= needed) return {};
  return fmt::format(
      "the address space is limited to {} MiB (ulimit -v; allowed: from {} MiB on for BLAS on {} "
      "threads{})",
      limit / MiB, needed / MiB, most, most > asked ? ", fewer with OPENBLAS_NUM_THREADS=1" : "");
}

int threads_of_openblas(char** environment) {
  for (const std::string_view name : {"OPENBLAS_NUM_THREADS=", "OMP_NUM_THREADS="})
    for (char** variable = environment; *variable != nullptr; ++variable)
      if (std::string_view(*variable).starts_with(name))
        if (const int asked = std::atoi(*variable + name.size()); asked > 0)
          return std::min(asked, processors_at_hand());
  return processors_at_hand();
}

}  // namespace

int processors_at_hand() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

std::string lack_of_address_space(int threads) {
  return lack_of_address_space(std::max(threads, blas_threads()), threads);
}

void end_for_lack_of_address_space(int, char**, char** environment) {
  if (address_space() == RLIM_INFINITY || dlsym(RTLD_DEFAULT, "openblas_get_config") == nullptr)
    return;
  const std::string lack = lack_of_address_space(threads_of_openblas(environment), 1);
  if (lack.empty()) return;
  const std::string line = "bench: " + lack + "\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, line.data(), line.size());
  _exit(wrong_usage);
}

void require_threads(int threads) {
  if (const std::string lack = lack_of_address_space(threads); !lack.empty())
    throw UsageError(lack);
  // BLAS, OpenMP and the method each start as many; a scene and a case are processes.
  if (threads > 1 && !can_start(3 * threads + 2))
    throw UsageError(fmt::format(
        "--threads: {} (allowed: fewer, as the machine has no more to give: ulimit -u)", threads));
}

}  // namespace airybench
