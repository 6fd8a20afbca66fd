#include "bench/records/record_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "bench/records/case_name.hpp"
#include "bench/records/journal.hpp"
#include "bench/records/json.hpp"
#include "support/file_text.hpp"

namespace airybench {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Json parsed_line(const std::string& text, const std::string& place) {
  try {
    return parse_json(text);
  } catch (const Json::exception& wrong) {
    throw RecordError(fmt::format("{}: not JSON: {}", place, without_prefix(wrong)));
  }
}

class Keys {
 public:
  Keys(const Json& json, const std::string& place) : json_(json), place_(place) {
    if (!json_.is_object())
      throw RecordError(fmt::format("{}: {} (allowed: a JSON object)", place_, json_text(json_)));
  }
  std::string name(const char* key) const {
    const Json& value = this->value(key);
    if (!value.is_string() || value.get_ref<const std::string&>().empty())
      fail(key, value, "a text that is not empty");
    return value.get<std::string>();
  }
  Status status() const {
    std::string allowed;
    for (int i = 0; i <= static_cast<int>(Status::skipped); ++i) {
      const auto status = static_cast<Status>(i);
      if (value("status") == name_of(status)) return status;
      allowed += (i > 0 ? ", " : "") + std::string(name_of(status));
    }
    fail("status", value("status"), allowed);
  }
  std::string stop() const {
    const Json& value = this->value("stop");
    if (value.is_null()) return "";
    if (value != "target" && value != "paper") fail("stop", value, "target, paper, null");
    return value.get<std::string>();
  }
  std::string text(const char* key) const {
    const Json& value = this->value(key);
    if (!value.is_null() && !value.is_string()) fail(key, value, "a text, null");
    return value.is_null() ? "" : value.get<std::string>();
  }
  std::map<std::string, std::string> texts(const char* key) const {
    const Json& value = this->value(key);
    if (value.is_null()) return {};
    if (!value.is_object()) fail(key, value, "an object of texts");
    for (const Json& text : value)
      if (!text.is_string()) fail(key, text, "texts");
    return value.get<std::map<std::string, std::string>>();
  }
  std::optional<double> number(const char* key, double most) const {
    const Json& value = this->value(key);
    if (value.is_null()) return {};
    if (!value.is_number() || !(value.get<double>() >= 0 && value.get<double>() <= most))
      fail(key, value,
           most < infinity ? fmt::format("a number from 0 to {}, null", most)
                           : "a number >= 0, null");
    return value.get<double>();
  }
  std::optional<double> time(const char* key) const {
    const std::optional<double> seconds = number(key, infinity);
    if (seconds == 0.0) fail(key, value(key), "a number > 0, null");
    return seconds;
  }
  std::optional<std::int64_t> count(const char* key) const {
    constexpr double most = std::int64_t{1} << 60;
    const Json& value = this->value(key);
    if (value.is_null()) return {};
    const double number = value.is_number() ? value.get<double>() : -1;
    if (!(number >= 0 && number <= most && number == std::floor(number)))
      fail(key, value, "a whole number from 0 to 2^60, null");
    return value.get<std::int64_t>();
  }
  std::vector<double> times(const char* key) const {
    const Json& value = this->value(key);
    if (value.is_null()) return {};
    if (!value.is_array()) fail(key, value, "a list of numbers > 0");
    for (const Json& time : value)
      if (!time.is_number() || !(time.get<double>() > 0)) fail(key, time, "numbers > 0");
    return value.get<std::vector<double>>();
  }

 private:
  const Json& value(const char* key) const {
    static const Json null;
    const auto found = json_.find(key);
    return found == json_.end() ? null : *found;
  }
  [[noreturn]] void fail(const char* key, const Json& value, const std::string& allowed) const {
    throw RecordError(
        fmt::format("{}: {}: {} (allowed: {})", place_, key, json_text(value), allowed));
  }

  const Json& json_;
  const std::string& place_;
};

}  // namespace

std::string CaseRecord::name() const {
  return CaseName{mesh, scene, method, study, knob, knob_value, stop_of(stop)}.text();
}

std::string CaseRecord::date() const {
  const auto found = context.find("date");
  return found == context.end() ? "" : found->second;
}

std::string text_of_records(const std::filesystem::path& file) {
  try {
    return file_text(file);
  } catch (const std::runtime_error& unreadable) {
    throw RecordError(unreadable.what());
  }
}

CaseRecord case_record(const Json& json, const std::string& place) {
  const Keys keys(json, place);
  CaseRecord record;
  record.mesh = keys.name("mesh");
  record.scene = keys.name("scene");
  record.method = keys.name("method");
  record.status = keys.status();
  record.stop = keys.stop();
  record.study = keys.text("study");
  record.knob = keys.text("knob");
  record.knob_value = keys.number("knob_value", infinity);
  record.samples_s = keys.times("samples_s");
  record.time_s = keys.time("time_s");
  record.noise_kernel_s = keys.time("noise_kernel_s");
  record.stage_contact_s = keys.number("stage_contact_s", infinity);
  record.done_fraction = keys.number("done_fraction", 1);
  record.extrapolated_time_s = keys.time("extrapolated_time_s");
  for (const auto& [key, member] : count_members) record.*member = keys.count(key);
  for (const auto& [key, member] : error_members) record.*member = keys.number(key, infinity);
  for (const auto& [key, member] : shown_members) record.*member = keys.number(key, infinity);
  record.answer_hash = keys.text("answer_hash");
  record.context = keys.texts("context");
  return record;
}

std::vector<CaseRecord> read_records(const std::filesystem::path& file, Studies studies) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw RecordError(file.string() + ": cannot be opened as a file of records");
  JournalLines journal;
  try {
    journal = read_journal(file);
  } catch (const OutputError& unreadable) {
    throw RecordError(unreadable.what());
  }
  std::vector<CaseRecord> records;
  int number = 0;
  for (const std::string& text : journal.lines) {
    const std::string place = fmt::format("{}:{}", file.string(), ++number);
    CaseRecord record = case_record(parsed_line(text, place), place);
    if (studies == Studies::include || record.study.empty()) records.push_back(std::move(record));
  }
  return records;
}

bool has_answer(const CaseRecord& record) {
  return record.status == Status::ok || record.status == Status::inaccurate;
}

}  // namespace airybench
