#include "bench/run/benchmark_flags.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <set>
#include <sstream>

#include "support/errors.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

// Since Google Benchmark 1.8, whose State has skipped(), a time needs its unit; before, it had
// none.
template <typename State>
constexpr bool takes_unit = requires(State& state) {
  state.skipped();
};

// Which benchmarks ran; why none did it says to the reporter's stream.
class Names : public benchmark::BenchmarkReporter {
 public:
  Names() { SetErrorStream(&complaints); }
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) names.insert(run.run_name.function_name);
  }

  std::set<std::string> names;
  std::stringstream complaints;
};

}  // namespace

void initialize_benchmark(bool interleave) {
  static std::vector<std::string> arguments;  // Google Benchmark keeps pointers to them
  std::vector<std::string> wanted = {
      "bench",
      "--benchmark_filter=all",
      "--benchmark_list_tests=false",
      "--benchmark_repetitions=1",
      fmt::format("--benchmark_min_time={}", takes_unit<benchmark::State> ? "0s" : "0"),
      "--benchmark_min_warmup_time=0",
      "--benchmark_report_aggregates_only=false",
      "--benchmark_display_aggregates_only=false",
      "--benchmark_format=console",
      "--benchmark_out=",
      "--benchmark_out_format=json",
      "--benchmark_color=false",
      "--benchmark_counters_tabular=false",
      "--benchmark_perf_counters=",
      "--benchmark_context=",
      "--benchmark_time_unit=ms",
      "--v=0",
      fmt::format("--benchmark_enable_random_interleaving={}", interleave)};
  if (arguments == wanted) return;  // it complains of a context that it has already
  arguments = std::move(wanted);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  int argc = static_cast<int>(argv.size());
  benchmark::Initialize(&argc, argv.data());
}

std::vector<Case> matching(std::vector<Case> plan, const std::string& filter, bool interleave) {
  initialize_benchmark(interleave);
  for (const Case& c : plan)  // any setting would be part of the name; min_time=0 is one iteration
    benchmark::RegisterBenchmark(c.name().text().c_str(), [](benchmark::State& state) {
      for (auto _ : state) continue;
    });
  Names selected;
  benchmark::RunSpecifiedBenchmarks(&selected, filter);
  benchmark::ClearRegisteredBenchmarks();
  std::string complaint;
  std::getline(selected.complaints, complaint);
  if (!complaint.empty() && !complaint.starts_with("Failed to match"))
    throw UsageError(
        fmt::format("-- --benchmark_filter={}: {}", shortened(filter), shortened(complaint, 200)));
  std::erase_if(plan, [&](const Case& c) { return !selected.names.contains(c.name().text()); });
  return plan;
}

}  // namespace airybench
