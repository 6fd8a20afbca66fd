#include "bench/record_files.hpp"

#include <fmt/format.h>

#include "assembly/atomic_file.hpp"

namespace airybench {
namespace {

std::string csv_field(const nlohmann::json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return value.dump();
  std::string text = value.get<std::string>();
  if (text.find_first_of(",\"\r\n") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

std::string csv_text(const std::vector<Record>& records) {
  std::string text;
  const auto line = [&](const Columns& fields, auto get) {
    for (std::size_t i = 0; i < fields.size(); ++i)
      text += (i > 0 ? "," : "") + csv_field(get(fields[i]));
    text += "\n";
  };
  line(columns(Record{}), [](const auto& field) { return nlohmann::json(field.first); });
  for (const Record& record : records)
    line(columns(record), [](const auto& field) { return field.second; });
  return text;
}

RecordFiles::RecordFiles(std::filesystem::path folder, std::map<std::string, std::string> context)
    : folder_(std::move(folder)), context_(std::move(context)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error)
    throw OutputError(
        fmt::format("{}: cannot be made a folder: {}", folder_.string(), error.message()));
}

void RecordFiles::append(const Record& record) {
  if (!lines_.is_open()) {
    std::error_code ignored;
    for (const char* stale : {"results.csv", "results.json"})
      std::filesystem::remove(folder_ / stale, ignored);
    lines_.open(folder_ / "records.jsonl", std::ios::binary | std::ios::trunc);
  }
  nlohmann::ordered_json json = to_json(record);
  json["context"] = context_;
  lines_ << json.dump() << "\n" << std::flush;
  if (!lines_) throw OutputError((folder_ / "records.jsonl").string() + ": cannot be written");
}

void RecordFiles::finish(const std::vector<Record>& records) const {
  write_file_atomically(folder_ / "results.csv", csv_text(records));
  std::error_code error;
  std::filesystem::rename(benchmark_json_part(folder_), folder_ / "results.json", error);
  if (error)
    throw OutputError(fmt::format("{}: {}", (folder_ / "results.json").string(), error.message()));
}

void RecordFiles::abandon() const {
  std::error_code ignored;
  std::filesystem::remove(benchmark_json_part(folder_), ignored);
}

std::filesystem::path RecordFiles::benchmark_json_part(const std::filesystem::path& folder) {
  return folder / "results.json.part";
}

}  // namespace airybench
