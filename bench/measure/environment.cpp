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
#include "bench/records/robust.hpp"
#include "bench/records/summary.hpp"
#include "solvers/base/blas_library.hpp"
#include "solvers/condensation/hybrid_kernels.hpp"
#include "support/errors.hpp"
#include "support/numbers.hpp"
#include "support/sha256.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

// Throws if memory or descriptors run out: "unknown" would look like another machine.
std::ifstream opened(const char* path) {
  std::ifstream file(path);
  if (!file && (errno == ENOMEM || errno == EMFILE || errno == ENFILE))
    throw FileError(
        fmt::format("{}: cannot be opened: {}", path, std::generic_category().message(errno)));
  file.exceptions(std::ios::badbit);
  return file;
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

std::string cpu_model(std::istream& cpuinfo) {
  std::string implementer;
  for (std::string line; std::getline(cpuinfo, line);) {
    const auto value = [&] { return line.substr(line.find(':') + 2); };
    if (line.starts_with("model name")) return value();
    if (line.starts_with("CPU implementer")) implementer = value();
    if (line.starts_with("CPU part"))
      return fmt::format("implementer {}, part {}", implementer, value());
  }
  return "unknown";
}

void set_threads(int threads) {
  set_blas_threads(threads);
  // CHOLMOD requests a fixed number of threads; only the nesting level limits that.
  omp_set_max_active_levels(threads == 1 ? 0 : 1);
  omp_set_num_threads(threads);
}

Context describe_environment(int threads) {
  std::ifstream cpuinfo = opened("/proc/cpuinfo");
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
      {"cpu", cpu_model(cpuinfo)},
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
  const RunSettings& run = options.run;
  const Limits& limits = options.limits;
  Context context = describe_environment(run.cases.threads);
  const auto set = [&](const char* key, const auto& value) {
    context[key] = fmt::format("{}", value);
  };
  const auto set_if_any = [&](const char* key, const auto& value) {
    if (value) set(key, *value);
  };
  set("target_error", run.cases.target_error);
  set("timeout_s", limits.timeout_s);
  set_if_any("others_s", limits.others_s);
  if (run.cases.fields) set("fields", "yes");
  set("long_case_s", limits.long_case_s);
  set("repetitions", limits.repetitions);
  set("interleaved", limits.interleave ? "yes" : "no");
  set("memory_limit_bytes", "none");
  set_if_any("memory_limit_bytes", limits.memory_limit_bytes);
  set_if_any("tuning_budget_s", limits.tuning_budget_s);
  const auto list = [](const auto& values) { return fmt::format("{}", fmt::join(values, ",")); };
  if (!run.budgets_s.empty()) set("budgets_s", list(run.budgets_s));
  if (run.study.points == Study::Points::threads) set("threads", list(run.thread_counts));
  set_if_any("precision", limits.precision);
  if (limits.precision) set("max_repetitions", limits.max_repetitions);
  set_if_any("retry_noisy", limits.retry_noisy);
  if (!run.adapt.goals.empty()) {
    set("adapt", text_of(run.adapt.goals));
    set_if_any("marking", run.adapt.marking);
    set("adapt_by", run.adapt.by);
  }
  if (run.shard.count > 1) set("shard", name_of(run.shard));
  for (const auto& [key, value] : options.output.context) {
    constexpr std::array words_of_the_plan = {"shard", "cases_planned", "plan_sha256"};
    if (context.contains(key) ||
        std::ranges::find(words_of_the_plan, key) != words_of_the_plan.end())
      throw UsageError(fmt::format(
          "-- --benchmark_context: {} (allowed: another word; this one is the run's own)",
          shortened(key)));
    context[key] = value;
  }
  return context;
}

std::vector<std::string> machine_warnings(const Context& environment, int repetitions,
                                          const std::vector<double>& noise_kernel_s) {
  constexpr double max_load_per_cpu = 0.2, max_noise = 0.05;
  const auto known = [&](const char* key) {
    const std::string word = context_word(environment, key);
    return word == "unknown" ? "" : word;
  };
  const std::string governor = known("cpu_governor"), build_type = known("build_type");
  const double load = parse_number(known("load_1min_at_start")).value_or(-1);
  const auto cpus = parse_whole(known("cpus")).value_or(0);
  const auto threads = parse_whole(known("threads")).value_or(1);
  const double noise = median_absolute_deviation(noise_kernel_s) / median(noise_kernel_s);
  std::vector<std::string> lines;
  if (!governor.empty() && governor != "performance")
    lines.push_back(fmt::format(
        "the CPU's frequency follows the load (governor {}; steady: performance)", governor));
  if (const double most = max_load_per_cpu * static_cast<double>(cpus); cpus > 0 && load > most)
    lines.push_back(
        fmt::format("other work on the machine: load {:.2f} on {} CPUs (quiet: at most {:.1f})",
                    load, cpus, most));
  if (cpus > 0 && threads > cpus)
    lines.push_back(fmt::format(
        "--threads={}: more than the {} CPUs, so threads wait for one another", threads, cpus));
  if (noise > max_noise)
    lines.push_back(fmt::format(
        "machine noise {:.1f} %: scatter of a fixed loop's times (quiet: at most {:.0f} %)",
        100 * noise, 100 * max_noise));
  if (repetitions < fewest_to_tell_apart)
    lines.push_back(fmt::format(
        "--repetitions={}: too few for a sound interval, and for two methods to differ at "
        "p < 0.01 (both from {} on)",
        repetitions, fewest_to_tell_apart));
  if (known("heap_probe") != "on")
    lines.push_back("the heap is not counted: this build has no heap probe");
  if (!build_type.empty() && build_type != "Release")
    lines.push_back(fmt::format("build type {}: times are those of Release only", build_type));
  if (known("git_dirty") == "yes") lines.push_back("the sources have uncommitted changes");
  return lines;
}

}  // namespace airybench
