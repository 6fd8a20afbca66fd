#include "bench/run/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "bench/records/robust.hpp"
#include "support/seconds_since.hpp"
#include "support/text_table.hpp"

namespace airybench {

namespace {

std::string imprecise_line(const Record& r) {
  const std::optional<double> uncertainty = median_uncertainty(r.samples_s);
  return fmt::format("{}: time known to ± {}, not {:g} %, after {} repetitions\n",
                     name_of(r).text(),
                     uncertainty ? fmt::format("{:.2g} %", 100 * *uncertainty) : "?",
                     100 * *r.precision, r.samples_s.size());
}

std::string noisy_line(const Record& r) {
  return fmt::format("{}: noise {:.1f} % beside the least noisy of {} attempts, not {:g} %\n",
                     name_of(r).text(), 100 * *r.noise_share, *r.noise_attempts,
                     100 * *r.retry_noisy);
}

struct Column {
  const char* header;
  const char* field;  // shown if any record has it; nullptr: always shown
  std::string (*text)(const Record&);
};

std::string whole(const std::optional<std::int64_t>& number) {
  return number ? fmt::format("{}", *number) : "-";
}

// Time without the method's own error check and refinement.
std::optional<double> unchecked_s(const Record& r) {
  return r.time_s ? std::optional(*r.time_s - r.stage_check_s.value_or(0)) : std::nullopt;
}

constexpr std::array<Column, 14> table_columns = {{
    {"case", nullptr, [](const Record& r) { return name_of(r).text(); }},
    {"n_phi", "n_phi", [](const Record& r) { return whole(r.n_phi); }},
    {"n_c", "siconos_error", [](const Record& r) { return whole(r.n_c); }},
    {"time", nullptr, [](const Record& r) { return show_seconds(r.time_s); }},
    {"±", nullptr,
     [](const Record& r) { return r.repetitions == 1 ? "n=1" : show_seconds(r.time_mad_s); }},
    {"unchecked", "stage_check_s", [](const Record& r) { return show_seconds(unchecked_s(r)); }},
    {"heap", nullptr, [](const Record& r) { return show_bytes(r.peak_heap_bytes); }},
    {"program", "program_s", [](const Record& r) { return show_seconds(r.program_s); }},
    {"its memory", "program_s",
     [](const Record& r) {
       return show_bytes(r.program.empty() ? std::optional<std::int64_t>() : r.peak_rss_bytes);
     }},
    {"error stress", "n_phi", [](const Record& r) { return show_error(r.error_stress); }},
    {"error force", "n_phi", [](const Record& r) { return show_error(r.error_force); }},
    {"natural map", "siconos_error",
     [](const Record& r) { return show_error(r.natural_map_residual); }},
    {"Siconos", "siconos_error", [](const Record& r) { return show_error(r.siconos_error); }},
    {"status", nullptr, [](const Record& r) { return std::string(name_of(r.status)); }},
}};
constexpr std::array<Column, 2> columns_of_errors = {{
    {"error total", "error_total", [](const Record& r) { return show_error(r.error_total); }},
    {"adapted in", "adapt_time_s", [](const Record& r) { return show_seconds(r.adapt_time_s); }},
}};

bool any_has(const std::vector<Record>& records, const char* field) {
  return std::ranges::any_of(
      records, [&](const Record& r) { return !field_named(field).value(r).is_null(); });
}

// Shows the total error only where the methods do not all share their mesh's.
std::vector<Column> columns_for(const std::vector<Record>& records) {
  std::vector<Column> columns;
  for (const Column& c : table_columns)
    if (c.field == nullptr || any_has(records, c.field)) columns.push_back(c);
  const bool total =
      any_has(records, "adapt_level") || std::ranges::any_of(records, &Record::in_displacements);
  if (total)
    for (const Column& c : columns_of_errors)
      if (any_has(records, c.field)) columns.insert(columns.end() - 1, c);
  return columns;
}

}  // namespace

std::string results_table(const std::vector<Record>& records) {
  const std::vector<Column> columns = columns_for(records);
  std::vector<std::vector<std::string>> rows(1);
  for (const Column& column : columns) rows.front().emplace_back(column.header);
  for (const Record& r : records) {
    rows.emplace_back();
    for (const Column& column : columns) rows.back().push_back(column.text(r));
  }
  std::string table = aligned_table(rows, 1);
  for (const Record& r : records)
    if (r.precision && !r.precision_reached && r.time_s) table += imprecise_line(r);
  for (const Record& r : records)
    if (r.noisy && r.noise_share && r.noise_attempts && r.retry_noisy) table += noisy_line(r);
  std::set<std::string> said;  // lines that all methods on a mesh share
  for (const Record& r : records)
    if (r.status != Status::ok)
      table += fmt::format("{}: {}: {}\n", name_of(r).text(), name_of(r.status), r.status_reason);
    else if (const std::string line = fmt::format("{}/{}: {}\n", r.mesh, r.scene, r.status_reason);
             !r.status_reason.empty() && !r.other_solution && said.insert(line).second)
      table += line;
  return table;
}

namespace {

double cost(std::int64_t n_phi) {
  return std::pow(static_cast<double>(std::max<std::int64_t>(n_phi, 1)), 1.7);
}

}  // namespace

Progress::Progress(std::vector<std::int64_t> n_phi_of_cases) : cases_(n_phi_of_cases.size()) {
  for (const std::int64_t n_phi : n_phi_of_cases) total_ += cost(n_phi);
}

std::string Progress::line(const Record& r) {
  done_ += cost(r.n_phi.value_or(0));
  const double elapsed = seconds_since(start_);
  return fmt::format("[{}/{}] {}: {}, {}, {}, error {}  (elapsed {}, about {} left)\n", ++ended_,
                     cases_, name_of(r).text(), name_of(r.status), show_seconds(r.time_s),
                     show_bytes(r.peak_heap_bytes), show_error(r.error_force),
                     show_duration(elapsed),
                     show_duration(elapsed * std::max(0.0, total_ - done_) / done_));
}

}  // namespace airybench
