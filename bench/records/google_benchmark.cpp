#include "bench/records/google_benchmark.hpp"

#include <fmt/format.h>

#include <boost/math/statistics/univariate_statistics.hpp>
#include <cmath>
#include <stdexcept>

#include "bench/records/context.hpp"
#include "bench/records/record_numbers.hpp"
#include "bench/records/robust.hpp"
#include "support/numbers.hpp"

namespace airybench {
namespace {

using Run = benchmark::BenchmarkReporter::Run;

// The reporter escapes quotes and line ends, but not other control characters.
std::string printable(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') c = ' ';
  return text;
}

Run run_of(const Record& record, std::size_t family) {
  Run run;
  run.run_name.function_name = printable(name_of(record).text());
  run.run_name.iterations = "iterations:1";
  run.run_name.time_type = "manual_time";
  run.family_index = static_cast<std::int64_t>(family);
  run.per_family_instance_index = 0;
  run.threads = record.threads.value_or(1);
  run.time_unit = benchmark::kMillisecond;
  run.repetitions = std::ssize(record.samples_s);
  run.repetition_index = 0;
  return run;
}

// Google Benchmark 1.8 replaced error_occurred by skipped.
template <typename AnyRun>
void fail(AnyRun& run, const std::string& message) {
  if constexpr (requires { run.skip_message; }) {
    run.skipped = decltype(run.skipped)::SkippedWithError;
    run.skip_message = message;
  } else {
    run.error_occurred = true;
    run.error_message = message;
  }
}

// value: seconds, or a fraction for kPercentage.
Run aggregate(Run run, const char* name, double value, benchmark::StatisticUnit unit) {
  run.run_type = Run::RT_Aggregate;
  run.aggregate_name = name;
  run.aggregate_unit = unit;
  run.repetition_index = Run::no_repetition_index;
  run.iterations = run.repetitions;
  // The reporter divides only times by the iterations.
  run.real_accumulated_time =
      unit == benchmark::kTime ? value * static_cast<double>(run.iterations) : value;
  return run;
}

std::vector<Run> runs_of(const Record& record, std::size_t family) {
  const std::vector<double>& samples = record.samples_s;
  const Run bare = run_of(record, family);
  if (samples.empty()) {
    Run failed = bare;
    fail(failed, printable(fmt::format("{}: {}", name_of(record.status), record.status_reason)));
    return {failed};
  }
  Run counting = bare;
  for (const auto& [key, value] : numbers_of(record))
    if (!key.starts_with("time_") && key != "threads" && key != "repetitions")
      counting.counters[key] = value;
  std::vector<Run> runs(samples.size(), counting);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    runs[k].repetition_index = static_cast<std::int64_t>(k);
    runs[k].real_accumulated_time = samples[k];
  }
  if (samples.size() < 2) return runs;
  const double mean = boost::math::statistics::mean(samples);
  const double deviation = std::sqrt(boost::math::statistics::sample_variance(samples));
  using enum benchmark::StatisticUnit;
  runs.push_back(aggregate(counting, "mean", mean, kTime));
  runs.push_back(aggregate(counting, "median", median(samples), kTime));
  runs.push_back(aggregate(bare, "stddev", deviation, kTime));
  if (mean > 0) runs.push_back(aggregate(bare, "cv", deviation / mean, kPercentage));
  return runs;
}

Json context_of(const Context& known) {
  Json context = {
      {"date", context_word(known, "date")},
      {"host_name", ""},
      {"executable", "bench"},
      {"num_cpus", parse_whole(context_word(known, "cpus")).value_or(0)},
      {"mhz_per_cpu", 0},
      {"cpu_scaling_enabled", false},
      {"caches", Json::array()},
      {"load_avg", {parse_number(context_word(known, "load_1min_at_start")).value_or(0)}},
      {"library_build_type", "release"},
  };
  for (const auto& [key, value] : known) context[key] = value;
  return context;
}

// ReportContext() would describe the exporting machine.
std::string head_of(const Context& context) {
  return "{\n  \"context\": " + indented_json_text(context_of(context), 2) +
         ",\n  \"benchmarks\": [\n";
}

}  // namespace

std::string GoogleBenchmarkJson::add(const Record& record) {
  const std::string head = cases_ == 0 ? head_of(record.context) : "";
  reporter_.ReportRuns(runs_of(record, cases_++));
  const std::string runs = text_.str();
  text_.str("");
  if (!Json::accept("[" + runs.substr(runs.find('{')) + "]"))
    throw std::runtime_error("Google Benchmark's reporter wrote what is not JSON");
  return head + runs;
}

std::string GoogleBenchmarkJson::end() {
  const std::string head = cases_ == 0 ? head_of({}) : "";
  reporter_.Finalize();
  return head + text_.str();
}

std::string google_benchmark_json(const std::vector<Record>& cases) {
  GoogleBenchmarkJson json;
  std::string text;
  for (const Record& record : cases) text += json.add(record);
  return text + json.end();
}

}  // namespace airybench
