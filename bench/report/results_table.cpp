#include "bench/report/results_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include "bench/records/record_numbers.hpp"
#include "bench/records/robust.hpp"
#include "bench/records/summary.hpp"
#include "support/text_table.hpp"

namespace airybench {

struct TableColumn {
  enum class Kind { words, count, seconds, bytes, error, mm, newtons };
  struct Cell {
    std::optional<double> number;
    std::string words;  // if there is no number
  };

  const char* header;
  Kind kind;
  int rank;           // unless columns are chosen, those of the lowest ranks are shown
  const char* field;  // that some record must have; nullptr: none
  Cell (*cell)(const Record&);
};

namespace {

using Cell = TableColumn::Cell;
using CellKind = TableColumn::Kind;

constexpr int of_contact_studies = 8, if_chosen = 9;  // ranks
constexpr std::size_t max_columns = 8;                // of a table whose columns are not chosen
constexpr const char* all_columns = "all";

Cell amount(const std::optional<double>& value) { return {value, "-"}; }
Cell whole(const std::optional<std::int64_t>& value) {
  return amount(value ? std::optional(static_cast<double>(*value)) : std::nullopt);
}
Cell named(std::string text) { return {{}, std::move(text)}; }

// Its square is a difference of energies at contact: below this it is rounding.
Cell total_error(const std::optional<double>& value) {
  constexpr double rounding = 1e-7;
  return value && *value < rounding ? named("≤ " + show_error(value)) : amount(value);
}

// Time without the method's own error check and refinement.
std::optional<double> unchecked_s(const Record& r) {
  return r.time_s ? std::optional(*r.time_s - r.stage_check_s.value_or(0)) : std::nullopt;
}

constexpr std::array<TableColumn, 27> table_columns = {{
    {"case", CellKind::words, 0, nullptr, [](const Record& r) { return named(name_of(r).text()); }},
    {"mesh", CellKind::words, if_chosen, nullptr, [](const Record& r) { return named(r.mesh); }},
    {"scene", CellKind::words, if_chosen, nullptr, [](const Record& r) { return named(r.scene); }},
    {"method", CellKind::words, if_chosen, nullptr,
     [](const Record& r) { return named(variant_of(r)); }},
    {"n_phi", CellKind::count, 1, "n_phi", [](const Record& r) { return whole(r.n_phi); }},
    {"n_c", CellKind::count, 1, "siconos_error", [](const Record& r) { return whole(r.n_c); }},
    {"W", CellKind::words, 5, "contact_matrix",
     [](const Record& r) { return named(r.contact_matrix); }},
    {"time", CellKind::seconds, 1, nullptr, [](const Record& r) { return amount(r.time_s); }},
    {"±", CellKind::seconds, 3, nullptr,
     [](const Record& r) { return r.repetitions == 1 ? named("n=1") : amount(r.time_mad_s); }},
    {"contact law", CellKind::seconds, of_contact_studies, "stage_contact_s",
     [](const Record& r) { return amount(r.stage_contact_s); }},
    {"without self-check", CellKind::seconds, 5, "stage_check_s",
     [](const Record& r) { return amount(unchecked_s(r)); }},
    {"heap", CellKind::bytes, 1, nullptr, [](const Record& r) { return whole(r.peak_heap_bytes); }},
    {"program", CellKind::seconds, 2, "program_s",
     [](const Record& r) { return amount(r.program_s); }},
    {"CPU", CellKind::seconds, 5, "processor_s",
     [](const Record& r) { return amount(r.processor_s); }},
    {"RSS", CellKind::bytes, 5, "program_s",
     [](const Record& r) { return r.program.empty() ? named("-") : whole(r.peak_rss_bytes); }},
    {"error stress", CellKind::error, 3, "n_phi",
     [](const Record& r) { return amount(r.error_stress); }},
    {"error force", CellKind::error, 4, "n_phi",
     [](const Record& r) { return amount(r.error_force); }},
    {"natural map", CellKind::error, 2, "siconos_error",
     [](const Record& r) { return amount(r.natural_map_residual); }},
    {"Siconos", CellKind::error, 4, "siconos_error",
     [](const Record& r) { return amount(r.siconos_error); }},
    {"error total", CellKind::error, 2, "error_total",
     [](const Record& r) { return total_error(r.error_total); }},
    // What bodies solved in displacements are asked.
    {"penetration", CellKind::mm, 5, "penetration_mm",
     [](const Record& r) { return amount(r.penetration_mm); }},
    {"between nodes", CellKind::mm, 5, "penetration_mm",
     [](const Record& r) { return amount(r.edge_penetration_mm); }},
    {"tension", CellKind::error, 5, "penetration_mm",
     [](const Record& r) { return amount(r.tension); }},
    {"outside friction cone", CellKind::error, 5, "penetration_mm",
     [](const Record& r) { return amount(r.friction_excess); }},
    {"unbalanced", CellKind::newtons, 5, "penetration_mm",
     [](const Record& r) { return amount(r.unbalanced_N); }},
    {"adaptive loop", CellKind::seconds, 2, "adapt_time_s",
     [](const Record& r) { return amount(r.adapt_time_s); }},
    {"status", CellKind::words, 0, nullptr,
     [](const Record& r) { return named(std::string(name_of(r.status))); }},
}};

// With its unit.
std::string text_of(const Cell& cell, CellKind kind) {
  if (!cell.number) return cell.words;
  switch (kind) {
    case CellKind::seconds:
      return show_seconds(cell.number);
    case CellKind::bytes:
      return show_bytes(std::llround(*cell.number));
    case CellKind::error:
      return show_error(cell.number);
    case CellKind::mm:
      return fmt::format("{:.1e} mm", *cell.number);
    case CellKind::newtons:
      return fmt::format("{:.1e} N", *cell.number);
    default:
      return fmt::format("{:.0f}", *cell.number);
  }
}

std::string imprecise_line(const Record& r) {
  const std::optional<double> uncertainty = median_uncertainty(r.samples_s);
  return fmt::format("{}: time known to ± {}, not {:g} %, after {} repetitions\n",
                     name_of(r).text(),
                     uncertainty ? fmt::format("{:.2g} %", 100 * *uncertainty) : "?",
                     100 * *precision_of(r), r.samples_s.size());
}

std::string noisy_line(const Record& r) {
  return fmt::format("{}: noise {:.1f} % around the least noisy of {} attempts, not {:g} %\n",
                     name_of(r).text(), 100 * *r.noise_share, *r.noise_attempts,
                     100 * *r.retry_noisy);
}

}  // namespace

void FilledColumns::add(const Record& r) {
  for (const TableColumn& column : table_columns)
    if (column.field != nullptr && !field_named(column.field).value(r).is_null())
      fields_.insert(column.field);
  has_contact_study_ = has_contact_study_ || r.points == "contact";
}

namespace {

std::string key_of(const TableColumn& column) {
  std::string key = column.header;
  std::ranges::replace(key, ' ', '_');
  return key;
}

const TableColumn& column_named(const std::string& key) {
  const auto* found = std::ranges::find(table_columns, key, key_of);
  if (found != table_columns.end()) return *found;
  std::string valid = all_columns;
  for (const TableColumn& column : table_columns) valid += ", " + key_of(column);
  throw UsageError(fmt::format("--columns: no column is '{}' (valid: {})", key, valid));
}

bool are_all(const std::vector<std::string>& chosen) {
  return chosen == std::vector<std::string>{all_columns};
}

// With what names the cases.
std::vector<const TableColumn*> columns_named(const std::vector<std::string>& chosen) {
  std::vector<const TableColumn*> columns;
  for (const std::string& key : chosen) columns.push_back(&column_named(key));
  const auto names_cases = [](const TableColumn* column) {
    return column->rank == if_chosen || column == &table_columns.front();
  };
  if (std::ranges::none_of(columns, names_cases))
    columns.insert(columns.begin(), &table_columns.front());
  return columns;
}

}  // namespace

std::vector<const TableColumn*> FilledColumns::all() const {
  std::vector<const TableColumn*> columns;
  for (const TableColumn& column : table_columns)
    if (column.rank != if_chosen && (column.field == nullptr || fields_.contains(column.field)))
      columns.push_back(&column);
  return columns;
}

std::vector<const TableColumn*> FilledColumns::of_lowest_rank() const {
  std::vector<const TableColumn*> columns = all();
  const auto rank = [this](const TableColumn* column) {
    return column->rank == of_contact_studies && has_contact_study_ ? 2 : column->rank;
  };
  std::ranges::stable_sort(columns, {}, rank);
  columns.resize(std::min(columns.size(), max_columns));
  std::ranges::sort(columns);  // as in the table
  return columns;
}

namespace {

// Of a table with these choices, or that it may have before all records are known.
std::vector<const TableColumn*> columns_of(const FilledColumns& filled,
                                           const std::vector<std::string>& chosen) {
  if (chosen.empty()) return filled.of_lowest_rank();
  return are_all(chosen) ? filled.all() : columns_named(chosen);
}
std::vector<const TableColumn*> candidates(const std::vector<std::string>& chosen) {
  if (!chosen.empty() && !are_all(chosen)) return columns_named(chosen);
  std::vector<const TableColumn*> columns;
  for (const TableColumn& column : table_columns)
    if (column.rank != if_chosen) columns.push_back(&column);
  return columns;
}

}  // namespace

ResultsTable::ResultsTable(const std::vector<std::string>& chosen)
    : chosen_(chosen), kept_(candidates(chosen)) {}

void ResultsTable::add(const Record& r) {
  filled_.add(r);
  std::string row;
  for (const TableColumn* column : kept_) row += text_of(column->cell(r), column->kind) + "\t";
  row.shrink_to_fit();
  rows_.push_back(std::move(row));
  if (misses_precision(r)) imprecise_ += imprecise_line(r);
  if (r.noisy && r.noise_share && r.noise_attempts && r.retry_noisy) noisy_ += noisy_line(r);
  if (r.status != Status::ok) {
    reasons_.push_back(
        {"", name_of(r).text(), fmt::format("{}: {}", name_of(r.status), r.status_reason)});
  } else if (!r.status_reason.empty() && r.outcome != other_solution) {
    const Reason remark = {r.mesh + "/" + r.scene, name_of(r).text(), r.status_reason};
    const auto same = std::ranges::find_if(reasons_, [&](const Reason& other) {
      return other.scene == remark.scene && other.text == remark.text;
    });
    if (same == reasons_.end())
      reasons_.push_back(remark);
    else
      ++same->more_cases;
  }
}

// A remark names its scene, or its first case where others of the scene have another remark.
std::string ResultsTable::reasons() const {
  std::map<std::string, int> remarks;  // of each scene
  for (const Reason& reason : reasons_) ++remarks[reason.scene];
  std::string lines;
  for (const auto& [scene, case_name, text, more_cases] : reasons_)
    if (!scene.empty() && remarks[scene] == 1)
      lines += fmt::format("{}: {}\n", scene, text);
    else
      lines += fmt::format("{}{}: {}\n", case_name,
                           more_cases > 0 ? fmt::format(" and {} more", more_cases) : "", text);
  return lines;
}

std::string ResultsTable::text() const {
  const std::vector<const TableColumn*> shown = columns_of(filled_, chosen_);
  std::vector<std::vector<std::string>> table(1);
  for (const TableColumn* column : shown) table.front().emplace_back(column->header);
  for (const std::string& row : rows_) {
    std::istringstream cells(row);
    std::string cell;
    table.emplace_back();
    for (const TableColumn* column : kept_)
      if (std::getline(cells, cell, '\t') && std::ranges::find(shown, column) != shown.end())
        table.back().push_back(cell);
  }
  std::string more;
  for (const TableColumn* column : filled_.all())
    if (chosen_.empty() && std::ranges::find(shown, column) == shown.end())
      more += (more.empty() ? "" : ", ") + key_of(*column);
  if (!more.empty()) more = fmt::format("not shown: {} (--columns=NAMES or all)\n", more);
  return aligned_table(table, 1) + imprecise_ + noisy_ + reasons() + more;
}

namespace {

struct Unit {
  const char* suffix;  // of the header
  double size;
};

// The largest that is at most the median.
Unit unit_for(CellKind kind, const std::vector<double>& numbers) {
  if (kind == CellKind::mm) return {", mm", 1};
  if (kind == CellKind::newtons) return {", N", 1};
  if (kind != CellKind::seconds && kind != CellKind::bytes) return {"", 1};
  constexpr std::array<Unit, 3> times = {{{", s", 1}, {", ms", 1e-3}, {", µs", 1e-6}}};
  constexpr std::array<Unit, 2> sizes = {{{", GiB", 1 << 30}, {", MiB", 1 << 20}}};
  const double middle = median(numbers);
  const auto largest = [&](const auto& units) {
    for (const Unit& unit : units)
      if (middle >= unit.size) return unit;
    return units.back();
  };
  return kind == CellKind::seconds ? largest(times) : largest(sizes);
}

// Three significant digits, more of a number above 1000; never with an exponent.
std::string three_digits(double value) {
  const int decimals = std::max(0, 2 - static_cast<int>(std::floor(std::log10(std::abs(value)))));
  return fmt::format("{:.{}f}", value, decimals);
}

std::string text_in(const Unit& unit, const Cell& cell, CellKind kind) {
  if (cell.number == 0.) return "0";
  if (!cell.number || kind == CellKind::count || kind == CellKind::error)
    return text_of(cell, kind);
  if (kind == CellKind::mm || kind == CellKind::newtons) return show_error(cell.number);
  return three_digits(*cell.number / unit.size);
}

}  // namespace

PaperTable paper_table(const std::vector<Record>& cases, const std::vector<std::string>& chosen) {
  FilledColumns filled;
  for (const Record& record : cases) filled.add(record);
  PaperTable table;
  table.rows.resize(cases.size());
  std::map<CellKind, Unit> units;  // of all columns of a kind: its first's
  for (const TableColumn* column : columns_of(filled, chosen)) {
    std::vector<Cell> cells;
    std::vector<double> numbers;
    for (const Record& record : cases) {
      cells.push_back(column->cell(record));
      if (cells.back().number) numbers.push_back(*cells.back().number);
    }
    const Unit unit =
        units.try_emplace(column->kind, unit_for(column->kind, numbers)).first->second;
    table.columns.push_back(
        {std::string(column->header) + unit.suffix, column->kind != CellKind::words});
    for (std::size_t k = 0; k < cells.size(); ++k)
      table.rows[k].push_back(text_in(unit, cells[k], column->kind));
  }
  return table;
}

}  // namespace airybench
