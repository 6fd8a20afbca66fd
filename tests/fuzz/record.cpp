#include <stdexcept>

#include "bench/exports/csv.hpp"
#include "bench/exports/google_benchmark.hpp"
#include "bench/exports/junit.hpp"
#include "bench/records/record_reader.hpp"
#include "bench/records/summary.hpp"
#include "tests/fuzz/readers.hpp"

namespace airybench::fuzz {

// What is taken can be written in every form, too.
void record(const std::string& text) {
  std::vector<Record> records;
  for (RecordLine& line : record_lines_of(text, "fuzz.jsonl").lines) {
    const Json json = to_json(line.record);
    if (to_json(record_of(parse_json(json_text(json)), "written")) != json)
      throw std::logic_error("written and read: another record");
    records.push_back(std::move(line.record));
  }
  csv_text(records);
  google_benchmark_json(records);
  junit_xml(records);
  for (Record& record : records) summarise(record);
}

}  // namespace airybench::fuzz
