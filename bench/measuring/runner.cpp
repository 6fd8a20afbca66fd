#include "bench/measuring/runner.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <iostream>
#include <numeric>
#include <set>

#include "bench/measuring/workbench.hpp"
#include "bench/records/record_files.hpp"
#include "bench/terminal.hpp"

namespace airybench {
namespace {

// What a repetition shows beside its time in Google Benchmark's JSON: this repetition's stages, and
// the columns that hold for all. Not the columns that Google Benchmark has itself.
void add_counters(const Record& record, benchmark::State& state) {
  for (const auto& [name, value] : columns(record))
    if (value.is_number() && !name.starts_with("time_") && !name.starts_with("stage_") &&
        name != "threads" && name != "repetitions")
      state.counters[name] = value.get<double>();
  if (record.stage_samples.empty()) return;
  for (const Stage stage : all_stages)
    if (const auto& seconds = record.stage_samples.back()[stage])
      state.counters[column_of(stage)] = *seconds;
}

// The state of a run. Google Benchmark calls measure() once per repetition and the reporter when a
// case has all of its own.
class CaseRunner {
 public:
  CaseRunner(const std::vector<Case>& cases, const Options& options, RecordFiles& files)
      : cases_(cases), options_(options), files_(files), progress_(sizes(cases)) {
    records_.resize(cases.size());
    choices_.resize(cases.size());
  }

  void measure(std::size_t k, benchmark::State& state) {
    if (!records_[k]) begin(k);
    Record& record = *records_[k];
    for (auto _ : state) {
      if (!is_measured(record)) {
        state.SkipWithError(
            fmt::format("{}: {}", name_of(record.status), record.status_reason).c_str());
        break;
      }
      state.SetIterationTime(next_sample(k, record, state));
    }
    add_counters(record, state);
  }

  void finish(const std::string& case_name) {
    const std::size_t k = index_of(case_name);
    files_.append(*records_[k]);
    finished_.push_back(k);
    std::cerr << progress_.line(k, *records_[k]) << std::flush;
  }

  std::vector<Record> finished_records() const {
    std::vector<Record> result;
    for (const std::size_t k : finished_) result.push_back(*records_[k]);
    return result;
  }

 private:
  // The time of one repetition. A long case has its only one from its detail run.
  double next_sample(std::size_t k, Record& record, benchmark::State& state) {
    if (record.samples_s.empty() ||
        (!record.measured_once && sum(record.samples_s) < options_.long_case_s))
      return bench_of(k).measure_time(cases_[k].method, *choices_[k], record);
    const bool first = record.measured_once && shown_once_.insert(k).second;
    if (!first) state.SkipWithError("not repeated: a long case");
    return record.samples_s.back();
  }
  static double sum(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
  }
  static std::vector<int> sizes(const std::vector<Case>& cases) {
    std::vector<int> n_phi;
    for (const Case& c : cases) n_phi.push_back(mesh_sizes(c.posed.problem->mesh).n_phi);
    return n_phi;
  }
  std::size_t index_of(const std::string& case_name) const {
    for (std::size_t k = 0; k < cases_.size(); ++k)
      if (cases_[k].name() == case_name) return k;
    throw std::logic_error("no case is named " + case_name);
  }

  // Blocks and reference of a posed scene, made at its first case and kept: Google Benchmark may
  // interleave the repetitions of all cases.
  Workbench& bench_of(std::size_t k) {
    const auto& problem = cases_[k].posed.problem;
    auto& bench = benches_[problem.get()];
    if (!bench) bench = std::make_unique<Workbench>(problem, options_);
    return *bench;
  }

