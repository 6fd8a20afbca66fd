#include "bench/run/progress.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "support/seconds_since.hpp"
#include "support/text_table.hpp"

namespace airybench {

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
