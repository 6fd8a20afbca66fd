#include "bench/exports/stored_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/records/case_name.hpp"
#include "bench/records/json.hpp"
#include "bench/records/record_files.hpp"
#include "bench/records/record_reader.hpp"
#include "bench/statistics/robust.hpp"

namespace airybench {
namespace {

const Json& value_of(const Json& object, const char* key) {
  static const Json null;
  const auto found = object.find(key);
  return found == object.end() ? null : *found;
}

[[noreturn]] void fail(const std::string& place, const char* key, const Json& value,
                       const char* allowed) {
  throw RecordError(fmt::format("{}: {}: {} (allowed: {})", place, key, json_text(value), allowed));
}

// Null and a missing key: empty.
std::string text(const Json& record, const std::string& place, const char* key) {
  const Json& value = value_of(record, key);
  if (value.is_null()) return "";
  if (!value.is_string()) fail(place, key, value, "a text, null");
  return value.get<std::string>();
}

std::string name(const Json& record, const std::string& place, const char* key) {
  if (text(record, place, key).empty()) fail(place, key, value_of(record, key), "a text");
  return record[key].get<std::string>();
}

std::optional<double> number(const Json& record, const std::string& place, const char* key) {
  const Json& value = value_of(record, key);
  if (value.is_null()) return {};
  if (!value.is_number()) fail(place, key, value, "a number, null");
  return value.get<double>();
}

std::vector<double> samples(const Json& record, const std::string& place) {
  const Json& value = value_of(record, "samples_s");
  if (value.is_null()) return {};
  if (!value.is_array()) fail(place, "samples_s", value, "a list of numbers");
  for (const Json& sample : value)
    if (!sample.is_number()) fail(place, "samples_s", sample, "numbers");
  return value.get<std::vector<double>>();
}

std::map<std::string, std::string> context_of(const Json& record, const std::string& place) {
  const Json& value = value_of(record, "context");
  if (value.is_null()) return {};
  if (!value.is_object()) fail(place, "context", value, "an object of texts");
  std::map<std::string, std::string> context;
  for (const auto& [key, word] : value.items()) {
    if (!word.is_string()) fail(place, ("context." + key).c_str(), word, "a text");
    context[key] = word.get<std::string>();
  }
  return context;
}

CaseName case_name(const Json& record, const std::string& place, const StoredCase& stored) {
  return {stored.mesh,
          stored.scene,
          name(record, place, "method"),
          text(record, place, "study"),
          text(record, place, "knob"),
          number(record, place, "knob_value"),
          stop_of(stored.stop)};
}

// Null where the file is no JSON. Throws RecordError where it cannot be read.
Json json_of_file(const std::filesystem::path& file) {
  try {
    return parse_json(text_of_records(file));
  } catch (const Json::exception&) {
    return {};
  }
}

}  // namespace

std::optional<double> StoredCase::quantity(const std::string& key) const {
  for (const auto& [name, value] : quantities)
    if (name == key) return value;
  return {};
}

StoredCase stored_case(const Json& record, const std::string& place) {
  if (!record.is_object())
    throw RecordError(fmt::format("{}: {} (allowed: a JSON object)", place, json_text(record)));
  StoredCase stored;
  stored.mesh = name(record, place, "mesh");
  stored.scene = name(record, place, "scene");
  stored.stop = text(record, place, "stop");
  if (stored.stop.empty()) stored.stop = "target";  // older records have none
  const CaseName own = case_name(record, place, stored);
  stored.method = own.method + own.suffix();
  stored.status = name(record, place, "status");
  stored.status_reason = text(record, place, "status_reason");
  stored.samples_s = samples(record, place);
  stored.time_s = number(record, place, "time_s");
  stored.time_low_s = number(record, place, "time_low_s");
  stored.time_high_s = number(record, place, "time_high_s");
  if (stored.time_s && !(stored.time_low_s && stored.time_high_s)) {
    const double mad_s = stored.samples_s.empty() ? 0 : median_absolute_deviation(stored.samples_s);
    stored.time_low_s = *stored.time_s - mad_s;
    stored.time_high_s = *stored.time_s + mad_s;
  }
  for (const auto& [key, value] : record.items())
    if (value.is_number() && std::isfinite(value.get<double>()))
      stored.quantities.emplace_back(key, value.get<double>());
  stored.context = context_of(record, place);
  return stored;
}

std::vector<StoredCase> stored_run(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "records.jsonl";
  std::vector<StoredCase> cases;
  for (const Json& record : read_record_lines(folder))
    cases.push_back(stored_case(record, fmt::format("{}:{}", file.string(), cases.size() + 1)));
  return cases;
}

std::vector<StoredCase> stored_history(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "nights", error))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  if (error || files.empty())
    throw RecordError(fmt::format("{}: no *.json in it (a folder that bench track wrote has them)",
                                  (folder / "nights").string()));
  std::sort(files.begin(), files.end());
  std::vector<StoredCase> cases;
  for (const auto& file : files) {
    const std::string place = file.string();
    const Json night = json_of_file(file);
    if (!night.is_object() || value_of(night, "format") != "airybench-night-1")
      throw RecordError(place + ": not a night (allowed: a JSON object, format airybench-night-1)");
    if (!value_of(night, "cases").is_array())
      fail(place, "cases", value_of(night, "cases"), "a list of cases");
    auto context = context_of(night, place);
    context["date"] = name(night, place, "date");
    int k = 0;
    for (const Json& record : night["cases"]) {
      cases.push_back(stored_case(record, fmt::format("{}: cases[{}]", place, k++)));
      cases.back().context = context;
    }
  }
  std::stable_sort(cases.begin(), cases.end(), [](const StoredCase& a, const StoredCase& b) {
    return a.context.at("date") < b.context.at("date");
  });
  return cases;
}

}  // namespace airybench
