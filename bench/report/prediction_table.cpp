#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/report/prediction.hpp"
#include "support/text_table.hpp"

namespace airybench {
namespace {

// "3.4 MiB"; what no machine has, at the largest number of bytes there is.
std::string show_heap(const std::optional<Estimate>& bytes) {
  if (!bytes) return "-";
  constexpr double most = 9e18;
  return show_bytes(std::llround(std::min(bytes->value, most)));
}

// "43.2 s", "2 min 05 s"; far extrapolations may be of any size.
std::string show_time(double seconds) {
  return seconds < 100 || seconds > 1e9 ? show_seconds(seconds) : show_duration(seconds);
}

std::string show_range(const std::optional<Estimate>& time_s) {
  if (!time_s) return "-";
  return fmt::format("{} .. {}", show_time(time_s->low), show_time(time_s->high));
}

std::string totals(const std::vector<Record>& cases, const Forecast& forecast) {
  double sum_s = forecast.references_s.value_or(0);
  std::size_t unknown = 0, largest = 0;
  std::optional<Estimate> most;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const Prediction& p = forecast.cases[k];
    if (p.run_s)
      sum_s += *p.run_s;
    else
      ++unknown;
    if (p.peak_heap_bytes && (!most || p.peak_heap_bytes->value > most->value)) {
      most = p.peak_heap_bytes;
      largest = k;
    }
  }
  std::string text = fmt::format("the run: about {}", show_time(sum_s));
  if (forecast.references_s)
    text += fmt::format(", {} of it for references", show_time(*forecast.references_s));
  else
    text += ", without references";
  if (unknown > 0) text += fmt::format(", without {} of {} cases", unknown, cases.size());
  if (most)
    text += fmt::format("; largest heap {}, {}", show_heap(most), name_of(cases[largest]).text());
  return text + "\n";
}

std::string mark_line(const Record& c, LimitMark mark, const std::string& limit) {
  if (mark == LimitMark::below) return "";
  return fmt::format("{}: {} {}\n", name_of(c).text(),
                     mark == LimitMark::above ? "above" : "may pass", limit);
}

}  // namespace

std::string prediction_table(const std::vector<Record>& cases, const Forecast& forecast,
                             const RunLimits& limits) {
  std::vector<std::vector<std::string>> rows = {
      {"case", "n_phi", "time", "range", "heap", "in the run", "from"}};
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const Record& c = cases[k];
    const Prediction& p = forecast.cases[k];
    rows.push_back({name_of(c).text(), c.n_phi ? fmt::format("{}", *c.n_phi) : "-",
                    p.time_s ? show_time(p.time_s->value) : "-", show_range(p.time_s),
                    show_heap(p.peak_heap_bytes), p.run_s ? show_time(*p.run_s) : "-", p.basis});
  }
  std::string text = aligned_table(rows, 1) + totals(cases, forecast);
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const Prediction& p = forecast.cases[k];
    text += mark_line(cases[k], p.timeout, fmt::format("--timeout={}", limits.timeout_s));
    if (limits.memory_limit_bytes)
      text += mark_line(cases[k], p.memory_limit,
                        fmt::format("--memory-limit={}", *limits.memory_limit_bytes >> 20));
  }
  return text;
}

}  // namespace airybench
