// --retry-noisy: what is quiet, what is noisy, and which attempt is kept, with a calibration loop
// whose times are made up.
#include <gtest/gtest.h>

#include <sstream>

#include "assembly/problem/scene.hpp"
#include "bench/run/noise_watch.hpp"
#include "bench/run/runner.hpp"
#include "solvers/methods.hpp"
#include "tests/support/bench_command.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::noise_watch_test {
namespace {

TEST(QuietLevel, IsTheSmallestThatLasts) {
  QuietLevel level;
  level.add(std::vector<double>(11, 2.0));
  EXPECT_FALSE(level.seconds());
  level.add({2});
  EXPECT_EQ(level.seconds(), 2);
  level.add({1, 1, 1, 1, 1});  // a moment
  EXPECT_EQ(level.seconds(), 2);
  level.add({1, 1});
  EXPECT_EQ(level.seconds(), 1);
  level.add(std::vector<double>(50, 3.0));
  EXPECT_EQ(level.seconds(), 1);
  level.is_at_most(2);
  EXPECT_EQ(level.seconds(), 1);
  level.is_at_most(0.5);
  EXPECT_EQ(level.seconds(), 0.5);
  QuietLevel fresh;
  fresh.is_at_most(0.5);
  EXPECT_EQ(fresh.seconds(), 0.5);
}

TEST(Noise, IsSlownessOrScatter) {
  EXPECT_DOUBLE_EQ(noise_of({1, 1, 1, 1, 1, 1}, 1), 0);
  EXPECT_DOUBLE_EQ(noise_of({1, 1, 1, 1, 1, 4}, 1), 0.5);  // one interruption
  EXPECT_DOUBLE_EQ(noise_of({1.5, 1.5, 1.5}, 1), 0.5);     // slow, but steady
  EXPECT_DOUBLE_EQ(noise_of({0.8, 1, 1.2, 0.8, 1.2}, 1), 0.2);
  EXPECT_DOUBLE_EQ(noise_of({1, 1, 1, 2, 2, 2}, 1), 0.5);  // from then on
}

// The loop's time is the pace; the pauses are noted, not waited for.
struct MadeUpMachine {
  double pace_s = 1;
  std::vector<double> script;  // of the next passes; then the pace
  std::size_t passes = 0;
  int pauses = 0;

