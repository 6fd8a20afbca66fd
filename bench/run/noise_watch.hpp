// --retry-noisy: was the machine quiet while a case was timed?
//
// The calibration loop (bench/measure/noise_kernel.hpp) does the same work every time. On one
// machine its times are bounded from below, and whatever else the machine does makes them longer:
// so what is quiet is the smallest level that lasts, q = the smallest median of 12 consecutive
// passes of the run. Of the passes around an attempt, with mean x and median m,
//
//   noise = max( x/q − 1,  MAD/m ),
//
// how much slower the machine was, or how unsteady. The mean, since a solve is longer than a pass:
// it meets in each of its times what few passes meet, as when another process has the CPU for a few
// milliseconds. The case's times have no part in it: what is thrown away does not depend on how it
// came out.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "bench/records/record.hpp"

namespace airybench {

// Seconds of one pass of the loop on so many threads, a wait of so many seconds, and passes that do
// not count, until they get no shorter: after a case, caches, pages and clock are another
// process's, and the first passes take half as long again.
struct Machine {
  std::function<double(int threads)> loop;
  std::function<void(double seconds)> pause;
  std::function<void()> warm_up = [] {};
};
Machine this_machine();

class QuietLevel {
 public:
  void add(const std::vector<double>& passes_s);  // one after another
  std::optional<double> seconds() const { return level_; }

 private:
  std::deque<double> last_;
  std::optional<double> level_;
};

double noise_of(const std::vector<double>& passes_s, double quiet_s);

// Swaps what was measured in an attempt, and around it.
void swap_samples(Record& a, Record& b);

// Of a whole run.
class NoiseWatch {
 public:
  // most_noise: that an attempt may have; empty: nothing is judged, nothing measured again.
  NoiseWatch(std::optional<double> most_noise, Machine machine);

  // From a record that is there already.
  void learn(const Record& record) { level_.add(record.noise_kernel_samples_s); }
  // Times the loop around a case, on one thread and on the case's where these are more.
  void add_passes(int count, int threads, Record& record);
  // The last pass was a second ago or more.
  bool is_due() const;
  // Waits until the loop is quiet: two seconds at most, and all together ten seconds and a tenth of
  // the run's time.
  void wait_for_quiet();

  // Of the passes and samples that the record has now.
  bool is_noisy(const Record& record) const;
  // Of a noisy attempt that others follow, the first being 1.
  std::string line(const Record& record, std::size_t attempt, int most_attempts) const;
  // Leaves the samples of the least noisy attempt in the record, which has those of the last, with
  // how noisy it was; progress tells where none was quiet. A case that failed in its last attempt
  // has failed.
  void keep_quietest(std::vector<Record> earlier, Record& record, std::ostream& progress) const;

 private:
  double noise_beside(const std::vector<double>& passes_s) const;

  std::optional<double> most_noise_;
  Machine machine_;
  QuietLevel level_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), last_pass_;
  double waited_s_ = 0;
};

// Records of this run that passed as quiet, but would not by how quiet the machine was later.
int accepted_too_early(const std::vector<Record>& records);

}  // namespace airybench
