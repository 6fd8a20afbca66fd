#include <stdexcept>

#include "bench/records/csv.hpp"
#include "bench/records/google_benchmark.hpp"
#include "bench/records/journal.hpp"
#include "bench/records/record.hpp"
#include "bench/records/summary.hpp"
#include "tests/fuzz/readers.hpp"

namespace airybench::fuzz {

// What is taken can be written in every form, too.
void record(const std::string& text) {
  std::vector<Record> records;
  LineSplitter lines("fuzz.jsonl", [&](const std::string& line, const Line&) {
    records.push_back(record_of(json_of_text(line, "fuzz.jsonl"), "fuzz.jsonl"));
    const Json json = to_json(records.back());
    const std::string written = json_text(json);
    for (const Record& again :
         {record_of(parse_json(written), "written"), record_of_text(written, "written")})
      if (to_json(again) != json) throw std::logic_error("written and read: another record");
  });
  lines.add(text);
  for (const Record& record : records) csv_row(record);
  google_benchmark_json(records);
  for (Record& record : records) summarise(record);
}

}  // namespace airybench::fuzz
