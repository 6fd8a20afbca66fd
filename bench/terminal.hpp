// What a user sees: a line per case while it runs, and the table at the end.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "bench/records/record.hpp"

namespace airybench {

// "1.24 ms", "3.4 MiB", "2.3e-12"; a dash for what does not apply.
std::string show_seconds(double seconds);
std::string show_bytes(std::optional<std::int64_t> bytes);
std::string show_error(std::optional<double> error);

// Rows of equally many cells, the header first: columns from first_number to the last but one are
// flush right.
std::string aligned_table(const std::vector<std::vector<std::string>>& rows,
                          std::size_t first_number);

std::string results_table(const std::vector<Record>& records);

// "1 h 02 min", "3 min 10 s", "12 s".
std::string show_duration(double seconds);

// Estimates the time to come from the cases done, with cost ∝ n_φ^1.7 (as measured for 3STEPD).
class Progress {
 public:
  explicit Progress(std::vector<int> n_phi_of_cases);
  // The line for a case that has just ended.
  std::string line(const Record& record);

 private:
  std::size_t cases_, ended_ = 0;
  double done_ = 0, total_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace airybench
