#include "support/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "support/messages.hpp"

namespace airybench {

std::string show_seconds(std::optional<double> seconds) {
  if (!seconds || !std::isfinite(*seconds)) return "-";
  if (*seconds < 1e-3) return fmt::format("{:.3g} µs", *seconds * 1e6);
  if (*seconds < 1) return fmt::format("{:.3g} ms", *seconds * 1e3);
  return fmt::format("{:.3g} s", *seconds);
}

std::string show_bytes(std::optional<std::int64_t> bytes) {
  if (!bytes) return "-";
  const double mib = static_cast<double>(*bytes) / (1024 * 1024);
  return mib < 1024 ? fmt::format("{:.1f} MiB", mib) : fmt::format("{:.2f} GiB", mib / 1024);
}

std::string show_error(std::optional<double> error) {
  return error ? fmt::format("{:.1e}", *error) : "-";
}

std::string show_duration(double seconds) {
  const auto whole = static_cast<long>(std::lround(seconds));
  if (whole >= 3600) return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
  if (whole >= 60) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} s", whole);
}

std::string aligned_table(const std::vector<std::vector<std::string>>& given,
                          std::size_t first_number) {
  std::vector<std::vector<std::string>> rows = given;
  for (auto& row : rows)  // as wide as they are shown
    for (std::string& cell : row) cell = escaped(cell);
  // Counts characters, not bytes: "±" and "µ" have two.
  const auto length = [](const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
  };
  std::vector<std::size_t> width(rows.front().size(), 0);
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], length(row[i]));
  std::string table;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string padding(width[i] - length(row[i]), ' ');
      const bool number = i >= first_number && i + 1 < row.size();
      line += (i > 0 ? "  " : "") + (number ? padding + row[i] : row[i] + padding);
    }
    table += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return table;
}

}  // namespace airybench
