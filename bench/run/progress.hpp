// Output for the user: a line per case during the run, and the final table.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "bench/records/record.hpp"

namespace airybench {

std::string results_table(const std::vector<Record>& records);

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
