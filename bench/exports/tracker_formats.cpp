#include "bench/exports/tracker_formats.hpp"

#include <fmt/format.h>

#include "bench/records/json.hpp"
#include "bench/records/record_files.hpp"

namespace airybench {
namespace {

std::string context_word(const StoredCase& stored, const char* key) {
  const auto found = stored.context.find(key);
  return found == stored.context.end() ? "" : found->second;
}

}  // namespace

std::string github_action_json(const std::vector<StoredCase>& cases) {
  Json entries = Json::array();
  for (const StoredCase& stored : cases) {
    std::string extra = "status: " + stored.status;
    if (!stored.status_reason.empty()) extra += "\n" + stored.status_reason;
    for (const char* key : {"git_revision", "cpu"})
      if (const std::string word = context_word(stored, key); !word.empty())
        extra += fmt::format("\n{}: {}", key, word);
    const auto add = [&](const char* what, const char* unit, std::optional<double> value,
                         const std::string& range) {
      if (!value) return;
      Json entry = {{"name", stored.name() + " " + what}, {"unit", unit}, {"value", *value}};
      if (!range.empty()) entry["range"] = range;
      entry["extra"] = extra;
      entries.push_back(entry);
    };
    if (stored.time_s)
      add("time", "ms", *stored.time_s * 1e3,
          fmt::format("{:.4g} to {:.4g}", *stored.time_low_s * 1e3, *stored.time_high_s * 1e3));
    add("peak heap", "B", stored.quantity("peak_heap_bytes"), "");
    add("error of the stresses", "relative", stored.quantity("error_stress"), "");
    add("error of the contact forces", "relative", stored.quantity("error_force"), "");
  }
  return indented_json_text(entries, 2) + "\n";
}

std::string bencher_json(const std::vector<StoredCase>& cases) {
  Json all = Json::object();
  for (const StoredCase& stored : cases) {
    Json measures = Json::object();
    if (stored.time_s)
      measures["latency"] = {{"value", *stored.time_s * 1e9},
                             {"lower_value", *stored.time_low_s * 1e9},
                             {"upper_value", *stored.time_high_s * 1e9}};
    for (const auto& [measure, key] :
         {std::pair("peak-heap", "peak_heap_bytes"), std::pair("error-stress", "error_stress"),
          std::pair("error-force", "error_force")})
      if (const auto value = stored.quantity(key)) measures[measure] = {{"value", *value}};
    if (!measures.empty()) all[stored.name()] = measures;
  }
  return indented_json_text(all, 2) + "\n";
}

std::string series_csv(const std::vector<StoredCase>& cases) {
  std::string text = "date,revision,mesh,scene,method,stop,quantity,value\n";
  for (const StoredCase& stored : cases) {
    std::string row;
    for (const std::string& cell :
         {context_word(stored, "date"), context_word(stored, "git_revision"), stored.mesh,
          stored.scene, stored.method, stored.stop})
      row += csv_field(cell) + ",";
    for (const auto& [key, value] : stored.quantities)
      text += fmt::format("{}{},{}\n", row, csv_field(key), value);
  }
  return text;
}

}  // namespace airybench
