#include "bench/records/record_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "bench/exports/google_benchmark.hpp"
#include "bench/records/json.hpp"
#include "bench/records/record_json.hpp"
#include "bench/records/record_reader.hpp"
#include "support/atomic_file.hpp"

namespace airybench {

std::string csv_field(const Json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return json_text(value);
  std::string text = value.get<std::string>();
  if (text.find_first_of(",\"\r\n") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_text(const std::vector<Json>& records) {
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

std::string identity_of(const Json& record) {
  std::string identity;
  for (const char* key : case_keys) {
    identity += record.value(key, "target");  // older records have no stop
    identity += '\n';
  }
  for (const char* key : study_keys) {
    const auto found = record.find(key);
    identity += found == record.end() ? "null" : json_text(*found);
    identity += '\n';
  }
  return identity;
}

std::string lines_of(const std::vector<Json>& records) {
  std::string text;
  for (const auto& record : records) {
    text += json_text(record);
    text += '\n';
  }
  return text;
}

// To keep a folder's files in step, what belongs to other records goes first.
void remove_summaries(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (const char* stale : {"results.csv", "results.json"})
    std::filesystem::remove(folder / stale, ignored);
}

void write_summaries(const std::filesystem::path& folder, const std::vector<Json>& records) {
  write_file_atomically(folder / "results.csv", csv_text(records));
  write_file_atomically(folder / "results.json", google_benchmark_json(records));
}

Json parsed(const std::string& line, const std::string& place) {
  Json record;
  try {
    record = parse_json(line);
  } catch (const Json::exception&) {  // is no object, then
  }
  if (!record.is_object())
    throw OutputError(fmt::format("{}: not a record (allowed: a JSON object on a line)", place));
  for (const char* key : case_keys)
    if (record.contains(key) ? !record[key].is_string() : key != std::string_view("stop"))
      throw OutputError(fmt::format("{}: {}: not a text", place, key));
  return record;
}

std::vector<Json> parsed(const JournalLines& journal, const std::filesystem::path& file) {
  std::vector<Json> records;
  for (const std::string& line : journal.lines)
    records.push_back(parsed(line, fmt::format("{}:{}", file.string(), records.size() + 1)));
  return records;
}

}  // namespace

std::vector<Json> read_record_lines(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "records.jsonl";
  if (!std::filesystem::exists(file))
    throw OutputError(file.string() + ": no such file (a folder that bench --out wrote has it)");
  return parsed(read_journal(file), file);
}

Context context_of(const Json& record) {
  Context context;
  if (const auto found = record.find("context"); found != record.end() && found->is_object())
    for (const auto& [key, value] : found->items())
      context[key] = value.is_string() ? value.get<std::string>() : json_text(value);
  return context;
}

bool same_case(const Json& a, const Json& b) { return identity_of(a) == identity_of(b); }

std::string case_name(const Json& record) { return case_record(record, "record").name(); }

void write_records(const std::filesystem::path& folder, const std::vector<Json>& records) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw OutputError(
        fmt::format("{}: cannot be made a folder: {}", folder.string(), error.message()));
  remove_summaries(folder);
  write_file_atomically(folder / "records.jsonl", lines_of(records));
  write_summaries(folder, records);
}

RecordFiles::RecordFiles(std::filesystem::path folder, Context context, Keep keep)
    : folder_(std::move(folder)), context_(std::move(context)), keep_(keep) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error)
    throw OutputError(
        fmt::format("{}: cannot be made a folder: {}", folder_.string(), error.message()));
  for (const char* name : {"records.jsonl", "results.csv", "results.json"})
    if (std::filesystem::is_directory(folder_ / name))
      throw OutputError(fmt::format("{}: is a folder", (folder_ / name).string()));
  if (keep_ == Keep::none) return;
  const JournalLines journal = read_journal(records_file());
  records_ = parsed(journal, records_file());
  torn_ = journal.torn;
  if (keep_ == Keep::finished)
    for (std::size_t i = 0; i < records_.size(); ++i) {
      const std::string differs =
          differences(context_of(records_[i]), context_, Sameness::same_program);
      if (!differs.empty())
        throw OutputError(fmt::format("{}:{}: of another run, which does not mix with this one: {}",
                                      records_file().string(), i + 1, differs));
      finished_.emplace(identity_of(records_[i]), i);
    }
  if (torn_) rewrite();
}

std::optional<Record> RecordFiles::finished(const Record& blank) const {
  if (keep_ != Keep::finished) return {};
  const Json wanted = to_json(blank);
  const auto found = finished_.find(identity_of(wanted));
  if (found == finished_.end()) return {};
  const Json& record = records_[found->second];
  for (const char* key : {"mesh_sha256", "scene_definition"})
    if (record.value(key, Json()) != wanted[key])
      throw OutputError(fmt::format("{}:{}: {}: another than now, for {}", records_file().string(),
                                    found->second + 1, key, case_name(wanted)));
  return record_from_json(record);
}

void RecordFiles::rewrite() {
  journal_ = Journal();
  remove_summaries(folder_);
  write_file_atomically(records_file(), lines_of(records_));
  journal_ = Journal(records_file());
}

void RecordFiles::append(const Record& record) {
  Json json = to_json(record);
  json["context"] = context_;
  const auto replaced =
      std::erase_if(records_, [&](const Json& other) { return same_case(other, json); });
  if (!journal_.is_open() || replaced > 0) rewrite();
  journal_.append(json_text(json));
  records_.push_back(std::move(json));
}

void RecordFiles::finish() const {
  if (keep_ == Keep::none && records_.empty()) return;  // an earlier run's files stay
  write_summaries(folder_, records_);
}

}  // namespace airybench
