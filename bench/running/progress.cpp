#include "bench/running/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "bench/statistics/median_interval.hpp"
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

double cost(std::int64_t n_phi) { return std::pow(static_cast<double>(n_phi), 1.7); }

}  // namespace

std::string results_table(const std::vector<Record>& records) {
  const bool adapted =
      std::ranges::any_of(records, [](const Record& r) { return r.adapt_level.has_value(); });
  std::vector<std::string> header = {"case", "n_phi",        "time",        "±",
                                     "heap", "error stress", "error force", "status"};
  if (adapted) header.insert(header.end() - 1, {"error total", "adapted in"});
  std::vector<std::vector<std::string>> rows = {header};
  for (const Record& r : records) {
    auto& row = rows.emplace_back(std::vector<std::string>{
        name_of(r).text(), fmt::format("{}", r.n_phi.value_or(0)), show_seconds(r.time_s),
        r.repetitions == 1 ? "n=1" : show_seconds(r.time_mad_s), show_bytes(r.peak_heap_bytes),
        show_error(r.error_stress), show_error(r.error_force), std::string(name_of(r.status))});
    if (adapted)
      row.insert(row.end() - 1, {show_error(r.error_total), show_seconds(r.adapt_time_s)});
  }
  std::string table = aligned_table(rows, 1);
  for (const Record& r : records)
    if (r.precision && !r.precision_reached && r.time_s) table += imprecise_line(r);
  std::set<std::string> said;  // the same of every method on a mesh
  for (const Record& r : records)
    if (r.status != Status::ok)
      table += fmt::format("{}: {}: {}\n", name_of(r).text(), name_of(r.status), r.status_reason);
    else if (const std::string line = fmt::format("{}/{}: {}\n", r.mesh, r.scene, r.status_reason);
             !r.status_reason.empty() && !r.other_solution && said.insert(line).second)
      table += line;
  return table;
}

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
