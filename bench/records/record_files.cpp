#include "bench/records/record_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bench/records/csv.hpp"
#include "bench/records/google_benchmark.hpp"
#include "support/atomic_file.hpp"

namespace airybench {
namespace {

namespace fs = std::filesystem;

// Called before records change, so that no summary outlives its records.
void remove_summaries(const fs::path& folder) {
  std::error_code ignored;
  for (const char* stale : {"results.csv", "results.json"}) fs::remove(folder / stale, ignored);
}

class Summaries {
 public:
  explicit Summaries(const fs::path& folder)
      : csv_(folder / "results.csv"), google_benchmark_(folder / "results.json") {
    csv_.write(csv_header());
  }
  void add(const Record& record) {
    csv_.write(csv_row(record));
    google_benchmark_.write(runs_.add(record));
  }
  void complete() {
    google_benchmark_.write(runs_.end());
    csv_.complete();
    google_benchmark_.complete();
  }
  void take_place() {
    csv_.take_place();
    google_benchmark_.take_place();
  }

 private:
  NewFile csv_, google_benchmark_;
  GoogleBenchmarkJson runs_;
};

void check_files(const fs::path& folder) {
  for (const char* name : {"records.jsonl", "results.csv", "results.json"})
    check_can_write(folder / name);
  std::error_code error;
  if (const auto packed = folder / "records.jsonl.gz"; fs::exists(packed, error))
    throw FileError(packed.string() +
                    ": packed records are only read (allowed: another folder, or gunzip before)");
  if (fs::exists(folder / "records.jsonl", error)) return;
  for (const char* name : {"results.csv", "results.json"})
    if (fs::exists(folder / name, error))
      throw FileError((folder / name).string() +
                      ": is of no records.jsonl there (allowed: another folder)");
}

fs::path folder_for_records(const fs::path& folder) {
  make_folder(folder);
  check_files(folder);
  return folder;
}

}  // namespace

void check_takes_records(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  check_files(folder);
  const FolderLock lock(folder);
}

void write_records(const fs::path& folder, const std::vector<RecordLine>& lines) {
  const FolderLock lock(folder_for_records(folder));
  remove_leftovers(folder);
  NewFile records(folder / "records.jsonl");
  Summaries summaries(folder);
  for (const RecordLine& line : lines) {
    records.write(json_text(line.json) + "\n");
    summaries.add(line.record);
  }
  records.complete();
  summaries.complete();
  remove_summaries(folder);
  records.take_place();
  summaries.take_place();
}

RecordFiles::RecordFiles(const fs::path& folder, Context context, Keep keep)
    : folder_(folder_for_records(folder)),
      lock_(folder_),
      context_(std::move(context)),
      keep_(keep) {
  for (const char* part : {"", "fields", "programs"}) remove_leftovers(folder_ / part);
  if (keep_ == Keep::none || !fs::exists(records_file())) return;
  torn_ = ends_torn_ = read_lines(records_file(), [&](const std::string& text, const Line& line) {
    const std::string place = place_of(records_file(), line);
    const Record record = record_of_text(text, place);
    const std::string differs = keep_ == Keep::finished
                                    ? differences(record.context, context_, Sameness::same_program)
                                    : "";
    if (!differs.empty())
      throw FileError(
          fmt::format("{}: of another run, which does not mix with this one: {}", place, differs));
    lines_.emplace(name_of(record).text(), line);
  });
  journal_ = Journal(records_file(), static_cast<std::int64_t>(fs::file_size(records_file())));
}

Record RecordFiles::read(const Line& line) const {
  return record_of_text(journal_.text_of(line), place_of(records_file(), line));
}

Record RecordFiles::read(const std::string& case_name) const {
  return read(lines_.lower_bound(case_name)->second);
}

std::optional<Record> RecordFiles::finished(const Record& blank) const {
  if (keep_ != Keep::finished) return {};
  const std::string name = name_of(blank).text();
  const auto [first, end] = lines_.equal_range(name);
  for (auto found = first; found != end; ++found) {
    Record record = read(found->second);
    if (record.status == Status::machine_fault) continue;
    for (const char* key : {"mesh_sha256", "scene_definition", "program"})
      if (field_named(key).value(record) != field_named(key).value(blank))
        throw FileError(fmt::format("{}: {}: another than now, for {}",
                                    place_of(records_file(), found->second), key, name));
    return record;
  }
  return {};
}

std::vector<std::pair<Line, std::string>> RecordFiles::lines_in_order() const {
  std::vector<std::pair<Line, std::string>> order;
  for (const auto& [name, line] : lines_) order.emplace_back(line, name);
  std::ranges::sort(order, {}, [](const auto& line) { return line.first.begin; });
  return order;
}

void RecordFiles::rewrite_with(const std::string& case_name, const std::string& text) {
  NewFile next(records_file());
  std::multimap<std::string, Line> moved;
  Line line;
  const auto add = [&](const std::string& name, const std::string& added) {
    next.write(added + "\n");
    line = {line.begin, std::ssize(added), line.number + 1};
    moved.emplace(name, line);
    line.begin += line.size + 1;
  };
  for (const auto& [there, name] : lines_in_order())
    if (name != case_name) add(name, journal_.text_of(there));
  add(case_name, text);
  next.complete();
  remove_summaries(folder_);
  next.take_place();
  lines_ = std::move(moved);
  ends_torn_ = false;
  journal_ = Journal(records_file(), line.begin);
}

Record RecordFiles::append(Record record) {
  record.context = context_;
  const Json json = to_json(record);
  record = record_of(json, "its record");
  const std::string name = name_of(record).text(), text = json_text(json);
  if (text.size() > longest_line)
    throw RecordError(fmt::format("its record has {} MiB (allowed: up to {}); fewer repetitions?",
                                  text.size() >> 20, longest_line >> 20));
  if (!journal_.is_open() || ends_torn_ || lines_.contains(name)) {
    rewrite_with(name, text);
  } else {
    remove_summaries(folder_);
    const std::int64_t begin = journal_.append(text);
    lines_.emplace(name, Line{begin, std::ssize(text), std::ssize(lines_) + 1});
  }
  return record;
}

void RecordFiles::finish() {
  if (journal_.is_open()) {  // else an earlier run's files stay
    Summaries summaries(folder_);
    for (const auto& [line, name] : lines_in_order()) summaries.add(read(line));
    summaries.complete();
    summaries.take_place();
  }
  lock_.reset();
}

}  // namespace airybench
