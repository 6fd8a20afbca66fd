#include "bench/running/benchmark_flags.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>

#include "support/errors.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

// It says names and complaints to the reporter's streams.
class Lister : public benchmark::BenchmarkReporter {
 public:
  Lister() {
    SetOutputStream(&names);
    SetErrorStream(&complaints);
  }
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>&) override {}

  std::stringstream names, complaints;
};

}  // namespace

void set_benchmark_flags(Benchmarks mode, bool interleave) {
  static std::vector<std::string> arguments;  // Google Benchmark keeps pointers to them
  arguments = {"bench",
               "--benchmark_filter=all",
               fmt::format("--benchmark_list_tests={}", mode == Benchmarks::list),
               "--benchmark_repetitions=1",
               "--benchmark_min_time=0",
               "--benchmark_min_warmup_time=0",
               "--benchmark_report_aggregates_only=false",
               "--benchmark_display_aggregates_only=false",
               "--benchmark_out=",
               "--benchmark_perf_counters=",
               "--benchmark_context=",
               fmt::format("--benchmark_enable_random_interleaving={}", interleave)};
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  int argc = static_cast<int>(argv.size());
  benchmark::Initialize(&argc, argv.data());
}

std::vector<Case> matching(const std::vector<Case>& plan, const std::string& filter) {
  if (plan.empty()) return {};
  set_benchmark_flags(Benchmarks::list, false);
  for (const Case& c : plan)
    benchmark::RegisterBenchmark(c.name().text().c_str(), [](benchmark::State&) {});
  Lister lister;
  benchmark::RunSpecifiedBenchmarks(&lister, filter);
  benchmark::ClearRegisteredBenchmarks();
  std::set<std::string> names;
  for (std::string name; std::getline(lister.names, name);) names.insert(name);
  if (names.empty()) {
    std::string complaint;
    std::getline(lister.complaints, complaint);
    throw UsageError(
        fmt::format("-- --benchmark_filter={}: {}", shortened(filter), shortened(complaint, 200)));
  }
  std::vector<Case> found;
  std::ranges::copy_if(plan, std::back_inserter(found),
                       [&](const Case& c) { return names.contains(c.name().text()); });
  return found;
}

}  // namespace airybench
