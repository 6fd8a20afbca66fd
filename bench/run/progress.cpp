#include "bench/run/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "bench/records/robust.hpp"
#include "bench/records/summary.hpp"
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
  return fmt::format("{}: noise {:.1f} % around the least noisy of {} attempts, not {:g} %\n",
                     name_of(r).text(), 100 * *r.noise_share, *r.noise_attempts,
                     100 * *r.retry_noisy);
}

struct Column {
  const char* header;
  const char* field;  // shown if any record has it; nullptr: always shown
  std::string (*text)(const Record&);
  bool of_contact_study = false;
};

std::string whole(const std::optional<std::int64_t>& number) {
  return number ? fmt::format("{}", *number) : "-";
}

// Time without the method's own error check and refinement.
std::optional<double> unchecked_s(const Record& r) {
  return r.time_s ? std::optional(*r.time_s - r.stage_check_s.value_or(0)) : std::nullopt;
}

std::string in_unit(const std::optional<double>& value, const char* unit) {
  return value ? fmt::format("{:.1e} {}", *value, unit) : "-";
}

constexpr std::array<Column, 23> table_columns = {{
    {"case", nullptr, [](const Record& r) { return name_of(r).text(); }},
    {"n_phi", "n_phi", [](const Record& r) { return whole(r.n_phi); }},
    {"n_c", "siconos_error", [](const Record& r) { return whole(r.n_c); }},
    {"W", "contact_matrix", [](const Record& r) { return r.contact_matrix; }},
    {"time", nullptr, [](const Record& r) { return show_seconds(r.time_s); }},
    {"±", nullptr,
     [](const Record& r) { return r.repetitions == 1 ? "n=1" : show_seconds(r.time_mad_s); }},
    {"contact law", "stage_contact_s",
     [](const Record& r) { return show_seconds(r.stage_contact_s); }, true},
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
    {"error total", "error_total",
     [](const Record& r) { return show_error(worst_error_total(r)); }},
    // What bodies solved in displacements are asked.
    {"penetration", "penetration_mm",
     [](const Record& r) { return in_unit(r.penetration_mm, "mm"); }},
    {"between nodes", "penetration_mm",
     [](const Record& r) { return in_unit(r.edge_penetration_mm, "mm"); }},
    {"tension", "penetration_mm", [](const Record& r) { return show_error(r.tension); }},
    {"over friction", "penetration_mm",
     [](const Record& r) { return show_error(r.friction_excess); }},
    {"unbalanced", "penetration_mm", [](const Record& r) { return in_unit(r.unbalanced_N, "N"); }},
    {"adapted in", "adapt_time_s", [](const Record& r) { return show_seconds(r.adapt_time_s); }},
    {"status", nullptr, [](const Record& r) { return std::string(name_of(r.status)); }},
}};
}  // namespace

void ResultsTable::add(const Record& r) {
  const auto has = [&](const char* field) { return !field_named(field).value(r).is_null(); };
  for (const Column& column : table_columns)
    if (column.field != nullptr && has(column.field)) fields_.insert(column.field);
  if (worst_error_total(r)) fields_.insert("error_total");  // of a path, whose last step has none
  shows_contact_law_ = shows_contact_law_ || r.study == "contact";
  std::string row;
  for (const Column& column : table_columns) row += column.text(r) + "\t";
  row.shrink_to_fit();
  rows_.push_back(std::move(row));
  if (r.precision && !r.precision_reached && r.time_s) imprecise_ += imprecise_line(r);
  if (r.noisy && r.noise_share && r.noise_attempts && r.retry_noisy) noisy_ += noisy_line(r);
  if (r.status != Status::ok)
    reasons_ += fmt::format("{}: {}: {}\n", name_of(r).text(), name_of(r.status), r.status_reason);
  else if (const std::string line = fmt::format("{}/{}: {}\n", r.mesh, r.scene, r.status_reason);
           !r.status_reason.empty() && !r.other_solution && said_.insert(line).second)
    reasons_ += line;
}

std::string ResultsTable::text() const {
  const auto is_shown = [&](const Column& column) {
    return (column.field == nullptr || fields_.contains(column.field)) &&
           (!column.of_contact_study || shows_contact_law_);
  };
  std::vector<std::vector<std::string>> shown(1);
  for (const Column& column : table_columns)
    if (is_shown(column)) shown.front().emplace_back(column.header);
  for (const std::string& row : rows_) {
    std::istringstream cells(row);
    std::string cell;
    shown.emplace_back();
    for (const Column& column : table_columns)
      if (std::getline(cells, cell, '\t') && is_shown(column)) shown.back().push_back(cell);
  }
  return aligned_table(shown, 1) + imprecise_ + noisy_ + reasons_;
}

namespace {

// The largest, by its name: it decides on the status.
std::string error_of(const Record& r) {
  const std::pair<const char*, std::optional<double>> all[] = {
      {"stress error", r.error_stress},
      {"force error", r.error_force},
      {"equilibrium", r.equilibrium_residual},
      {"natural map", r.natural_map_residual}};
  const auto worst = std::ranges::max_element(
      all, {}, [](const auto& error) { return error.second.value_or(-1); });
  return worst->second ? fmt::format("{} {}", worst->first, show_error(worst->second)) : "error -";
}

}  // namespace

std::vector<std::optional<double>> expected_seconds(const Forecast& forecast) {
  constexpr double process_s = 0.1;  // of a case: its process, its fields, its lines
  std::vector<std::optional<double>> result;
  for (const Prediction& p : forecast.cases)
    result.push_back(p.run_s ? std::optional(*p.run_s + process_s) : std::nullopt);
  return result;
}

double seconds_left(double elapsed_s, double expected_done_s, double expected_left_s) {
  constexpr double trusted = 0.05;  // of the whole run: it goes as expected
  const double prior = trusted * (expected_done_s + expected_left_s);
  return expected_left_s * (elapsed_s + prior) / (expected_done_s + prior);
}

Progress::Progress(std::vector<Record> planned, Expect expect)
    : planned_(std::move(planned)), expect_(std::move(expect)) {}

std::string Progress::left(double elapsed_s) {
  constexpr double short_s = 2;
  if (elapsed_s < short_s || done_.size() >= planned_.size()) return "";
  if (expected_s_.empty()) {
    const std::vector<std::optional<double>> expected = expect_(planned_);
    for (std::size_t k = 0; k < planned_.size(); ++k)
      expected_s_[name_of(planned_[k]).text()] = expected[k];
  }
  double done_s = 0, left_s = 0;
  for (const auto& [name, seconds] : expected_s_)
    if (done_.contains(name))
      done_s += seconds.value_or(0);
    else if (seconds)
      left_s += *seconds;
    else
      return "";
  return fmt::format(", about {} left", show_duration(seconds_left(elapsed_s, done_s, left_s)));
}

std::string Progress::line(const Record& r) {
  done_.insert(name_of(r).text());
  const double elapsed = seconds_since(start_);
  return fmt::format("[{}/{}] {}: {}, {}, {}, {}  (elapsed {}{})\n", done_.size(), planned_.size(),
                     name_of(r).text(), name_of(r.status), show_seconds(r.time_s),
                     show_bytes(r.peak_heap_bytes), error_of(r), show_duration(elapsed),
                     left(elapsed));
}

}  // namespace airybench
