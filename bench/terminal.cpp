#include "bench/terminal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/measuring/seconds_since.hpp"
#include "bench/statistics/robust.hpp"

namespace airybench {

std::string show_seconds(double seconds) {
  if (!std::isfinite(seconds)) return "-";
  if (seconds < 1e-3) return fmt::format("{:.3g} µs", seconds * 1e6);
  if (seconds < 1) return fmt::format("{:.3g} ms", seconds * 1e3);
  return fmt::format("{:.3g} s", seconds);
}

std::string show_bytes(std::optional<std::int64_t> bytes) {
  if (!bytes) return "-";
  return fmt::format("{:.1f} MiB", static_cast<double>(*bytes) / (1024 * 1024));
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

std::string aligned_table(const std::vector<std::vector<std::string>>& rows,
                          std::size_t first_number) {
  // Characters, not bytes: "±" and "µ" have two.
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

std::string results_table(const std::vector<Record>& records) {
  const std::vector<std::string> header = {"case", "n_phi",        "time",        "±",
                                           "heap", "error stress", "error force", "status"};
  std::vector<std::vector<std::string>> rows = {header};
  for (const Record& r : records) {
    const Verification* v = r.verification ? &*r.verification : nullptr;
    rows.push_back(
        {name_of(r).text(), std::to_string(r.n_phi), show_seconds(median(r.samples_s)),
         r.samples_s.size() == 1 ? "n=1" : show_seconds(median_absolute_deviation(r.samples_s)),
         show_bytes(r.peak_heap_bytes), show_error(v ? v->error_stress : std::nullopt),
         show_error(v ? v->error_force : std::nullopt), std::string(name_of(r.status))});
  }
  std::string table = aligned_table(rows, 1);
  for (const Record& r : records)
    if (r.status != Status::ok)
      table += fmt::format("{}: {}: {}\n", name_of(r).text(), name_of(r.status), r.status_reason);
  return table;
}

namespace {

double cost(int n_phi) { return std::pow(n_phi, 1.7); }

}  // namespace

Progress::Progress(std::vector<int> n_phi_of_cases) : cases_(n_phi_of_cases.size()) {
  for (const int n_phi : n_phi_of_cases) total_ += cost(n_phi);
}

std::string Progress::line(const Record& r) {
  done_ += cost(r.n_phi);
  const double elapsed = seconds_since(start_);
  const std::optional<double> error = r.verification ? r.verification->error_force : std::nullopt;
  return fmt::format("[{}/{}] {}: {}, {}, {}, error {}  (elapsed {}, about {} left)\n", ++ended_,
                     cases_, name_of(r).text(), name_of(r.status),
                     show_seconds(median(r.samples_s)), show_bytes(r.peak_heap_bytes),
                     show_error(error), show_duration(elapsed),
                     show_duration(elapsed * std::max(0.0, total_ - done_) / done_));
}

}  // namespace airybench
