#include "bench/measure/noise_kernel.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <barrier>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "support/seconds_since.hpp"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace airybench {
namespace {

constexpr int rows = 128;

// Sanitizers would slow the loops over these arrays too much.
struct Work {
  double column[rows][rows];  // lower triangle: column[j][i], i ≥ j
  double values[noise_sweep_length];
};
#define AIRYBENCH_NOT_SANITIZED __attribute__((no_sanitize("address", "undefined")))

// A = I + 1 1ᵀ/rows = L D Lᵀ in place, column by column; returns the sum of D.
AIRYBENCH_NOT_SANITIZED double factorise(Work& work) {
  auto& column = work.column;
  for (int j = 0; j < rows; ++j) {
    for (double& entry : column[j]) entry = 1.0 / rows;
    column[j][j] += 1;
  }
  double sum = 0;
  for (int k = 0; k < rows; ++k) {
    const double pivot = column[k][k];
    sum += pivot;
    for (int j = k + 1; j < rows; ++j) {
      const double l = column[k][j] / pivot;
      for (int i = j; i < rows; ++i) column[j][i] -= l * column[k][i];
    }
  }
  return sum;
}

AIRYBENCH_NOT_SANITIZED double sweep(Work& work) {
  auto& values = work.values;
  for (int i = 0; i < noise_sweep_length; ++i) values[i] = i % 7;
  benchmark::ClobberMemory();  // the compiler must not fuse the two loops
  double sums[8] = {};
  for (int i = 0; i < noise_sweep_length; i += 8)
    for (int lane = 0; lane < 8; ++lane) sums[lane] += values[i + lane];
  double sum = 0;
  for (const double part : sums) sum += part;
  return sum;
}

constexpr std::size_t page = 4096;
alignas(page) Work own_work;
static_assert(sizeof(Work) % page == 0);

// Hints. A fork gets zeros: to copy the pages that it shares would take longer than the work.
void take_pages([[maybe_unused]] Work& work) {
#ifdef MADV_WIPEONFORK
  ::madvise(&work, sizeof work, MADV_WIPEONFORK);
#endif
#ifdef MADV_POPULATE_WRITE
  // Not by 2 MiB as map_at_once does: times would not compare with earlier runs.
  ::madvise(&work, sizeof work, MADV_POPULATE_WRITE);
#endif
}

double timed_pass(Work& work) {
  const auto start = std::chrono::steady_clock::now();
  double checksum = factorise(work) + sweep(work);
  benchmark::DoNotOptimize(checksum);
  return seconds_since(start);
}

}  // namespace

double noise_kernel_checksum() { return factorise(own_work) + sweep(own_work); }

double run_noise_kernel() {
  static double first_touch_s = [] {
    take_pages(own_work);
    return timed_pass(own_work);
  }();
  benchmark::DoNotOptimize(first_touch_s);
  return timed_pass(own_work);
}

double run_noise_kernel(int threads) {
  std::barrier all_ready(threads);
  std::vector<double> seconds(static_cast<std::size_t>(threads));
  std::vector<std::jthread> workers;
  try {
    for (double& own : seconds)
      workers.emplace_back([&all_ready, &own] {
        const std::unique_ptr<Work> work(new Work);
        timed_pass(*work);
        all_ready.arrive_and_wait();
        own = timed_pass(*work);
      });
  } catch (const std::system_error&) {  // the others would wait for those that did not start
    for (std::size_t k = workers.size(); k < seconds.size(); ++k) all_ready.arrive_and_drop();
    throw;
  }
  workers.clear();  // joins
  return *std::max_element(seconds.begin(), seconds.end());
}

}  // namespace airybench
