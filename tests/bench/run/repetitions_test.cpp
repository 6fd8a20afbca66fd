// --repetitions: how often a case is timed, decided from made-up samples; what the record then
// says.
#include <gtest/gtest.h>

#include "bench/records/summary.hpp"
#include "bench/run/runner.hpp"
#include "tests/support/bench_command.hpp"

namespace airybench::repetitions_test {
namespace {

Record timed(std::vector<double> samples_s) {
  Record record;
  record.status = Status::ok;
  record.samples_s = std::move(samples_s);
  return record;
}

Limits precise(double share) {
  Limits limits;
  limits.precision = share;
  return limits;
}

TEST(Repetitions, AreThoseAskedForWithoutPrecision) {
  const Limits limits;
  EXPECT_EQ(max_repetitions(limits), 5);
  EXPECT_TRUE(is_repeated(timed({}), limits));
  EXPECT_TRUE(is_repeated(timed({1, 1, 1, 1}), limits));
  EXPECT_FALSE(is_repeated(timed({1, 2, 1, 2, 1}), limits));
}

TEST(Repetitions, GoOnUntilTheMedianIsPreciseEnough) {
  const Limits limits = precise(0.02);
  EXPECT_EQ(min_repetitions(limits), 6);
  EXPECT_TRUE(is_repeated(timed({1, 1, 1, 1, 1}), limits));      // no interval
  EXPECT_FALSE(is_repeated(timed({1, 1, 1, 1, 1, 1}), limits));  // ± 0
  EXPECT_FALSE(is_repeated(timed({0.98, 1, 1, 1, 1, 1.02}), precise(0.0201)));
  EXPECT_TRUE(is_repeated(timed({0.98, 1, 1, 1, 1, 1.03}), limits));
  // From nine samples on the outermost are outside.
  EXPECT_FALSE(is_repeated(timed({0.5, 1, 1, 1, 1, 1, 1, 1, 9}), limits));
}

TEST(Repetitions, HaveALeastNumberAndAnEndOnANoisyMachine) {
  Limits limits = precise(0.02);
  limits.repetitions = 8;
  EXPECT_TRUE(is_repeated(timed(std::vector<double>(7, 1.0)), limits));
  EXPECT_FALSE(is_repeated(timed(std::vector<double>(8, 1.0)), limits));
  limits.max_repetitions = 10;
  EXPECT_EQ(max_repetitions(limits), 10);
  EXPECT_TRUE(is_repeated(timed({1, 2, 1, 2, 1, 2, 1, 2, 1}), limits));
  EXPECT_FALSE(is_repeated(timed({1, 2, 1, 2, 1, 2, 1, 2, 1, 2}), limits));
  limits.long_case_s = 10;
  EXPECT_FALSE(is_repeated(timed({1, 2, 1, 2, 1, 2, 1}), limits));
  Record once = timed({1});
  once.measured_once = true;
  EXPECT_FALSE(is_repeated(once, limits));
}

TEST(Precision, IsJudgedInTheRecord) {
  Record record = timed({0.98, 1, 1, 1, 1, 1.04});
  summarise(record);
  EXPECT_EQ(record.time_ci_low_s, 0.98);
  EXPECT_EQ(record.time_ci_high_s, 1.04);
  EXPECT_FALSE(misses_precision(record));  // none asked for
  for (const auto& [share, missed] : {std::pair("0.05", false), {"0.03", true}}) {
    record.context["precision"] = share;
    EXPECT_EQ(misses_precision(record), missed) << share;
  }
  record.samples_s.pop_back();
  record.context["precision"] = "0.5";
  summarise(record);
  EXPECT_FALSE(record.time_ci_low_s);
  EXPECT_TRUE(misses_precision(record));
}

// However quiet or noisy the machine is.
TEST(Precision, EndsARunAndSaysWhatWasReached) {
  const testing::BenchCommand bench;
  const std::string run = "--mesh=Mesh0 --method=HYBRID,3STEPD ";
  ASSERT_EQ(bench.run(run + "--repetitions=5..12,precision=0.001% --out=hard").code, 0);
  for (const Json& record : bench.records("hard")) {
    const std::size_t samples = record.at("samples_s").size();
    EXPECT_EQ(record.at("repetitions"), samples);
    EXPECT_LE(record.at("time_ci_low_s"), record.at("time_s"));
    EXPECT_GE(record.at("time_ci_high_s"), record.at("time_s"));
    EXPECT_EQ(record.at("context").at("precision"), "1e-05");
    EXPECT_TRUE(samples == 12 || !misses_precision(record_of(record, "hard"))) << samples;
  }
  ASSERT_EQ(bench.run(run + "--repetitions=5..12,precision=99% --interleave --out=easy").code, 0);
  for (const Json& record : bench.records("easy")) {
    const std::size_t samples = record.at("samples_s").size();
    EXPECT_GE(samples, 6u);
    EXPECT_TRUE(samples == 12 || !misses_precision(record_of(record, "easy"))) << samples;
  }
}

}  // namespace
}  // namespace airybench::repetitions_test
