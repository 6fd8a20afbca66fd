// Numbers and tables as a user reads them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace airybench {

// "1.24 ms", "3.4 MiB", "1.50 GiB", "2.3e-12"; "-" for a missing value.
std::string show_seconds(std::optional<double> seconds);
std::string show_bytes(std::optional<std::int64_t> bytes);
std::string show_error(std::optional<double> error);

// Rows of equal length, the header first; columns first_number to the last but one are flush right.
std::string aligned_table(const std::vector<std::vector<std::string>>& rows,
                          std::size_t first_number);

// "1 h 02 min", "3 min 10 s", "12 s".
std::string show_duration(double seconds);

}  // namespace airybench