  Machine machine() {
    return {[this](int) {
              const std::size_t i = passes++;
              return i < script.size() ? script[i] : pace_s;
            },
            [this](double) { ++pauses; }};
  }
  void then(int count, double seconds) { script.insert(script.end(), count, seconds); }
};

Record timed(double time_s) {
  Record record;
  record.mesh = "M";
  record.scene = "default";
  record.method = "HYBRID";
  record.status = Status::ok;
  record.samples_s = {time_s, time_s};
  return record;
}

TEST(NoiseWatch, ResumedItKnowsTheQuietLevelOfTheRecords) {
  MadeUpMachine made_up;
  made_up.pace_s = 1.2;
  NoiseWatch watch(0.05, made_up.machine());
  Record earlier = timed(9), record = timed(9);
  earlier.noise_kernel_samples_s = {1.2, 1.2};
  earlier.noise_quiet_s = 1;
  watch.learn(earlier);
  watch.add_passes(3, 1, record);
  EXPECT_TRUE(watch.is_noisy(record));
}

TEST(NoiseWatch, KeepsTheLeastNoisyAttempt) {
  MadeUpMachine made_up;
  NoiseWatch watch(0.05, made_up.machine());
  Record record = timed(9);
  std::vector<Record> earlier;
  for (const double pace : {1.3, 1.1}) {
    made_up.pace_s = pace;
    watch.add_passes(3, 1, record);
    ASSERT_TRUE(watch.is_noisy(record));
    swap_samples(record, earlier.emplace_back());
    EXPECT_FALSE(watch.is_noisy(record));  // nothing was measured
    record.samples_s = {10 * pace};
  }
  made_up.pace_s = 1.2;
  watch.add_passes(3, 1, record);
  std::ostringstream progress;
  watch.keep_quietest(earlier, record, progress);
  EXPECT_EQ(progress.str(),
            "M/default/HYBRID: none of 3 attempts was quiet: the quietest, 2, is kept\n");
  EXPECT_EQ(record.samples_s, std::vector<double>{13});
  EXPECT_EQ(record.noise_kernel_samples_s, (std::vector<double>{1.1, 1.1, 1.1}));
  EXPECT_NEAR(*record.noise_share, 0.1, 1e-12);
  EXPECT_EQ(record.noise_quiet_s, 1);
  EXPECT_EQ(record.noise_attempts, 3);
  EXPECT_TRUE(record.noisy);
}

TEST(NoiseWatch, WaitsForQuietButNotForever) {
  MadeUpMachine made_up;
  NoiseWatch watch(0.05, made_up.machine());
  watch.wait_for_quiet();
  EXPECT_EQ(made_up.pauses, 0);
  made_up.script.resize(made_up.passes, 1);
  made_up.then(6, 2);
  watch.wait_for_quiet();
  EXPECT_EQ(made_up.pauses, 2);
  made_up.pace_s = 2;
  watch.wait_for_quiet();
  EXPECT_EQ(made_up.pauses, 12);
  for (int i = 0; i < 100; ++i) watch.wait_for_quiet();
  EXPECT_LT(made_up.pauses, 500);  // of a thousand: it gives up waiting
}

TEST(NoiseWatch, SaysHowManyPassedBeforeItWasQuiet) {
  std::vector<Record> records(3, timed(1));
  for (Record& r : records) {
    r.time_s = 1;
    r.retry_noisy = 0.05;
    r.noise_share = 0;
    r.noise_quiet_s = 1;
    r.noise_kernel_samples_s = {1, 1, 1};
  }
  const auto count = [&] {
    EarlyPasses early;
    for (const Record& r : records) early.add(r);
    return early.count();
  };
  EXPECT_EQ(count(), 0);
  records[0].noise_quiet_s = 2;
  records[0].noise_kernel_samples_s = {2, 2, 2};
  EXPECT_EQ(count(), 1);
  records[0].noisy = true;  // was said already
  EXPECT_EQ(count(), 0);
}

// Whole runs, each case in its process.
class RetryNoisy : public ::testing::Test {
 protected:
  std::vector<Record> run(const char* names = "HYBRID,P2") {
    return run_cases(plan_cases({posed_}, select_methods(names), options_.run), options_.limits,
                     options_.output, {}, made_up_.machine())
        .records();
  }
  RetryNoisy() {
    options_.output.folder = folder_ / "o";
    options_.limits.repetitions = 2;
    options_.limits.retry_noisy = 0.05;
    posed_.scene_name = "default";
    posed_.problem = testing::posed(Scene{}, testing::small_tooth(4, 3));
    made_up_.then(24, 1);  // before the first case
  }
  const testing::TemporaryFolder folder_;
  Options options_;
  PosedScene posed_;
  MadeUpMachine made_up_;
};

TEST_F(RetryNoisy, LeavesAQuietRunAlone) {
  for (const Record& r : run()) {
    EXPECT_EQ(r.samples_s.size(), 2u);
    EXPECT_EQ(r.noise_attempts, 1);
    EXPECT_EQ(r.noise_share, 0);
    EXPECT_FALSE(r.noisy);
    EXPECT_EQ(r.retry_noisy, 0.05);
  }
  EXPECT_EQ(made_up_.pauses, 0);
}

TEST_F(RetryNoisy, MeasuresAgainUntilItIsQuiet) {
  made_up_.then(6, 2);  // beside the first case
  made_up_.then(3, 2);  // one look more
  const std::vector<Record> records = run();
  EXPECT_EQ(records[0].noise_attempts, 2);
  EXPECT_EQ(records[1].noise_attempts, 1);
  for (const Record& r : records) {
    EXPECT_EQ(r.samples_s.size(), 2u);
    EXPECT_EQ(r.stage_samples.size(), 2u);
    EXPECT_EQ(r.repetitions, 2);
    EXPECT_FALSE(r.noisy);
    EXPECT_EQ(r.noise_kernel_s, 1);
  }
  EXPECT_EQ(made_up_.pauses, 1);
}

TEST_F(RetryNoisy, EndsOnAMachineThatIsNeverQuiet) {
  made_up_.pace_s = 1.5;
  for (const bool interleave : {false, true}) {
    options_.limits.interleave = interleave;
    made_up_.passes = 0;
    for (const Record& r : run()) {
      EXPECT_EQ(r.noise_attempts, 4);
      EXPECT_TRUE(r.noisy);
      EXPECT_DOUBLE_EQ(*r.noise_share, 0.5);
      EXPECT_EQ(r.samples_s.size(), 2u);
      EXPECT_EQ(r.status, Status::ok);
    }
  }
}

TEST_F(RetryNoisy, TimesALongCaseOnceMore) {
  options_.limits.long_case_s = 1e-9;
  made_up_.then(6, 2);
  const Record r = run("HYBRID").front();
  EXPECT_TRUE(r.measured_once);
  EXPECT_EQ(r.noise_attempts, 2);
  EXPECT_EQ(r.samples_s.size(), 1u);
#ifndef AIRYBENCH_SANITIZED  // which counts no heap
  EXPECT_TRUE(r.peak_heap_bytes);
#endif
  EXPECT_FALSE(r.noisy);
}

TEST_F(RetryNoisy, RecordsAFailureInALaterAttempt) {
  Method method = select_methods("HYBRID").front();
  auto runs = std::make_shared<int>(0);
  method.solve = [solve = method.solve, runs](const ContactSystem& system,
                                              const RunControl& control) {
    if (++*runs > 4) throw std::runtime_error("no such luck");  // detail, memory, two timed
    return solve(system, control);
  };
  made_up_.then(6, 2);
  const auto records = run_cases(plan_cases({posed_}, {method}, options_.run), options_.limits,
                                 options_.output, {}, made_up_.machine())
                           .records();
  EXPECT_EQ(records.front().status, Status::crashed);
  EXPECT_EQ(records.front().status_reason, "in a timed run: no such luck");
  EXPECT_TRUE(records.front().samples_s.empty());
}

// However quiet or noisy this machine is.
TEST(RetryNoisyCommand, IsResumedUnderItsOwnConditions) {
  const testing::BenchCommand bench;
  const std::string run = "--mesh=Mesh0 --method=HYBRID,P2 --repetitions=2 --out=o ";
  ASSERT_EQ(bench.run(run + "--retry-noisy").code, 0);
  const std::string lines = bench.content("o/records.jsonl");
  testing::write_text(bench.path("o/records.jsonl"), lines.substr(0, lines.find('\n') + 1));
  const testing::CommandResult other = bench.run(run + "--resume");
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(testing::contains(other.err, "retry_noisy: 0.05 and (not said)"));
  ASSERT_EQ(bench.run(run + "--retry-noisy=5% --resume").code, 0);
  ASSERT_EQ(bench.records().size(), 2u);
  for (const Json& r : bench.records()) {
    EXPECT_EQ(r.at("retry_noisy"), 0.05);
    EXPECT_GE(r.at("noise_attempts"), 1);
    EXPECT_LE(r.at("noise_attempts"), 4);
    EXPECT_EQ(r.at("noisy"), r.at("noise_share") > 0.05);
    EXPECT_EQ(r.at("samples_s").size(), 2u);
  }
  ASSERT_EQ(bench.run("replay o:1 --out=again").code, 0);
  EXPECT_EQ(bench.records("again")[0].at("retry_noisy"), 0.05);
}

}  // namespace
}  // namespace airybench::noise_watch_test
