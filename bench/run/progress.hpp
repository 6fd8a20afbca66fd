// Output for the user during a run: a line per case, and the time left.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bench/records/record.hpp"
#include "bench/report/prediction.hpp"

namespace airybench {

// Seconds that each case takes by earlier records; empty: unknown.
std::vector<std::optional<double>> expected_seconds(const Forecast& forecast);

// The time to come: what is expected of the cases left, times how the cases done took longer or
// shorter than expected. The fewer are done, the less that counts.
double seconds_left(double elapsed_s, double expected_done_s, double expected_left_s);

class Progress {
 public:
  using Expect = std::function<std::vector<std::optional<double>>(const std::vector<Record>&)>;

  // expect is asked once, and not in a short run.
  Progress(std::vector<Record> planned, Expect expect);
  std::string line(const Record& record);

 private:
  std::string left(double elapsed_s);  // empty: unknown

  std::vector<Record> planned_;
  Expect expect_;
  std::map<std::string, std::optional<double>> expected_s_;  // of the cases left and done, by name
  std::set<std::string> done_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace airybench
