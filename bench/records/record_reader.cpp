#include "bench/records/record_reader.hpp"

#include <fmt/format.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

namespace airybench {
namespace {

using Json = nlohmann::json;

class Line {
 public:
  Line(const std::string& file, int number, const std::string& text)
      : place_(fmt::format("{}:{}", file, number)) {
    try {
      json_ = Json::parse(text);
    } catch (const Json::exception& wrong) {
      const std::string what = wrong.what();  // "[json.exception.parse_error.101] parse error at …"
      throw RecordError(fmt::format("{}: not JSON: {}", place_, what.substr(what.find("] ") + 2)));
    }
    if (!json_.is_object())
      throw RecordError(fmt::format("{}: {} (allowed: a JSON object)", place_, json_.dump()));
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
  // Null and a missing key are the same: does not apply.
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
  std::optional<std::int64_t> whole(const char* key, int power_of_two) const {
    const Json& value = this->value(key);
    if (value.is_null()) return {};
    if (!value.is_number_integer() || value < 0 || value > std::int64_t{1} << power_of_two)
      fail(key, value, fmt::format("a whole number from 0 to 2^{}, null", power_of_two));
    return value.get<std::int64_t>();
  }
  std::optional<std::int64_t> bytes(const char* key) const { return whole(key, 60); }
  std::string text(const char* key) const {  // empty: null or missing
    const Json& value = this->value(key);
    if (value.is_null()) return "";
    if (!value.is_string()) fail(key, value, "a text, null");
    return value.get<std::string>();
  }
  std::string date() const {
    const Json& context = value("context");
    if (context.is_null()) return "";
    if (!context.is_object()) fail("context", context, "a JSON object, null");
    const auto found = context.find("date");
    if (found == context.end()) return "";
    if (!found->is_string()) fail("context: date", *found, "a text");
    return found->get<std::string>();
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
    throw RecordError(fmt::format("{}: {}: {} (allowed: {})", place_, key, value.dump(), allowed));
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  std::string place_;
  Json json_;
};

CaseRecord from(const Line& line) {
  CaseRecord record;
  record.mesh = line.name("mesh");
  record.scene = line.name("scene");
  record.method = line.name("method");
  record.status = line.status();
  record.stop = line.stop();
  record.samples_s = line.times("samples_s");
  record.time_s = line.time("time_s");
  record.tuning_s = line.number("tuning_s", std::numeric_limits<double>::infinity());
  record.stage_contact_s = line.number("stage_contact_s", std::numeric_limits<double>::infinity());
  record.peak_heap_bytes = line.bytes("peak_heap_bytes");
  record.storage_bytes = line.bytes("storage_bytes");
  record.done_fraction = line.number("done_fraction", 1);
  record.extrapolated_time_s = line.time("extrapolated_time_s");
  record.n_phi = static_cast<int>(line.whole("n_phi", 30).value_or(0));
  record.study = line.text("study");
  record.knob = line.text("knob");
  record.knob_value = line.number("knob_value", std::numeric_limits<double>::infinity());
  record.date = line.date();
  return record;
}

}  // namespace

std::vector<CaseRecord> read_records(const std::filesystem::path& file, StudyRecords of_studies) {
  std::error_code error;
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file, error))
    throw RecordError(file.string() + ": cannot be opened as a file of records");
  std::vector<CaseRecord> records;
  int number = 0;
  for (std::string text; std::getline(in, text);) {
    const Line line(file.string(), ++number, text);
    CaseRecord record = from(line);
    if (of_studies == StudyRecords::kept || record.study.empty())
      records.push_back(std::move(record));
  }
  if (in.bad()) throw RecordError(file.string() + ": cannot be read");
  return records;
}

}  // namespace airybench
