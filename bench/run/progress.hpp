// Output for the user: a line per case during the run, and the final table.
#pragma once

#include <chrono>
#include <set>
#include <string>
#include <vector>

#include "bench/records/record.hpp"

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

// Estimates the time to come from the cases done, with cost ∝ n_φ^1.7 (as measured for 3STEPD).
class Progress {
 public:
  explicit Progress(std::vector<std::int64_t> n_phi_of_cases);
  std::string line(const Record& record);

 private:
  std::size_t cases_, ended_ = 0;
  double done_ = 0, total_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace airybench
