// --retry-noisy: was the machine quiet while a case was timed?
//
// The calibration loop (bench/measure/noise_kernel.hpp) always does the same work, and other work
// on the machine only makes it slower. The quiet level q is the smallest median of 12 consecutive
// passes of the run. With mean x and median m of the passes around an attempt,
//
//   noise = max( x/q − 1,  MAD/m ),
//
// the slowdown or the unsteadiness. The mean counts because a solve is longer than a pass: a short
// disturbance hits every solve but few passes. The case's own times play no part, so the choice of
// attempts does not depend on their results.
#pragma once

#include <algorithm>
#include <chrono>
#include <deque>
#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "bench/records/record.hpp"

namespace airybench {

// loop: seconds of one pass. warm_up: uncounted passes until they get no shorter; right after a
// case the first passes take half as long again (caches, pages, clock).
struct Machine {
  std::function<double(int threads)> loop;
  std::function<void(double seconds)> pause;
  std::function<void()> warm_up = [] {};
};
Machine this_machine();

class QuietLevel {
 public:
  void add(const std::vector<double>& passes_s);  // consecutive passes
  void is_at_most(double seconds) { level_ = std::min(level_.value_or(seconds), seconds); }
  std::optional<double> seconds() const { return level_; }

 private:
  std::deque<double> last_;
  std::optional<double> level_;
};

double noise_of(const std::vector<double>& passes_s, double quiet_s);

void swap_samples(Record& a, Record& b);

class NoiseWatch {
 public:
  // max_noise: allowed noise of an attempt; empty: judge and repeat nothing.
  NoiseWatch(std::optional<double> max_noise, Machine machine);

  void learn(const Record& record) {
    level_.add(record.noise_kernel_samples_s);
    if (record.noise_quiet_s) level_.is_at_most(*record.noise_quiet_s);
  }
  void add_passes(int count, int threads, Record& record);
  bool is_due() const;
  // Waits for quiet, at most 2 s; all waits at most 10 s plus a tenth of the run's time.
  void wait_for_quiet();

  bool is_noisy(const Record& record) const;
  std::string line(const Record& record, std::size_t attempt, int max_attempts) const;
  // Leaves the quietest attempt's samples and noise in the record, which holds the last attempt's.
  // A case whose last attempt failed has failed.
  void keep_quietest(std::vector<Record> earlier, Record& record, std::ostream& progress) const;

 private:
  double noise_beside(const std::vector<double>& passes_s) const;

  std::optional<double> max_noise_;
  Machine machine_;
  QuietLevel level_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), last_pass_;
  double waited_s_ = 0;
};

// Counts records that passed as quiet but would not by the run's final quiet level.
class EarlyPasses {
 public:
  void add(const Record& record);
  int count() const;

 private:
  struct Passed {
    std::vector<double> passes_s;
    double max_noise;
  };
  std::vector<Passed> passed_;
  std::optional<double> quiet_s_;
};

}  // namespace airybench
