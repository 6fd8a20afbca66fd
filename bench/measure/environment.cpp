#include "bench/measure/environment.hpp"

#include <benchmark/benchmark.h>
#include <cholmod.h>
#include <dmumps_c.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <omp.h>
#include <unistd.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <system_error>
#include <thread>

#include "bench/measure/build_info.hpp"
#include "bench/measure/heap_probe.hpp"
#include "solvers/base/blas_library.hpp"
#include "solvers/condensation/hybrid_kernels.hpp"
#include "support/errors.hpp"
#include "support/sha256.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

// Without an answer for lack of memory or descriptors a run would seem to be another machine's.
std::ifstream opened(const char* path) {
  std::ifstream file(path);
  if (!file && (errno == ENOMEM || errno == EMFILE || errno == ENFILE))
    throw FileError(
        fmt::format("{}: cannot be opened: {}", path, std::generic_category().message(errno)));
  file.exceptions(std::ios::badbit);
  return file;
}

std::string cpu_model() {
  std::ifstream file = opened("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::string first_line(const char* path) {
  std::ifstream file = opened(path);
  std::string line;
  std::getline(file, line);
  return line.empty() ? "unknown" : line;
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

}  // namespace

void set_threads(int threads) {
  set_blas_threads(threads);
  // CHOLMOD asks for a fixed number of threads in its regions; only the nesting level stops that.
  omp_set_max_active_levels(threads == 1 ? 0 : 1);
  omp_set_num_threads(threads);
}

Context describe_environment(int threads) {
  double load[1] = {0};
  if (getloadavg(load, 1) != 1) load[0] = -1;
  return {
      {"airybench_version", build_info.version},
      {"git_revision", build_info.git_revision},
      {"git_dirty", build_info.git_dirty},
      {"build_type", build_info.build_type},
      {"compiler", build_info.compiler},
      {"compiler_flags", build_info.compiler_flags},
      {"eigen",
       fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"cholmod",
       fmt::format("{}.{}.{}", CHOLMOD_MAIN_VERSION, CHOLMOD_SUB_VERSION, CHOLMOD_SUBSUB_VERSION)},
      {"mumps", MUMPS_VERSION},
      {"blas", blas_name()},
      {"blas_core", blas_core()},
      {"hybrid_kernels", hybrid_kernels<double>().name},
      {"blas_threads", std::to_string(blas_threads())},
      {"google_benchmark", build_info.benchmark_version},
      {"cpu", cpu_model()},
      {"cpus", std::to_string(std::thread::hardware_concurrency())},
      {"cpu_governor", first_line("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor")},
      {"kernel", first_line("/proc/sys/kernel/osrelease")},
      {"load_1min_at_start", fmt::format("{:.2f}", load[0])},
      {"threads", std::to_string(threads)},
      {"program_sha256", sha256_of_file("/proc/self/exe")},
      {"host", host_name()},
      {"heap_probe", heap::is_active() ? "on" : "off"},
      {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))},
  };
}

Context context_of_run(const Options& options) {
  Context context = describe_environment(options.threads);
  const Context settings = {
      {"target_error", fmt::format("{}", options.target_error)},
      {"timeout_s", fmt::format("{}", options.timeout_s)},
      {"long_case_s", fmt::format("{}", options.long_case_s)},
      {"repetitions", std::to_string(options.repetitions)},
      {"interleaved", options.interleave ? "yes" : "no"},
      {"memory_limit_bytes",
       options.memory_limit_bytes ? std::to_string(*options.memory_limit_bytes) : "none"},
  };
  context.insert(settings.begin(), settings.end());
  if (options.tuning_budget_s)
    context["tuning_budget_s"] = fmt::format("{}", *options.tuning_budget_s);
  if (!options.budgets_s.empty())
    context["budgets_s"] = fmt::format("{}", fmt::join(options.budgets_s, ","));
  if (options.study.points == Study::Points::threads)
    context["threads"] = fmt::format("{}", fmt::join(options.thread_counts, ","));
  if (options.precision) {
    context["precision"] = fmt::format("{}", *options.precision);
    context["max_repetitions"] = std::to_string(options.max_repetitions);
  }
  if (options.retry_noisy) context["retry_noisy"] = fmt::format("{}", *options.retry_noisy);
  if (!options.adapt.empty()) {
    context["adapt"] = text_of(options.adapt);
    if (options.marking) context["marking"] = fmt::format("{}", *options.marking);
    context["adapt_by"] = options.adapt_by;
  }
  if (options.shard.count > 1) context["shard"] = name_of(options.shard);
  for (const auto& [key, value] : options.own_context) {
    constexpr std::array words_of_the_plan = {"shard", "cases_planned", "plan_sha256"};
    if (context.contains(key) || std::find(words_of_the_plan.begin(), words_of_the_plan.end(),
                                           key) != words_of_the_plan.end())
      throw UsageError(fmt::format(
          "-- --benchmark_context: {} (allowed: another word; this one is the run's own)",
          shortened(key)));
    context[key] = value;
  }
  return context;
}

}  // namespace airybench