  // Detail and memory run.
  void begin(std::size_t k) {
    const Case& c = cases_[k];
    std::filesystem::path fields;
    if (options_.fields) {
      std::string name = c.name();
      for (char& letter : name)
        if (letter == '/' || letter == ':') letter = '-';
      fields = options_.out / "fields" / name;
    }
    auto [record, choice] = bench_of(k).examine(c.method, fields);
    record.scene = c.posed.scene_name;
    record.scene_group = c.posed.scene_group;
    record.mesh_sha256 = c.posed.mesh_sha256;
    record.knob = c.knob.name;
    record.knob_value = c.knob.value;
    record.stop = c.knob.stop.value_or(options_.stop);
    if (is_measured(record) && !record.measured_once)
      bench_of(k).measure_memory(c.method, choice, record);
    records_[k] = std::move(record);
    choices_[k] = std::move(choice);
  }

  const std::vector<Case>& cases_;
  const Options& options_;
  RecordFiles& files_;
  Progress progress_;
  std::map<const Problem*, std::unique_ptr<Workbench>> benches_;
  std::vector<std::optional<Record>> records_;
  std::vector<std::optional<Workbench::Choice>> choices_;
  std::vector<std::size_t> finished_;
  std::set<std::size_t> shown_once_;  // long cases whose sample Google Benchmark has
};

class Reporter : public benchmark::BenchmarkReporter {
 public:
  explicit Reporter(CaseRunner& run) : run_(run) {}
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    if (!runs.empty() && runs.front().run_type == Run::RT_Iteration)
      run_.finish(runs.front().run_name.function_name);
  }

 private:
  CaseRunner& run_;
};

// Before any file is touched. Throws UsageError.
void initialize_benchmark(const Options& options,
                          const std::map<std::string, std::string>& context) {
  static std::vector<std::string> arguments;  // Google Benchmark keeps pointers to them
  arguments = {"bench", "--benchmark_out=" + RecordFiles::benchmark_json_part(options.out).string(),
               "--benchmark_out_format=json"};
  for (const std::string& argument : options.benchmark_arguments) {
    const bool allowed = argument.starts_with("--benchmark_filter=") ||
                         argument.starts_with("--benchmark_enable_random_interleaving") ||
                         argument.starts_with("--benchmark_context=");
    if (!allowed)
      throw UsageError(
          fmt::format("-- {}: not for bench's runs (allowed: --benchmark_filter=, "
                      "--benchmark_enable_random_interleaving=, --benchmark_context=)",
                      argument));
    arguments.push_back(argument);
  }
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  int argc = static_cast<int>(argv.size());
  benchmark::Initialize(&argc, argv.data());
  if (argc > 1)
    throw UsageError(
        fmt::format("{}: unknown to Google Benchmark (see its --benchmark_* options)", argv[1]));
  for (const auto& [key, value] : context) benchmark::AddCustomContext(key, value);
}

}  // namespace

std::vector<Case> plan_cases(const std::vector<PosedScene>& scenes,
                             const std::vector<Method>& methods, Study study) {
  std::vector<Case> cases;
  for (const PosedScene& scene : scenes)
    for (const Method& method : methods)
      if (study == Study::error)
        for (TurnedMethod& point : error_points(method))
          cases.push_back({scene, std::move(point.method), std::move(point.knob)});
      else
        cases.push_back({scene, method});
  return cases;
}

std::vector<Record> run_cases(const std::vector<Case>& cases, const Options& options,
                              const std::map<std::string, std::string>& context) {
  initialize_benchmark(options, context);
  RecordFiles files(options.out, context, options.append);
  CaseRunner run(cases, options, files);
  for (std::size_t k = 0; k < cases.size(); ++k)
    benchmark::RegisterBenchmark(cases[k].name().c_str(),
                                 [&run, k](benchmark::State& state) { run.measure(k, state); })
        ->UseManualTime()
        ->Iterations(1)
        ->Repetitions(options.repetitions)
        ->Unit(benchmark::kMillisecond);
  Reporter reporter(run);
  try {
    benchmark::RunSpecifiedBenchmarks(&reporter);
  } catch (...) {
    files.abandon();
    throw;
  }
  benchmark::ClearRegisteredBenchmarks();
  std::vector<Record> records = run.finished_records();
  if (records.empty()) {
    files.abandon();
    throw UsageError("no case ran: the arguments after -- select none");
  }
  files.finish();
  return records;
}

}  // namespace airybench
