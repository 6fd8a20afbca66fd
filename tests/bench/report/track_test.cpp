#include "bench/report/track.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/contains.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/test_folder.hpp"

namespace airybench::track_test {
namespace {

Record record(const std::string& method, double time_s) {
  Record result;
  result.mesh = "Mesh0";
  result.scene = "default";
  result.method = method;
  result.status = Status::ok;
  result.samples_s = {time_s, time_s * 1.01, time_s * 0.99};
  result.time_s = time_s;
  result.linear_iterations = 100;
  result.heap_allocations = 50;
  result.peak_heap_bytes = 1000000;
  result.error_force = 1e-7;
  result.answer_hash = "abc";
  result.noise_kernel_s = 0.1;
  return result;
}

TrackedRun run_of(int day, std::vector<Record> cases) {
  for (Record& one : cases)
    one.context = {{"cpu", "C"},
                   {"cpus", "2"},
                   {"threads", "1"},
                   {"compiler", "GNU 12"},
                   {"date", fmt::format("2026-{:02}-{:02}T03:00:00Z", 1 + day / 28, 1 + day % 28)}};
  return tracked_run_of(std::move(cases), "records");
}

// A history of these runs, of which each has been tracked.
std::vector<TrackedRun> tracked(const std::vector<TrackedRun>& runs) {
  std::vector<TrackedRun> history;
  for (const TrackedRun& run : runs) {
    history.push_back(run);
    track_newest(history, {});
  }
  return history;
}

TEST(Track, EveryWorseningCountsAtOnce) {
  struct Change {
    void (*change)(Record& record);
    const char* quantity = nullptr;  // of the finding; none where there is none
    Lane lane = Lane::status;
    Kind kind = Kind::changed;
  };
  using enum Lane;
  using enum Kind;
  for (const auto& [change, quantity, lane, kind] :
       {Change{[](Record&) {}},
        Change{[](Record& r) { r.status = Status::timeout; }, "status", status, worse},
        Change{[](Record& r) { r.linear_iterations = 101; }, "linear_iterations", counters, worse},
        Change{[](Record& r) { r.linear_iterations = 99; }, "linear_iterations", counters, better},
        Change{[](Record& r) { r.linear_iterations.reset(); }},
        Change{[](Record& r) { r.heap_allocations = 51; }, "heap_allocations", counters, worse},
        Change{[](Record& r) { r.peak_heap_bytes = 1000900; }},  // blocks are rounded up
        Change{[](Record& r) { r.peak_heap_bytes = 1001100; }, "peak_heap_bytes", counters, worse},
        Change{[](Record& r) { r.error_force = 1.02e-7; }, "error_force", errors, worse},
        Change{[](Record& r) { r.error_force = 1.009e-7; }},
        Change{[](Record& r) { r.error_force = 0.9e-7; }, "error_force", errors, better},
        Change{[](Record& r) { r.error_stress = 9e-12; }},
        Change{[](Record& r) { r.answer_hash = "abd"; }, "answer_hash", errors, changed}}) {
    Record now = record("ALM", 1);
    change(now);
    const TrackedRun run = tracked({run_of(0, {record("ALM", 1)}), run_of(1, {now})}).back();
    ASSERT_EQ(run.findings.size(), quantity == nullptr ? 0u : 1u) << to_json(now);
    EXPECT_EQ(run.failed, kind == worse);
    if (quantity == nullptr) continue;
    EXPECT_EQ(run.findings[0].case_name, "Mesh0/default/ALM");
    EXPECT_EQ(run.findings[0].quantity, quantity);
    EXPECT_EQ(run.findings[0].lane, lane) << quantity;
    EXPECT_EQ(run.findings[0].kind, kind) << quantity;
  }
}

// Counts of a run that was stopped are lower bounds.
TEST(Track, ANightThatEndedEarlyIsNoMeasureForTheNext) {
  Record stopped = record("ALM", 1);
  stopped.status = Status::timeout;
  stopped.peak_heap_bytes = 500000;
  const std::vector<TrackedRun> history =
      tracked({run_of(0, {record("ALM", 1)}), run_of(1, {stopped}), run_of(2, {record("ALM", 1)})});
  for (const std::size_t night : {1U, 2U}) {
    ASSERT_EQ(history[night].findings.size(), 1u);
    EXPECT_EQ(history[night].findings[0].quantity, "status");
  }
  EXPECT_FALSE(history[2].failed);
}

TEST(Track, ErrorsAtRoundingMayGrow) {
  const auto has_grown = [](double before, double after) {
    return grew(field_named("error_force"), before, after);
  };
  EXPECT_FALSE(has_grown(1e-12, 9e-12));
  EXPECT_TRUE(has_grown(1e-12, 2e-11));
  EXPECT_FALSE(has_grown(1e-3, 1.005e-3));
}

TEST(Track, HeapFiguresStartAgainWithOtherLibraries) {
  Record more = record("ALM", 1);
  more.heap_allocations = 500;
  std::vector<TrackedRun> runs = {run_of(0, {record("ALM", 1)}), run_of(1, {more})};
  runs[1].context["compiler"] = "GNU 14";
  const std::vector<Finding> findings = tracked(runs).back().findings;
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, Kind::changed);
  EXPECT_TRUE(testing::contains(findings[0].sentence, "new baseline"));
  EXPECT_TRUE(testing::contains(findings[0].sentence, "GNU 12 → GNU 14"));
}

TEST(Track, AnotherTargetErrorIsNamedFirst) {
  Record more = record("ALM", 1);
  more.linear_iterations = 200;
  std::vector<TrackedRun> runs = {run_of(0, {record("ALM", 1)}), run_of(1, {more})};
  runs[0].context["target_error"] = "1e-06";
  runs[1].context["target_error"] = "1e-09";
  const std::vector<Finding> findings = tracked(runs).back().findings;
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_EQ(findings[0].kind, Kind::changed);
  EXPECT_TRUE(testing::contains(findings[0].sentence, "target_error was 1e-06 and is 1e-09"));
  EXPECT_EQ(findings[1].kind, Kind::worse);
}

TEST(Track, AnotherMachineIsNotCompared) {
  Record more = record("ALM", 1);
  more.linear_iterations = 500;
  std::vector<TrackedRun> runs = {run_of(0, {record("ALM", 1)}), run_of(1, {more})};
  runs[1].context["cpu"] = "D";
  const TrackedRun run = tracked(runs).back();
  EXPECT_TRUE(run.findings.empty());
  EXPECT_FALSE(run.failed);
}

TEST(Track, ACaseThatIsLeftOutIsNamed) {
  Record back = record("P2", 1);  // compared with the last run that has it
  back.linear_iterations = 101;
  const std::vector<TrackedRun> history =
      tracked({run_of(0, {record("ALM", 1), record("P2", 1)}), run_of(1, {record("ALM", 1)}),
               run_of(2, {record("ALM", 1), back})});
  ASSERT_EQ(history[1].findings.size(), 1u);
  EXPECT_EQ(history[1].findings[0].after, "not run");
  EXPECT_FALSE(history[1].failed);
  ASSERT_EQ(history[2].findings.size(), 1u);
  EXPECT_TRUE(history[2].failed);
}

TEST(Track, ASlowdownIsReportedOnceWithItsFirstRun) {
  testing::Dice dice(1);
  std::vector<TrackedRun> runs;
  for (int day = 0; day < 40; ++day) {
    std::vector<Record> cases;
    for (int c = 0; c < 8; ++c)
      cases.push_back(record(fmt::format("M{}", c),
                             (c == 3 && day >= 25 ? 1.2 : 1) * dice.between(0.98, 1.02)));
    runs.push_back(run_of(day, cases));
  }
  int reports = 0;
  for (const TrackedRun& run : tracked(runs)) {
    for (const Finding& finding : run.findings) {
      ++reports;
      EXPECT_EQ(finding.case_name, "Mesh0/default/M3");
      EXPECT_EQ(finding.lane, Lane::times);
      EXPECT_EQ(finding.since, runs[25].date);
      EXPECT_NEAR(*finding.ratio, 1.2, 0.02);
      EXPECT_NEAR(finding.after.get<double>() / finding.before.get<double>(), 1.2, 0.03);
    }
    EXPECT_EQ(run.failed, !run.findings.empty());
  }
  EXPECT_EQ(reports, 1);
}

// A program that takes four times as long next to 1 s of ours: the sum scatters by more. Ten nights
// before programs' own times were kept are no faster than those after.
TEST(Track, OfAProgramItsOwnSolveIsJudged) {
  testing::Dice dice(1);
  std::vector<TrackedRun> runs;
  for (int day = 0; day < 40; ++day) {
    const double own_s = (day >= 25 ? 0.004 : 0.001) * dice.between(0.98, 1.02);
    Record mine = record("EXTERNAL:mine", own_s + dice.between(0.98, 1.02));
    mine.program = "1.0";
    if (day >= 10) mine.program_solve_s = own_s;
    runs.push_back(run_of(day, {mine, record("ALM", dice.between(0.98, 1.02))}));
  }
  int reports = 0;
  for (const TrackedRun& run : tracked(runs))
    for (const Finding& finding : run.findings) {
      ++reports;
      EXPECT_EQ(finding.quantity, "program_solve_s");
      EXPECT_EQ(finding.since, runs[25].date);
      EXPECT_NEAR(*finding.ratio, 4, 0.2);
      EXPECT_TRUE(testing::contains(finding.sentence,
                                    "EXTERNAL:mine: the program's own solve is slower since"));
    }
  EXPECT_EQ(reports, 1);
}

TEST(History, IsReadAsItWasWritten) {
  const testing::TemporaryFolder folder;
  EXPECT_TRUE(read_history(folder / "none").empty());
  Record more = record("ALM", 2);
  more.linear_iterations = 300;
  std::vector<TrackedRun> history = tracked({run_of(0, {record("ALM", 1)}), run_of(1, {more})});
  for (TrackedRun& one : history) {
    one.file = file_for(one, folder.path(), {});
    write_tracked_run(one);
  }
  EXPECT_EQ(history[0].file.filename(), "2026-01-01T030000Z.json");
  const std::vector<TrackedRun> read = read_history(folder.path());
  ASSERT_EQ(read.size(), 2u);
  EXPECT_TRUE(read[1].failed);
  ASSERT_EQ(read[1].findings.size(), 1u);
  EXPECT_EQ(read[1].findings[0].before, 100);
  EXPECT_EQ(read[1].noise_samples_s, std::vector<double>{0.1});
  write_tracked_run(read[1]);  // nothing is lost on the way
  EXPECT_EQ(testing::text_of(read[1].file), testing::text_of(history[1].file));
}

TEST(History, TwoRunsOfOneSecondAreBothKeptAndOneIsNotTwice) {
  const testing::TemporaryFolder folder;
  TrackedRun first = run_of(0, {record("ALM", 1)}), second = run_of(0, {record("ALM", 2)});
  first.file = file_for(first, folder.path(), {});
  second.file = file_for(second, folder.path(), {first});
  EXPECT_EQ(second.file.filename(), "2026-01-01T030000Z-2.json");
  EXPECT_THROW(file_for(first, folder.path(), {first, second}), FileError);
}

}  // namespace
}  // namespace airybench::track_test
