#include "bench/records/record_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "assembly/atomic_file.hpp"

namespace airybench {

std::string csv_field(const nlohmann::ordered_json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return value.dump();
  std::string text = value.get<std::string>();
  if (text.find_first_of(",\"\r\n") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_text(const std::vector<nlohmann::ordered_json>& records) {
  const Columns header = columns(Record{});
  std::string text;
  for (std::size_t i = 0; i < header.size(); ++i) text += (i > 0 ? "," : "") + header[i].first;
  text += "\n";
  for (const auto& record : records) {
    for (std::size_t i = 0; i < header.size(); ++i) {
      const auto value = record.find(header[i].first);
      if (i > 0) text += ',';
      if (value != record.end()) text += csv_field(*value);
    }
    text += "\n";
  }
  return text;
}

namespace {

// What makes a case.
constexpr std::array<const char*, 4> case_keys = {"mesh", "scene", "method", "stop"};
constexpr std::array<const char*, 3> study_keys = {"study", "knob", "knob_value"};

// What is not UTF-8, in a file's name say, is replaced.
std::string line_of(const nlohmann::ordered_json& record) {
  return record.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

bool same_case(const nlohmann::ordered_json& a, const nlohmann::ordered_json& b) {
  const auto value = [](const nlohmann::ordered_json& record, const char* key) {
    const auto found = record.find(key);
    return found == record.end() ? nlohmann::ordered_json() : *found;
  };
  return std::all_of(case_keys.begin(), case_keys.end(),
                     [&](const char* key) {
                       return a.value(key, "target") ==
                              b.value(key, "target");  // older records have no stop
                     }) &&
         std::all_of(study_keys.begin(), study_keys.end(),
                     [&](const char* key) { return value(a, key) == value(b, key); });
}

}  // namespace

std::vector<nlohmann::ordered_json> stored_records(const std::filesystem::path& path) {
  std::vector<nlohmann::ordered_json> records;
  std::error_code error;
  if (!std::filesystem::exists(path, error) && !error) return records;
  std::ifstream file(path);
  if (error || !file.is_open() || std::filesystem::is_directory(path))
    throw OutputError(path.string() + ": cannot be read");
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const auto record = nlohmann::ordered_json::parse(line, nullptr, false);
    if (!record.is_object())
      throw OutputError(fmt::format("{}:{}: not a record (allowed: a JSON object on a line)",
                                    path.string(), number));
    for (const char* key : case_keys)
      if (record.contains(key) ? !record[key].is_string() : key != std::string_view("stop"))
        throw OutputError(fmt::format("{}:{}: {}: not a text", path.string(), number, key));
    records.push_back(record);
  }
  return records;
}

RecordFiles::RecordFiles(std::filesystem::path folder, std::map<std::string, std::string> context,
                         bool keep_others)
    : folder_(std::move(folder)), context_(std::move(context)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error)
    throw OutputError(
        fmt::format("{}: cannot be made a folder: {}", folder_.string(), error.message()));
  if (keep_others) records_ = stored_records(folder_ / "records.jsonl");
}

void RecordFiles::append(const Record& record) {
  nlohmann::ordered_json json = to_json(record);
  json["context"] = context_;
  const auto replaced = std::erase_if(
      records_, [&](const nlohmann::ordered_json& other) { return same_case(other, json); });
  const std::filesystem::path path = folder_ / "records.jsonl";
  if (!lines_.is_open() || replaced > 0) {
    std::string text;
    for (const auto& other : records_) text += line_of(other);
    lines_.close();
    write_file_atomically(path, text);
    std::error_code ignored;
    for (const char* stale : {"results.csv", "results.json"})
      std::filesystem::remove(folder_ / stale, ignored);
    lines_.open(path, std::ios::binary | std::ios::app);
  }
  lines_ << line_of(json) << std::flush;
  if (!lines_) throw OutputError(path.string() + ": cannot be written");
  records_.push_back(std::move(json));
}

void RecordFiles::finish() const {
  write_file_atomically(folder_ / "results.csv", csv_text(records_));
  const std::filesystem::path part = benchmark_json_part(folder_), whole = folder_ / "results.json";
  std::ostringstream written;
  written << std::ifstream(part).rdbuf();
  // The coefficient of variation of a counter that is zero: "NaN" is not JSON.
  std::string text = written.str();
  for (const std::string nan : {": NaN", ": -NaN", ": nan", ": -nan"})
    for (std::size_t at = text.find(nan); at != text.npos; at = text.find(nan, at))
      text.replace(at, nan.size(), ": null");
  if (!nlohmann::json::accept(text))  // Google Benchmark does not say when the disk is full
    throw OutputError(whole.string() + ": could not be written whole");
  write_file_atomically(whole, text);
  abandon();
}

void RecordFiles::abandon() const {
  std::error_code ignored;
  std::filesystem::remove(benchmark_json_part(folder_), ignored);
}

std::filesystem::path RecordFiles::benchmark_json_part(const std::filesystem::path& folder) {
  return folder / "results.json.part";
}

}  // namespace airybench
