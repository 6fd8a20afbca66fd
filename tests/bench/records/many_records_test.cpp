// A run's memory does not grow with what its records say.
#include <gtest/gtest.h>

#include "bench/measure/heap_probe.hpp"
#include "bench/records/record_files.hpp"
#include "bench/report/results_table.hpp"
#include "bench/run/noise_watch.hpp"
#include "tests/support/test_folder.hpp"

namespace airybench::many_records_test {
namespace {

Record large_record(int number) {
  Record record;
  record.mesh = "Mesh" + std::to_string(number);
  record.scene = "default";
  record.method = record.general_name = "3STEPCG:DTIC5";
  record.family = "3STEPCG";
  record.status = Status::ok;
  record.status_reason = "the same on every mesh";
  record.case_number = number;
  record.samples_s.assign(30, 0.1);
  record.noise_kernel_samples_s.assign(12, 0.01);
  record.stage_samples.assign(30, {{"factor", 0.01}, {"order", 0.02}});
  record.retry_noisy = record.noise_share = record.noise_quiet_s = 0.01;
  record.time_s = 0.1;
  return record;
}

Context context() {
  Context context;
  for (int word = 0; word < 50; ++word)
    context["what the machine is, " + std::to_string(word)] = "and its value";
  return context;
}

TEST(ManyRecords, TakeTwoKilobytesEachAtMost) {
  if (!heap::is_active()) return;  // sanitizers count for themselves
  constexpr int before = 9'900, added = 100;
  constexpr std::int64_t max_bytes_each = 2000;
  const testing::TemporaryFolder scratch;
  const std::filesystem::path folder = scratch / "o";
  std::filesystem::create_directory(folder);
  {
    std::ofstream lines(folder / "records.jsonl");
    for (int number = 1; number <= before; ++number) {
      Record record = large_record(number);
      record.context = context();
      lines << json_text(to_json(record)) << '\n';
    }
  }
  const std::int64_t at_start = heap::live_bytes();
  heap::reset_peak();
  RecordFiles files(folder, context(), Keep::finished);
  for (int number = before + 1; number <= before + added; ++number)
    files.append(large_record(number));
  files.finish();
  ResultsTable table;
  EarlyPasses early;
  for (int number = 1; number <= before + added; ++number) {
    const Record record = files.read(name_of(large_record(number)).text());
    EXPECT_EQ(record.case_number, number);
    table.add(record);
    early.add(record);
  }
  EXPECT_GT(table.text().size(), 50u * (before + added));
  EXPECT_EQ(early.count(), 0);
  const std::int64_t bytes_each = (heap::peak_bytes() - at_start) / (before + added);
  EXPECT_LT(bytes_each, max_bytes_each);
  std::cout << bytes_each << " bytes per record\n";
}

}  // namespace
}  // namespace airybench::many_records_test
