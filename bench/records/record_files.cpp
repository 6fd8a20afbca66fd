#include "bench/records/record_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bench/records/csv.hpp"
#include "bench/records/google_benchmark.hpp"
#include "support/atomic_file.hpp"

namespace airybench {
namespace {

std::string text_of(const std::vector<RecordLine>& lines) {
  std::string text;
  for (const RecordLine& line : lines) text += json_text(line.json) + "\n";
  return text;
}

// Called before records change, so that no summary outlives its records.
void remove_summaries(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (const char* stale : {"results.csv", "results.json"})
    std::filesystem::remove(folder / stale, ignored);
}

struct Summaries {
  std::string csv, google_benchmark;
};
Summaries summaries_of(const std::vector<RecordLine>& lines) {
  std::vector<Record> records;
  for (const RecordLine& line : lines) records.push_back(line.record);
  return {csv_text(records), google_benchmark_json(records)};
}

void write(const Summaries& summaries, const std::filesystem::path& folder) {
  write_file_atomically(folder / "results.csv", summaries.csv);
  write_file_atomically(folder / "results.json", summaries.google_benchmark);
}

std::filesystem::path folder_for_records(const std::filesystem::path& folder) {
  make_folder(folder);
  for (const char* name : {"records.jsonl", "results.csv", "results.json"})
    if (const auto file = std::filesystem::status(folder / name);
        std::filesystem::exists(file) && !std::filesystem::is_regular_file(file))
      throw FileError(
          fmt::format("{}: is no regular file (allowed: one, or a name that is not there)",
                      (folder / name).string()));
  if (const auto packed = folder / "records.jsonl.gz"; std::filesystem::exists(packed))
    throw FileError(packed.string() +
                    ": packed records are only read (allowed: another folder, or gunzip before)");
  return folder;
}

}  // namespace

void write_records(const std::filesystem::path& folder, const std::vector<RecordLine>& lines) {
  const Summaries summaries = summaries_of(lines);
  const FolderLock lock(folder_for_records(folder));
  remove_summaries(folder);
  write_file_atomically(folder / "records.jsonl", text_of(lines));
  write(summaries, folder);
}

RecordFiles::RecordFiles(const std::filesystem::path& folder, Context context, Keep keep)
    : folder_(folder_for_records(folder)),
      lock_(folder_),
      context_(std::move(context)),
      keep_(keep) {
  if (keep_ == Keep::none) return;
  RecordLines there = read_record_lines(records_file());
  lines_ = std::move(there.lines);
  torn_ = there.torn;
  if (keep_ == Keep::finished)
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const RecordLine& line = lines_[i];
      const std::string differs =
          differences(line.record.context, context_, Sameness::same_program);
      if (!differs.empty())
        throw FileError(fmt::format("{}: of another run, which does not mix with this one: {}",
                                    line.place, differs));
      if (line.record.status != Status::machine_fault)
        finished_.emplace(name_of(line.record).text(), i);
    }
  if (torn_) rewrite();
}

std::optional<Record> RecordFiles::finished(const Record& blank) const {
  const std::string name = name_of(blank).text();
  const auto found = finished_.find(name);
  if (found == finished_.end()) return {};
  const RecordLine& line = lines_[found->second];
  for (const char* key : {"mesh_sha256", "scene_definition", "program"})
    if (field_named(key).value(line.record) != field_named(key).value(blank))
      throw FileError(fmt::format("{}: {}: another than now, for {}", line.place, key, name));
  return line.record;
}

void RecordFiles::rewrite() {
  journal_ = Journal();
  remove_summaries(folder_);
  write_file_atomically(records_file(), text_of(lines_));
  journal_ = Journal(records_file());
}

void RecordFiles::append(Record record) {
  record.context = context_;
  const std::string name = name_of(record).text();
  const auto replaced = std::erase_if(
      lines_, [&](const RecordLine& line) { return name_of(line.record).text() == name; });
  if (!journal_.is_open() || replaced > 0) rewrite();
  Json json = to_json(record);
  journal_.append(json_text(json));
  lines_.push_back({"", std::move(json), std::move(record)});
}

void RecordFiles::finish() const {
  if (keep_ == Keep::none && lines_.empty()) return;  // an earlier run's files stay
  write(summaries_of(lines_), folder_);
}

}  // namespace airybench
