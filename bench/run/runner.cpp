#include "bench/run/runner.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <chrono>
#include <iostream>
#include <map>
#include <set>

#include "bench/plan/blank_record.hpp"
#include "bench/records/record_files.hpp"
#include "bench/records/summary.hpp"
#include "bench/run/benchmark_flags.hpp"
#include "bench/run/isolated_scene.hpp"
#include "bench/run/progress.hpp"
#include "bench/run/repetitions.hpp"
#include "support/seconds_since.hpp"

namespace airybench {
namespace {

constexpr int passes_beside = 3;  // before a case, and after it
constexpr int most_attempts = 4;

// The cases of one scene. Google Benchmark calls measure() once per repetition and the reporter
// when a case has all of its own.
class SceneRunner {
 public:
  SceneRunner(const std::vector<const Case*>& cases, const Options& options, RecordFiles& files,
              Progress& progress, NoiseWatch& watch)
      : cases_(cases), options_(options), files_(files), progress_(progress), watch_(watch) {
    records_.resize(cases.size());
  }

  void measure(std::size_t k, benchmark::State& state) {
    throw_if_interrupted();
    const auto start = std::chrono::steady_clock::now();
    if (!records_[k]) examine(k);
    Record& record = *records_[k];
    for (auto _ : state) {
      if (!is_measured(record)) {
        state.SkipWithError(
            fmt::format("{}: {}", name_of(record.status), record.status_reason).c_str());
        break;
      }
      state.SetIterationTime(next_sample(k, record, state));
    }
    wall_s_[k] += seconds_since(start);
  }

  void finish(const std::string& case_name) {
    const std::size_t k = index_of(case_name);
    if (!options_.retry_noisy) scene_.end(k);
    time_loop(passes_beside, k);
    finished_.insert(k);
    if (options_.interleave) return;
    measure_noisy_again();
    write(k);
  }

  // Interleaved cases end in random order, but all at about the same time: their records are kept
  // in the plan's.
  void finish_interleaved() {
    if (!options_.interleave) return;
    measure_noisy_again();
    for (const std::size_t k : finished_) write(k);
  }

  std::vector<Record> records() const {
    std::vector<Record> result;
    for (const std::size_t k : finished_) result.push_back(*records_[k]);
    return result;
  }
  double preparation_s() const { return scene_.preparation_s(); }

 private:
  void write(std::size_t k) {
    Record& record = *records_[k];
    if (options_.retry_noisy) scene_.end(k);
    watch_.keep_quietest(std::move(attempts_[k]), record, std::cerr);
    record.wall_s = wall_s_[k];
    summarise(record);
    files_.append(record);
    std::cerr << progress_.line(record) << std::flush;
    written_.insert(k);
  }
  void examine(std::size_t k) {
    Record before;
    watch_.add_passes(passes_beside, threads_of(k), before);
    records_[k] = scene_.examine(k);
    records_[k]->noise_kernel_samples_s = std::move(before.noise_kernel_samples_s);
    records_[k]->busy_kernel_samples_s = std::move(before.busy_kernel_samples_s);
  }
  // The time of one repetition. A long case has its only one from its detail run.
  double next_sample(std::size_t k, Record& record, benchmark::State& state) {
    if (is_repeated(record, options_)) return add_sample(k);
    const bool first = record.measured_once && shown_once_.insert(k).second;
    if (!first) state.SkipWithError("not repeated: a long case, or precise enough");
    return record.samples_s.back();
  }
  double add_sample(std::size_t k) {
    if (watch_.is_due()) time_loop(1, k);
    const TimedRun run = scene_.measure_time(k);
    add_run(run, *records_[k]);
    return run.time_s;
  }
  void time_loop(int passes, std::size_t k) {
    watch_.add_passes(passes, threads_of(k), *records_[k]);
  }
  int threads_of(std::size_t k) const { return cases_[k]->knob.threads.value_or(options_.threads); }

