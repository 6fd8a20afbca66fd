// bench --study from outside: exit codes, records, one-line complaints.
#include <gtest/gtest.h>

#include <set>
#include <thread>

#include "tests/support/bench_command.hpp"
#include "tests/support/places.hpp"

namespace airybench::study_command_test {
namespace {

class StudyCommand : public ::testing::Test {
 protected:
  // The records of this run, in o.
  std::vector<Json> records_of(const std::string& arguments, int code = 0) const {
    const testing::CommandResult result = bench_.run("--mesh=Mesh0 --out=o " + arguments);
    EXPECT_EQ(result.code, code) << result.err;
    return bench_.records();
  }
  const testing::BenchCommand bench_;
};

TEST_F(StudyCommand, StabilityIsOneRecordMeasuredOnce) {
  const auto all =
      records_of("--study=stability --repetitions=3 --method=HYBRID --scene='" +
                 (testing::stability_scenes_folder() / "friction_0.json").string() + "'");
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0]["study"], "stability");
  EXPECT_EQ(all[0]["scene"], "friction_0");
  EXPECT_FALSE(all[0]["scene_group"].is_null());
  EXPECT_EQ(all[0]["outcome"], "ok");
  EXPECT_EQ(all[0]["measured_once"], true);
  EXPECT_TRUE(all[0]["knob"].is_null());
}

TEST_F(StudyCommand, ErrorHasAPointForEveryValueOfTheKnob) {
  std::set<double> tolerances;
  // Points that are cut short are not ok.
  const auto all = records_of("--study=error --repetitions=1 --method='SDTIC6,BLIND:SCHUR'", 1);
  for (const Json& record : all) {
    EXPECT_EQ(record["study"], "error");
    EXPECT_GT(record["time_s"], 0) << record["status"];
    EXPECT_GE(record["error_total"].get<double>(), record["error_discretisation"].get<double>());
    if (record["method"] == "SDTIC6") {
      EXPECT_EQ(record["knob"], "tolerance");
      tolerances.insert(record["knob_value"].get<double>());
    } else {
      EXPECT_TRUE(record["knob"].is_null());
    }
  }
  EXPECT_EQ(tolerances.size() + 1, all.size());
}

// A budget limits solves, not the search for parameters; figures take it from the context.
TEST_F(StudyCommand, BudgetsOfAnErrorStudyAreInItsContext) {
  bench_.run("--study=error:20,5 --mesh=Mesh0 --method=HYBRID --repetitions=1 --out=o");
  ASSERT_FALSE(bench_.records().empty());
  for (const Json& record : bench_.records()) {
    EXPECT_EQ(record["context"]["budgets_s"], "5,20");
    EXPECT_EQ(record["context"]["timeout_s"], "40");
    EXPECT_EQ(record["tuning_budget_s"], 900);
  }
}

TEST_F(StudyCommand, ScalingIsACaseForEveryNumberOfThreads) {
  const bool two = std::thread::hardware_concurrency() > 1;
  const auto all = records_of("--study=scaling --method=HYBRID,3STEPD --repetitions=2 --threads=" +
                              std::string(two ? "2" : "1"));
  ASSERT_EQ(all.size(), two ? 4u : 2u);
  for (const Json& record : all) {
    EXPECT_EQ(record["knob"], "threads");
    EXPECT_EQ(record["knob_value"], record["threads"]);
    EXPECT_EQ(record["context"]["threads"], two ? "1,2" : "1");
    EXPECT_EQ(record["noise_kernel_samples_s"].size(), 6u);
    EXPECT_EQ(record["busy_kernel_samples_s"].size(), record["threads"] == 1 ? 0u : 6u);
  }
  bench_.expect_ok("replay o:Mesh0/default/HYBRID/study=scaling/threads=1 --out=r");
}

// What runs on fewer processors than threads has no efficiency.
TEST_F(StudyCommand, ScalingTakesNoMoreThreadsThanProcessors) {
  ASSERT_LT(std::thread::hardware_concurrency(), 5000u);
  for (const std::string threads : {"1,5000", "0", "1,x", "1,,2", "2.0"})
    bench_.expect_refusal("--study=scaling --mesh=Mesh0 --threads=" + threads,
                          "--threads: " + threads + " (allowed: whole numbers from 1 to ");
  bench_.expect_refusal("--mesh=Mesh0 --threads=1,2", "--threads: 1,2 (allowed: ");
}

TEST_F(StudyCommand, AdaptedIsTheMethodsOnMeshesThatReachAnError) {
  const auto all = records_of(
      "--study=adapted --repetitions=1 --adapt=3%,1.5%,levels=last --method=HYBRID,3STEPD");
  ASSERT_EQ(all.size(), 4u);
  for (const Json& record : all) {
    EXPECT_EQ(record["study"], "adapted");
    EXPECT_GT(record["condition_estimate"], 1);
    EXPECT_GT(record["adapt_level"], 0);
    EXPECT_LE(record["error_total"], 0.03);
  }
}

TEST_F(StudyCommand, RefusesWhatItCannotStudy) {
  for (const char* arguments :
       {"--study=foo", "--study=error --stop=paper", "--study=error --figure=3"}) {
    bench_.expect_refusal(std::string(arguments) + " --out=o", "--st");
    EXPECT_FALSE(std::filesystem::exists(bench_.path("o"))) << arguments;
  }
}

}  // namespace
}  // namespace airybench::study_command_test
