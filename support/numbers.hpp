// Reads all numbers in arguments, names and words.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace airybench {

// A finite decimal number without spaces or '+'. Empty if the whole text is not one.
std::optional<double> parse_number(std::string_view text);
// Also without '.', exponent, or leading zeros, which elsewhere mean base 8.
std::optional<std::int64_t> parse_whole(std::string_view text);
// "2%" is 0.02. Empty unless the text is above 0 % and below 100 %.
std::optional<double> parse_percent(std::string_view text);

}  // namespace airybench
