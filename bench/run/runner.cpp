#include "bench/run/runner.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <regex.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <functional>
#include <iostream>
#include <iterator>
#include <map>
#include <numeric>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "bench/records/record_files.hpp"
#include "bench/records/robust.hpp"
#include "bench/records/summary.hpp"
#include "bench/run/isolated_scene.hpp"
#include "bench/run/progress.hpp"
#include "support/errors.hpp"
#include "support/seconds_since.hpp"
#include "support/shortened.hpp"
#include "support/sign_of_life.hpp"
#include "support/temporary_folder.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

constexpr int passes_beside = 3;  // before a case, and after it
constexpr int max_attempts = 4;

void initialize_benchmark(bool interleave) {
  static std::string program = "bench";  // the library keeps a pointer to it
  std::string quiet = "--v=0",
              order = fmt::format("--benchmark_enable_random_interleaving={}", interleave);
  std::array<char*, 4> argv = {program.data(), quiet.data(), order.data(), nullptr};
  int argc = 3;
  benchmark::Initialize(&argc, argv.data());
}

class Listener : public benchmark::BenchmarkReporter {
 public:
  using Ended = std::function<void(const std::string& name)>;
  explicit Listener(Ended ended) : ended_(std::move(ended)) { SetErrorStream(&unread_); }
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    if (!runs.empty() && runs.front().run_type == Run::RT_Iteration)
      ended_(runs.front().run_name.function_name);
  }

 private:
  Ended ended_;
  std::ostringstream unread_;
};

// Cases are registered by scene, and forgotten after it: what is registered together is
// interleaved, and a scene's process holds its blocks while its cases run.
void run_benchmarks(Listener::Ended ended) {
  struct RegistrationGuard {
    ~RegistrationGuard() { benchmark::ClearRegisteredBenchmarks(); }
  } guard;
  Listener listener(std::move(ended));
  benchmark::RunSpecifiedBenchmarks(&listener, "all");
}

class SceneRunner {
 public:
  SceneRunner(const std::vector<const Case*>& cases, const Limits& limits,
              const std::filesystem::path& out, RecordFiles& files, Progress& progress,
              NoiseWatch& watch, RunTimes& times)
      : planned_(cases),
        limits_(limits),
        files_(files),
        progress_(progress),
        watch_(watch),
        times_(times),
        scene_(planned_, limits, out) {
    cases_.resize(cases.size());
  }

  // Interleaved cases end in random order, at about the same time; records keep the plan's order.
  void run() {
    for (std::size_t k = 0; k < cases_.size(); ++k)
      benchmark::RegisterBenchmark(planned_[k]->name().text().c_str(),
                                   [this, k](benchmark::State& state) { measure(k, state); })
          ->UseManualTime()
          ->Iterations(1)
          ->Repetitions(max_repetitions(limits_));
    run_benchmarks([this](const std::string& name) { finish(index_of(name)); });
    if (limits_.interleave) write_finished();
  }

  double preparation_s() const { return scene_.preparation_s(); }

 private:
  struct Measured {
    std::optional<Record> record;
    std::vector<Record> noisy;  // the samples of earlier attempts
    double wall_s = 0;
    bool finished = false, written = false;
  };

  void measure(std::size_t k, benchmark::State& state) {
    throw_if_interrupted();
    const auto start = std::chrono::steady_clock::now();
    if (!cases_[k].record) examine(k);
    const Record& record = *cases_[k].record;
    // The library knows the most repetitions only: the rest of them do nothing.
    for (auto _ : state)
      if (is_measured(record) && is_repeated(record, limits_))
        state.SetIterationTime(add_sample(k));
    cases_[k].wall_s += seconds_since(start);
  }

  void examine(std::size_t k) {
    Record before;
    watch_.add_passes(passes_beside, threads_of(k), before);
    Record& record = cases_[k].record.emplace(scene_.examine(k));
    record.noise_kernel_samples_s = std::move(before.noise_kernel_samples_s);
    record.busy_kernel_samples_s = std::move(before.busy_kernel_samples_s);
  }

