// Output for the user: a line per case during the run, and the final table.
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

class ResultsTable {
 public:
  void add(const Record& record);
  std::string text() const;

 private:
  std::vector<std::string> rows_;   // the cells of all columns, each ended by a tab
  std::set<std::string> fields_;    // that some record has
  bool shows_contact_law_ = false;  // its time: where contact solvers are compared
  std::string imprecise_, noisy_, reasons_;
  std::set<std::string> said_;  // reasons that all methods on a mesh share
};

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
