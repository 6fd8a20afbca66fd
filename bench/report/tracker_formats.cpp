#include "bench/report/tracker_formats.hpp"

#include <fmt/format.h>

#include "bench/records/numbers.hpp"

namespace airybench {

std::string github_action_json(const std::vector<Record>& cases) {
  Json entries = Json::array();
  for (const Record& record : cases) {
    std::string extra = fmt::format("status: {}", name_of(record.status));
    if (!record.status_reason.empty()) extra += "\n" + record.status_reason;
    for (const char* key : {"git_revision", "cpu"})
      if (const std::string word = context_word(record, key); !word.empty())
        extra += fmt::format("\n{}: {}", key, word);
    const auto add = [&](const char* what, const char* unit, std::optional<double> value,
                         const std::string& range) {
      if (!value) return;
      Json entry = {
          {"name", name_of(record).text() + " " + what}, {"unit", unit}, {"value", *value}};
      if (!range.empty()) entry["range"] = range;
      entry["extra"] = extra;
      entries.push_back(entry);
    };
    if (record.time_s)
      add("time", "ms", *record.time_s * 1e3,
          fmt::format("{:.4g} to {:.4g}", time_interval(record).low * 1e3,
                      time_interval(record).high * 1e3));
    add("peak heap", "B", record.peak_heap_bytes, "");
    add("error of the stresses", "relative", record.error_stress, "");
    add("error of the contact forces", "relative", record.error_force, "");
  }
  return indented_json_text(entries, 2) + "\n";
}

std::string bencher_json(const std::vector<Record>& cases) {
  Json all = Json::object();
  for (const Record& record : cases) {
    Json measures = Json::object();
    if (record.time_s)
      measures["latency"] = {{"value", *record.time_s * 1e9},
                             {"lower_value", time_interval(record).low * 1e9},
                             {"upper_value", time_interval(record).high * 1e9}};
    for (const auto& [measure, key] :
         {std::pair("peak-heap", "peak_heap_bytes"), std::pair("error-stress", "error_stress"),
          std::pair("error-force", "error_force")})
      if (const auto value = number_in(record, field_named(key)))
        measures[measure] = {{"value", *value}};
    if (!measures.empty()) all[name_of(record).text()] = measures;
  }
  return indented_json_text(all, 2) + "\n";
}

}  // namespace airybench
