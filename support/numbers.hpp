// The one reader of numbers in arguments, names and words.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace airybench {

// The whole text is a finite decimal number: no spaces, no '+', no infinity. Empty: it is not.
std::optional<double> parse_number(std::string_view text);
// And without '.' or exponent; no leading zeros, which elsewhere mean base 8.
std::optional<std::int64_t> parse_whole(std::string_view text);
// "2%" is 0.02. Empty: no such text, or not above 0 % and below 100 %.
std::optional<double> parse_percent(std::string_view text);

}  // namespace airybench
