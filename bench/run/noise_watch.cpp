#include "bench/run/noise_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <thread>
#include <utility>

#include "bench/measure/noise_kernel.hpp"
#include "bench/records/robust.hpp"
#include "support/seconds_since.hpp"
#include "support/text_table.hpp"

namespace airybench {
namespace {

constexpr std::size_t lasting = 12;  // passes
constexpr int passes_at_start = 2 * lasting;
// A pass displaces 8 MiB of cached data, which takes one or two milliseconds to reload.
constexpr double long_ago_s = 1;
constexpr double until_idle_threads_sleep_s = 0.1;  // BLAS threads in the case's process
constexpr int max_looks = 10;
constexpr double between_looks_s = 0.2;
// All waits together take at most free_waiting_s plus this share of the run's time so far.
constexpr double max_waiting_share = 0.1, free_waiting_s = 10;

void warm_up_by_passes() {
  constexpr int max_passes = 20, passes_without_gain = 3;
  constexpr double gain = 0.98;
  double shortest_s = run_noise_kernel();
  for (int pass = 1, since = 0; pass < max_passes && since < passes_without_gain; ++pass) {
    const double pass_s = run_noise_kernel();
    since = pass_s < gain * shortest_s ? 0 : since + 1;
    shortest_s = std::min(shortest_s, pass_s);
  }
}

bool is_judged(const Record& r) { return r.retry_noisy && r.noise_share && r.time_s; }

}  // namespace

Machine this_machine() {
  return {
      [](int threads) { return threads > 1 ? run_noise_kernel(threads) : run_noise_kernel(); },
      [](double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); },
      warm_up_by_passes};
}

void QuietLevel::add(const std::vector<double>& passes_s) {
  for (const double pass_s : passes_s) {
    last_.push_back(pass_s);
    if (last_.size() > lasting) last_.pop_front();
    if (last_.size() < lasting) continue;
    const double middle = median({last_.begin(), last_.end()});
    level_ = std::min(level_.value_or(middle), middle);
  }
}

double noise_of(const std::vector<double>& passes_s, double quiet_s) {
  const double mean_s =
      std::accumulate(passes_s.begin(), passes_s.end(), 0.0) / static_cast<double>(passes_s.size());
  return std::max(mean_s / quiet_s - 1, median_absolute_deviation(passes_s) / median(passes_s));
}

void swap_samples(Record& a, Record& b) {
  for (const auto samples : {&Record::samples_s, &Record::program_samples_s,
                             &Record::processor_samples_s, &Record::program_solve_samples_s,
                             &Record::noise_kernel_samples_s, &Record::busy_kernel_samples_s})
    std::swap(a.*samples, b.*samples);
  std::swap(a.stage_samples, b.stage_samples);
}

NoiseWatch::NoiseWatch(std::optional<double> max_noise, Machine machine)
    : max_noise_(max_noise), machine_(std::move(machine)) {
  if (!max_noise_) return;
  machine_.warm_up();
  for (int i = 0; i < passes_at_start; ++i) level_.add({machine_.loop(1)});
}

void NoiseWatch::add_passes(int count, int threads, Record& record) {
  if (max_noise_ && threads > 1) machine_.pause(until_idle_threads_sleep_s);
  if (max_noise_) machine_.warm_up();
  for (int i = 0; i < count; ++i) {
    record.noise_kernel_samples_s.push_back(machine_.loop(1));
    if (max_noise_) level_.add({record.noise_kernel_samples_s.back()});
  }
  // Afterwards, since they take the caches that the others find warm.
  for (int i = 0; i < count && threads > 1; ++i)
    record.busy_kernel_samples_s.push_back(machine_.loop(threads));
  last_pass_ = std::chrono::steady_clock::now();
}

bool NoiseWatch::is_due() const { return max_noise_ && seconds_since(last_pass_) > long_ago_s; }

void NoiseWatch::wait_for_quiet() {
  for (int look = 0; look < max_looks; ++look) {
    machine_.warm_up();
    const std::vector<double> passes_s = {machine_.loop(1), machine_.loop(1), machine_.loop(1)};
    level_.add(passes_s);
    if (noise_beside(passes_s) <= *max_noise_) return;
    if (waited_s_ > free_waiting_s + max_waiting_share * seconds_since(start_)) return;
    machine_.pause(between_looks_s);
    waited_s_ += between_looks_s;
  }
}

double NoiseWatch::noise_beside(const std::vector<double>& passes_s) const {
  return noise_of(passes_s, *level_.seconds());
}

bool NoiseWatch::is_noisy(const Record& record) const {
  return max_noise_ && is_measured(record) && !record.samples_s.empty() &&
         noise_beside(record.noise_kernel_samples_s) > *max_noise_;
}

std::string NoiseWatch::line(const Record& record, std::size_t attempt, int max_attempts) const {
  return fmt::format(
      "{}: noise {:.1f} % (allowed {:g} %) around attempt {} of at most {}, median {}: measured "
      "again\n",
      name_of(record).text(), 100 * noise_beside(record.noise_kernel_samples_s), 100 * *max_noise_,
      attempt, max_attempts, show_seconds(median(record.samples_s)));
}

void NoiseWatch::keep_quietest(std::vector<Record> earlier, Record& record,
                               std::ostream& progress) const {
  if (!max_noise_ || record.samples_s.empty()) return;
  const std::size_t attempts = earlier.size() + 1;
  std::size_t kept = attempts;
  if (is_noisy(record)) {
    swap_samples(record, earlier.emplace_back());
    const auto quietest = std::ranges::min_element(earlier, {}, [&](const Record& attempt) {
      return noise_beside(attempt.noise_kernel_samples_s);
    });
    kept = static_cast<std::size_t>(quietest - earlier.begin()) + 1;
    swap_samples(record, *quietest);
  }
  record.noise_quiet_s = level_.seconds();
  record.noise_share = noise_beside(record.noise_kernel_samples_s);
  record.noise_attempts = static_cast<std::int64_t>(attempts);
  record.noisy = *record.noise_share > *max_noise_;
  if (record.noisy)
    progress << fmt::format("{}: none of {} attempts was quiet: the quietest, {}, is kept\n",
                            name_of(record).text(), attempts, kept);
}

void EarlyPasses::add(const Record& r) {
  if (!is_judged(r)) return;
  quiet_s_ = std::min(quiet_s_.value_or(*r.noise_quiet_s), *r.noise_quiet_s);
  if (!r.noisy) passed_.push_back({r.noise_kernel_samples_s, *r.retry_noisy});
}

int EarlyPasses::count() const {
  return static_cast<int>(std::ranges::count_if(
      passed_, [&](const Passed& p) { return noise_of(p.passes_s, *quiet_s_) > p.max_noise; }));
}

}  // namespace airybench
