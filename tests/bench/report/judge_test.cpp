#include "bench/report/judge.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bench/commands/commands.hpp"
#include "bench/report/judge_counters.hpp"
#include "tests/bench/report/synthetic_history.hpp"
#include "tests/support/temporary_folder.hpp"

namespace airybench::judge_test {
namespace {

namespace fs = std::filesystem;

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

Night night(int day, std::vector<Record> cases) {
  for (Record& one : cases)
    one.context = {{"cpu", "C"},
                   {"cpus", "2"},
                   {"threads", "1"},
                   {"compiler", "GNU 12"},
                   {"date", fmt::format("2026-{:02}-{:02}T03:00:00Z", 1 + day / 28, 1 + day % 28)}};
  return night_of(std::move(cases), "records");
}

// The findings of a second night with this record after a first one with `before`.
std::vector<Finding> after(const Record& before, const Record& now, bool* failed = nullptr) {
  std::vector<Night> history = {night(0, {before}), night(1, {now})};
  judge_newest(history, {});
  if (failed != nullptr) *failed = history.back().failed;
  return history.back().findings;
}

struct Change {
  const char* what;
  void (*change)(Record& record);
  const char* quantity;  // nullptr: no finding
  Lane lane;
  Kind kind;
};
class CounterLane : public ::testing::TestWithParam<Change> {};

TEST_P(CounterLane, Judges) {
  Record now = record("ALM", 1);
  GetParam().change(now);
  bool failed = false;
  const std::vector<Finding> findings = after(record("ALM", 1), now, &failed);
  if (GetParam().quantity == nullptr) {
    EXPECT_TRUE(findings.empty());
    return;
  }
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].case_name, "Mesh0/default/ALM");
  EXPECT_EQ(findings[0].quantity, GetParam().quantity);
  EXPECT_EQ(findings[0].lane, GetParam().lane);
  EXPECT_EQ(findings[0].kind, GetParam().kind);
  EXPECT_EQ(failed, GetParam().kind == Kind::worse);
}

INSTANTIATE_TEST_SUITE_P(
    Changes, CounterLane,
    ::testing::Values(Change{"none", [](Record&) {}, nullptr, Lane::status, Kind::changed},
                      Change{"status", [](Record& r) { r.status = Status::timeout; }, "status",
                             Lane::status, Kind::worse},
                      Change{"more", [](Record& r) { r.linear_iterations = 101; },
                             "linear_iterations", Lane::counters, Kind::worse},
                      Change{"fewer", [](Record& r) { r.linear_iterations = 99; },
                             "linear_iterations", Lane::counters, Kind::better},
                      Change{"allocations", [](Record& r) { r.heap_allocations = 51; },
                             "heap_allocations", Lane::counters, Kind::worse},
                      Change{"rounded_blocks", [](Record& r) { r.peak_heap_bytes = 1000900; },
                             nullptr, Lane::counters, Kind::changed},
                      Change{"heap", [](Record& r) { r.peak_heap_bytes = 1001100; },
                             "peak_heap_bytes", Lane::counters, Kind::worse},
                      Change{"unknown", [](Record& r) { r.linear_iterations.reset(); }, nullptr,
                             Lane::counters, Kind::changed},
                      Change{"error", [](Record& r) { r.error_force = 1.02e-7; }, "error_force",
                             Lane::errors, Kind::worse},
                      Change{"small", [](Record& r) { r.error_force = 1.009e-7; }, nullptr,
                             Lane::errors, Kind::worse},
                      Change{"rounding", [](Record& r) { r.error_stress = 9e-12; }, nullptr,
                             Lane::errors, Kind::worse},
                      Change{"smaller", [](Record& r) { r.error_force = 0.9e-7; }, "error_force",
                             Lane::errors, Kind::better},
                      Change{"answer", [](Record& r) { r.answer_hash = "abd"; }, "answer_hash",
                             Lane::errors, Kind::changed}),
    [](const auto& parameter) { return std::string(parameter.param.what); });

TEST(Judge, ErrorsAtRoundingMayGrow) {
  EXPECT_FALSE(error_grew(1e-12, 9e-12));
  EXPECT_TRUE(error_grew(1e-12, 2e-11));
  EXPECT_FALSE(error_grew(1e-3, 1.005e-3));
}

TEST(Judge, HeapFiguresStartAgainWithOtherLibraries) {
  Record more = record("ALM", 1);
  more.heap_allocations = 500;
  std::vector<Night> history = {night(0, {record("ALM", 1)}), night(1, {more})};
  history[1].context["compiler"] = "GNU 14";
  judge_newest(history, {});
  ASSERT_EQ(history[1].findings.size(), 1u);
  EXPECT_EQ(history[1].findings[0].kind, Kind::changed);
  EXPECT_NE(history[1].findings[0].sentence.find("new baseline"), std::string::npos);
  EXPECT_NE(history[1].findings[0].sentence.find("GNU 12 → GNU 14"), std::string::npos);
}

TEST(Judge, AnotherMachineIsNotCompared) {
  Record more = record("ALM", 1);
  more.linear_iterations = 500;
  std::vector<Night> history = {night(0, {record("ALM", 1)}), night(1, {more})};
  history[1].context["cpu"] = "D";
  judge_newest(history, {});
  EXPECT_TRUE(history[1].findings.empty());
  EXPECT_FALSE(history[1].failed);
}

