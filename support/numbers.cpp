#include "support/numbers.hpp"

#include <charconv>
#include <cmath>

namespace airybench {
namespace {

template <typename Number>
std::optional<Number> parse_all(std::string_view text) {
  Number value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && rest == end ? std::optional(value) : std::nullopt;
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  const std::optional<double> value = parse_all<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::int64_t> parse_whole(std::string_view text) {
  const std::string_view digits = text.substr(text.starts_with('-') ? 1 : 0);
  if (digits.starts_with('0') && text != "0") return {};
  return parse_all<std::int64_t>(text);
}

std::optional<double> parse_percent(std::string_view text) {
  if (!text.ends_with('%')) return {};
  const std::optional<double> percent = parse_number(text.substr(0, text.size() - 1));
  return percent && *percent > 0 && *percent < 100 ? std::optional(*percent / 100) : std::nullopt;
}

}  // namespace airybench