  // Those that are finished and were noisy, in turn. A long case has one sample more, of a timed
  // run.
  void measure_noisy_again() {
    for (std::size_t made = 1; made < most_attempts; ++made) {
      std::vector<std::size_t> noisy;
      for (const std::size_t k : finished_)
        if (!written_.contains(k) && watch_.is_noisy(*records_[k])) noisy.push_back(k);
      if (noisy.empty()) return;
      for (const std::size_t k : noisy) {
        std::cerr << watch_.line(*records_[k], made, most_attempts) << std::flush;
        attempts_[k].push_back(taken_from(*records_[k]));
      }
      watch_.wait_for_quiet();
      measure_again(noisy);
    }
  }
  void measure_again(const std::vector<std::size_t>& cases) {
    for (const std::size_t k : cases) time_loop(passes_beside, k);
    for (bool any = true; any;) {
      any = false;
      for (const std::size_t k : cases) {
        if (!is_measured(*records_[k]) || !is_repeated(*records_[k], options_)) continue;
        any = true;
        const auto start = std::chrono::steady_clock::now();
        add_sample(k);
        wall_s_[k] += seconds_since(start);
      }
    }
    for (const std::size_t k : cases) time_loop(passes_beside, k);
  }
  std::size_t index_of(const std::string& case_name) const {
    for (std::size_t k = 0; k < cases_.size(); ++k)
      if (cases_[k]->name().text() == case_name) return k;
    throw std::logic_error("no case is named " + case_name);
  }

  const std::vector<const Case*>& cases_;
  const Options& options_;
  RecordFiles& files_;
  Progress& progress_;
  NoiseWatch& watch_;
  IsolatedScene scene_{cases_, options_};
  std::vector<std::optional<Record>> records_;
  std::map<std::size_t, std::vector<Attempt>> attempts_;  // that were noisy
  std::map<std::size_t, double> wall_s_;
  std::set<std::size_t> finished_, written_;
  std::set<std::size_t> shown_once_;  // long cases whose sample Google Benchmark has
};

class Reporter : public benchmark::BenchmarkReporter {
 public:
  explicit Reporter(SceneRunner& run) : run_(run) {}
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    if (!runs.empty() && runs.front().run_type == Run::RT_Iteration)
      run_.finish(runs.front().run_name.function_name);
  }

 private:
  SceneRunner& run_;
};

void run_scene(const std::vector<const Case*>& cases, const Options& options, SceneRunner& run) {
  for (std::size_t k = 0; k < cases.size(); ++k)
    benchmark::RegisterBenchmark(cases[k]->name().text().c_str(),
                                 [&run, k](benchmark::State& state) { run.measure(k, state); })
        ->UseManualTime()
        ->Iterations(1)
        ->Repetitions(most_repetitions(options))
        ->Unit(benchmark::kMillisecond);
  Reporter reporter(run);
  try {
    benchmark::RunSpecifiedBenchmarks(&reporter);
  } catch (...) {
    benchmark::ClearRegisteredBenchmarks();
    throw;
  }
  benchmark::ClearRegisteredBenchmarks();
}

}  // namespace

RunResult run_cases(const std::vector<Case>& plan, const Options& options, const Context& context,
                    const Machine& machine) {
  const auto start = std::chrono::steady_clock::now();
  initialize_benchmark(options.interleave);
  const Keep keep = options.resume ? Keep::finished : options.append ? Keep::others : Keep::none;
  RecordFiles files(options.out, context, keep);
  NoiseWatch watch(options.retry_noisy, machine);
  RunResult result;
  result.torn = files.was_torn();
  std::map<std::int64_t, Record> records;  // by the case's number
  std::vector<std::vector<const Case*>> scenes;
  std::vector<std::int64_t> n_phi;
  for (const Case& c : plan) {
    const Record blank = blank_record(c, options);
    if (auto earlier = files.finished(blank)) {
      watch.learn(*earlier);
      records[c.number] = std::move(*earlier);
      ++result.earlier;
      continue;
    }
    if (scenes.empty() || scenes.back().front()->posed.problem != c.posed.problem)
      scenes.emplace_back();
    scenes.back().push_back(&c);
    n_phi.push_back(blank.n_phi.value_or(0));
  }
  Progress progress(std::move(n_phi));
  for (const auto& cases : scenes) {
    SceneRunner run(cases, options, files, progress, watch);
    try {
      run_scene(cases, options, run);
      run.finish_interleaved();
    } catch (const Interrupted&) {
      files.finish();
      throw;
    }
    for (Record& record : run.records()) {
      result.times.runs_s += record.runs_s.value_or(0);
      result.times.judging_s += record.wall_s.value_or(0) - record.runs_s.value_or(0);
      records[record.case_number.value_or(0)] = std::move(record);
    }
    result.times.preparation_s += run.preparation_s();
  }
  files.finish();
  for (auto& [number, record] : records) result.records.push_back(std::move(record));
  result.times.judging_s -= result.times.preparation_s;  // it is part of the first case's wall time
  result.times.wall_s = seconds_since(start);
  return result;
}

}  // namespace airybench