TEST(Judge, ACaseThatIsLeftOutIsNamed) {
  std::vector<Night> history = {night(0, {record("ALM", 1), record("P2", 1)}),
                                night(1, {record("ALM", 1)})};
  judge_newest(history, {});
  ASSERT_EQ(history[1].findings.size(), 1u);
  EXPECT_EQ(history[1].findings[0].after, "not run");
  EXPECT_FALSE(history[1].failed);
  Record back = record("P2", 1);  // compared with the last night that has it
  back.linear_iterations = 101;
  history.push_back(night(2, {record("ALM", 1), back}));
  judge_newest(history, {});
  ASSERT_EQ(history[2].findings.size(), 1u);
  EXPECT_TRUE(history[2].failed);
}

TEST(Judge, ASlowdownIsReportedOnceWithItsFirstNight) {
  testing::Random random(1);
  std::vector<Night> history;
  int reports = 0;
  for (int day = 0; day < 40; ++day) {
    std::vector<Record> cases;
    for (int c = 0; c < 8; ++c) {
      const bool slow = c == 3 && day >= 25;
      cases.push_back(
          record(fmt::format("M{}", c), (slow ? 1.2 : 1) * std::exp(random.normal(0.01))));
    }
    history.push_back(night(day, cases));
    judge_newest(history, {});
    for (const Finding& finding : history.back().findings) {
      ++reports;
      EXPECT_EQ(finding.case_name, "Mesh0/default/M3");
      EXPECT_EQ(finding.lane, Lane::times);
      EXPECT_EQ(finding.since, history[25].date);
      EXPECT_NEAR(*finding.ratio, 1.2, 0.02);
      EXPECT_NEAR(finding.after.get<double>() / finding.before.get<double>(), 1.2, 0.03);
    }
    EXPECT_EQ(history.back().failed, !history.back().findings.empty());
  }
  EXPECT_EQ(reports, 1);
}

TEST(History, IsReadAsItWasWritten) {
  const testing::TemporaryFolder folder;
  EXPECT_TRUE(read_history(folder / "none").empty());
  std::vector<Night> history = {night(0, {record("ALM", 1)}), night(1, {record("ALM", 2)})};
  history[1].cases[0].linear_iterations = 300;
  judge_newest(history, {});
  for (Night& one : history) {
    one.file = file_for(one, folder.path(), {});
    write_night(one);
  }
  EXPECT_EQ(history[0].file.filename(), "2026-01-01T030000Z.json");
  const std::vector<Night> read = read_history(folder.path());
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[1].date, history[1].date);
  EXPECT_TRUE(read[1].failed);
  EXPECT_EQ(read[1].machine(), history[1].machine());
  ASSERT_EQ(read[1].findings.size(), 1u);
  EXPECT_EQ(read[1].findings[0].sentence, history[1].findings[0].sentence);
  EXPECT_EQ(read[1].findings[0].before, 100);
  EXPECT_EQ(read[1].find("Mesh0/default/ALM")->samples_s, history[1].cases[0].samples_s);
  EXPECT_EQ(read[1].noise_samples_s, std::vector<double>{0.1});
  write_night(read[1]);  // nothing is lost on the way
  EXPECT_EQ(testing::text_of(read[1].file), testing::text_of(history[1].file));
}

TEST(History, TwoRunsOfOneSecondAreBothKeptAndOneIsNotTwice) {
  const testing::TemporaryFolder folder;
  Night first = night(0, {record("ALM", 1)}), second = night(0, {record("ALM", 2)});
  first.file = file_for(first, folder.path(), {});
  second.file = file_for(second, folder.path(), {first});
  EXPECT_EQ(second.file.filename(), "2026-01-01T030000Z-2.json");
  EXPECT_THROW(file_for(first, folder.path(), {first, second}), RecordError);
}

TEST(History, NamesAFileThatIsNoNight) {
  const testing::TemporaryFolder folder;
  fs::create_directories(folder / "nights");
  Night one = night(0, {record("ALM", 1)});
  one.file = file_for(one, folder.path(), {});
  write_night(one);
  const std::string whole = testing::text_of(one.file);
  const auto broken = [&](std::string text, const std::string& from, const std::string& to) {
    if (!from.empty()) text.replace(text.find(from), from.size(), to);
    testing::write_text(one.file, text);
    try {
      read_history(folder.path());
    } catch (const RecordError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const std::string& what :
       {broken(whole.substr(0, whole.size() / 2), "", ""), broken("", "", ""), broken("[]", "", ""),
        broken(whole, "night-1", "night-9"), broken(whole, "\"ok\"", "\"fine\""),
        broken(whole, "2026-01-01T03:00:00Z", "yesterday"), broken(whole, "false", "7")}) {
    EXPECT_EQ(what.rfind(one.file.string() + ": ", 0), 0u) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
  }
  EXPECT_EQ(broken(whole, "", ""), "");
}

TEST(Track, TheUsersArgumentsReplaceTheSelection) {
  const auto plain = nightly_arguments({}, "h/latest");
  EXPECT_EQ(plain.front(), "--out=h/latest");
  EXPECT_EQ(plain.size(), 5u);
  const auto own = nightly_arguments({"--mesh", "Mesh0", "--method=P2"}, "h/latest");
  EXPECT_EQ(own, (std::vector<std::string>{"--out=h/latest", "--repetitions=9", "--interleave",
                                           "--mesh", "Mesh0", "--method=P2"}));
}

}  // namespace
}  // namespace airybench::judge_test