  double add_sample(std::size_t k) {
    if (watch_.is_due()) time_loop(1, k);
    const TimedRun run = scene_.measure_time(k);
    add_run(run, *cases_[k].record);
    return run.time_s;
  }
  void time_loop(int passes, std::size_t k) {
    watch_.add_passes(passes, threads_of(k), *cases_[k].record);
  }
  int threads_of(std::size_t k) const { return planned_[k]->settings.threads; }

  void finish(std::size_t k) {
    if (!limits_.retry_noisy) scene_.end(k);
    time_loop(passes_beside, k);
    cases_[k].finished = true;
    if (!limits_.interleave) write_finished();
  }

  void write_finished() {
    measure_noisy_again();
    for (std::size_t k = 0; k < cases_.size(); ++k) {
      Measured& c = cases_[k];
      if (!c.finished || std::exchange(c.written, true)) continue;
      if (limits_.retry_noisy) scene_.end(k);
      watch_.keep_quietest(std::move(c.noisy), *c.record, std::cerr);
      c.record->wall_s = c.wall_s;
      *c.record = append(*planned_[k], std::move(*c.record));
      std::cerr << progress_.line(*c.record) << std::flush;
      was_heard();
      times_.runs_s += c.record->runs_s.value_or(0);
      times_.judging_s += c.wall_s - c.record->runs_s.value_or(0);
      c.record.reset();  // it is on disk
    }
  }
  Record append(const Case& planned, Record record) {
    try {
      summarise(record);
      return files_.append(std::move(record));
    } catch (const RecordError& wrong) {
      return files_.append(record_of_defect(planned, limits_, wrong));
    }
  }

  // A long case gets one further sample, from a timed run.
  void measure_noisy_again() {
    for (std::size_t made = 1; made < max_attempts; ++made) {
      std::vector<std::size_t> noisy;
      for (std::size_t k = 0; k < cases_.size(); ++k)
        if (cases_[k].finished && !cases_[k].written && watch_.is_noisy(*cases_[k].record))
          noisy.push_back(k);
      if (noisy.empty()) return;
      for (const std::size_t k : noisy) {
        Record& record = *cases_[k].record;
        std::cerr << watch_.line(record, made, max_attempts) << std::flush;
        swap_samples(record, cases_[k].noisy.emplace_back());
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
        const Record& record = *cases_[k].record;
        if (!is_measured(record) || !is_repeated(record, limits_)) continue;
        any = true;
        const auto start = std::chrono::steady_clock::now();
        add_sample(k);
        cases_[k].wall_s += seconds_since(start);
      }
    }
    for (const std::size_t k : cases) time_loop(passes_beside, k);
  }

  std::size_t index_of(const std::string& name) const {
    const auto found = std::ranges::find(planned_, name, [](auto c) { return c->name().text(); });
    return static_cast<std::size_t>(found - planned_.begin());
  }

  const std::vector<const Case*>& planned_;
  const Limits& limits_;
  RecordFiles& files_;
  Progress& progress_;
  NoiseWatch& watch_;
  RunTimes& times_;
  IsolatedScene scene_;
  std::vector<Measured> cases_;
};

}  // namespace

void restart_without_benchmark_variables(char* const* argv) {
  std::vector<char*> kept;
  std::size_t all = 0;
  for (; environ[all] != nullptr; ++all)
    if (!std::string_view(environ[all]).starts_with("BENCHMARK_")) kept.push_back(environ[all]);
  if (kept.size() == all) return;
  kept.push_back(nullptr);
  execve("/proc/self/exe", argv, kept.data());
  throw std::system_error(errno, std::generic_category(), "/proc/self/exe");
}

int min_repetitions(const Limits& limits) {
  return limits.precision ? std::max(limits.repetitions, fewest_for_median_interval)
                          : limits.repetitions;
}

