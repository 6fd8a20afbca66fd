#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/cases/prediction.hpp"
#include "bench/terminal.hpp"

namespace airybench {
namespace {

std::int64_t whole_bytes(double bytes) { return std::llround(bytes); }

std::string show_range(const std::optional<Estimate>& time_s) {
  if (!time_s) return "-";
  return fmt::format("{} .. {}", show_seconds(time_s->low), show_seconds(time_s->high));
}

std::string totals(const std::vector<PlannedCase>& cases, const Forecast& forecast) {
  double sum_s = forecast.references_s.value_or(0);
  std::size_t unknown = 0, largest = 0;
  double most_bytes = 0;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const Prediction& p = forecast.cases[k];
    if (p.run_s)
      sum_s += *p.run_s;
    else
      ++unknown;
    if (p.peak_heap_bytes && p.peak_heap_bytes->value > most_bytes) {
      most_bytes = p.peak_heap_bytes->value;
      largest = k;
    }
  }
  std::string text = fmt::format("the run: about {}", show_duration(sum_s));
  if (forecast.references_s)
    text += fmt::format(", {} of it for references", show_duration(*forecast.references_s));
  else
    text += ", without references";
  if (unknown > 0) text += fmt::format(", without {} of {} cases", unknown, cases.size());
  if (most_bytes > 0)
    text += fmt::format("; largest heap {}, {} {} {}", show_bytes(whole_bytes(most_bytes)),
                        cases[largest].mesh, cases[largest].scene, cases[largest].method);
  return text + "\n";
}

std::string mark_line(const PlannedCase& c, LimitMark mark, const std::string& limit) {
  if (mark == LimitMark::below) return "";
  return fmt::format("{} {} {}: {} {}\n", c.mesh, c.scene, c.method,
                     mark == LimitMark::above ? "above" : "may pass", limit);
}

}  // namespace

std::string prediction_table(const std::vector<PlannedCase>& cases, const Forecast& forecast,
                             const Options& options) {
  std::vector<std::vector<std::string>> rows = {
      {"mesh", "scene", "method", "n_phi", "time", "range", "heap", "in the run", "from"}};
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const PlannedCase& c = cases[k];
    const Prediction& p = forecast.cases[k];
    const std::string knob = c.knob_value ? fmt::format(" {}={}", c.knob, *c.knob_value) : "";
    rows.push_back({c.mesh, c.scene, c.method + knob, std::to_string(c.n_phi),
                    p.time_s ? show_seconds(p.time_s->value) : "-", show_range(p.time_s),
                    p.peak_heap_bytes ? show_bytes(whole_bytes(p.peak_heap_bytes->value)) : "-",
                    p.run_s ? show_seconds(*p.run_s) : "-", p.basis});
  }
  std::string text = aligned_table(rows, 3) + totals(cases, forecast);
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const Prediction& p = forecast.cases[k];
    text += mark_line(cases[k], p.timeout, fmt::format("--timeout={}", options.timeout_s));
    if (options.memory_limit_bytes)
      text += mark_line(cases[k], p.memory_limit,
                        fmt::format("--memory-limit={}", *options.memory_limit_bytes >> 20));
  }
  return text;
}

}  // namespace airybench