int max_repetitions(const Limits& limits) {
  return limits.precision ? limits.max_repetitions : limits.repetitions;
}

RunLimits limits_of(const Limits& limits, const std::vector<Case>& plan) {
  return {min_repetitions(limits), limits.timeout_s, limits.long_case_s, limits.memory_limit_bytes,
          std::ranges::any_of(plan, [](const Case& c) { return c.settings.timed_once; })};
}

bool is_repeated(const Record& record, const Limits& limits) {
  const std::vector<double>& samples = record.samples_s;
  if (samples.empty()) return true;
  const double so_far_s = std::accumulate(samples.begin(), samples.end(), 0.0);
  if (record.measured_once || so_far_s >= limits.long_case_s ||
      std::ssize(samples) >= max_repetitions(limits))
    return false;
  if (std::ssize(samples) < min_repetitions(limits)) return true;
  return *median_uncertainty(samples) > *limits.precision;
}

std::vector<Case> matching(std::vector<Case> plan, const std::string& filter) {
  if (filter == "all") return plan;
  const bool is_inverted = filter.starts_with('-');
  regex_t expression;
  const char* const text = filter.c_str() + (is_inverted ? 1 : 0);
  if (const int error = regcomp(&expression, text, REG_EXTENDED | REG_NOSUB); error != 0) {
    std::array<char, 200> why{};
    regerror(error, &expression, why.data(), why.size());
    throw UsageError(
        fmt::format("-- --benchmark_filter={}: {} (allowed: extended regular expressions)",
                    shortened(filter), why.data()));
  }
  std::erase_if(plan, [&](const Case& c) {
    const bool is_met = regexec(&expression, c.name().text().c_str(), 0, nullptr, 0) == 0;
    return is_met == is_inverted;
  });
  regfree(&expression);
  return plan;
}

RunResult run_cases(const std::vector<Case>& plan, const Limits& limits, const Output& output,
                    const Context& context, const Machine& machine) {
  const auto start = std::chrono::steady_clock::now();
  initialize_benchmark(limits.interleave);
  const Keep keep = output.resume ? Keep::finished : output.append ? Keep::others : Keep::none;
  auto files = std::make_unique<RecordFiles>(output.folder, context, keep);
  remove_abandoned_folders();
  NoiseWatch watch(limits.retry_noisy, machine);
  RunResult result;
  std::vector<std::vector<const Case*>> scenes;
  std::vector<Record> planned;
  for (const Case& c : plan) {
    Record blank = blank_record(c, limits);
    if (const auto earlier = files->finished(blank)) {
      watch.learn(*earlier);
      ++result.earlier;
      continue;
    }
    if (scenes.empty() || scenes.back().front()->posed.problem != c.posed.problem)
      scenes.emplace_back();
    scenes.back().push_back(&c);
    planned.push_back(std::move(blank));
  }
  Progress progress(std::move(planned), [&](const std::vector<Record>& cases) {
    const PastRecords past = read_committed_records(cases, output.folder);
    return expected_seconds(forecast(cases, past.records, limits_of(limits, plan)));
  });
  for (const auto& cases : scenes) {
    SceneRunner run(cases, limits, output.folder, *files, progress, watch, result.times);
    try {
      run.run();
    } catch (const Interrupted&) {
      files->finish();
      throw;
    }
    result.times.preparation_s += run.preparation_s();
  }
  files->finish();
  for (const Case& c : plan)
    if (std::string name = c.name().text(); files->has(name)) result.names.push_back(name);
  result.files = std::move(files);
  result.times.judging_s -= result.times.preparation_s;  // included in the first case's wall time
  result.times.wall_s = seconds_since(start);
  return result;
}

std::vector<Record> RunResult::records() const {
  std::vector<Record> all;
  for (std::size_t k = 0; k < names.size(); ++k) all.push_back(record(k));
  return all;
}

}  // namespace airybench
