// Paths of load steps through other people's programs.
#include <gtest/gtest.h>

#include "tests/bench/external/programs.hpp"

namespace airybench::external_load_steps_test {
namespace {

using ExternalLoadSteps = testing::ExternalPrograms;

// The condensed problem of a step has the slip of those before; friction remembers it on the way
// back.
TEST_F(ExternalLoadSteps, AreHandedToProgramsThatReadTheCondensedProblem) {
  declare("airy", "airy", "exit 1");
  declare("body", "body", "exit 1");
  ASSERT_EQ(bench_.run("new-external mine").code, 0);
  write("scenes/path.json", R"({"load_steps": [{"displacement_mm": [0.02, -0.006]},
                                         {"displacement_mm": [0.015, 0]}]})");
  const auto records = records_of("--scene=scenes/path.json", 0);
  ASSERT_EQ(records.size(), 3u);
  for (const char* name : {"airy", "body"}) {
    EXPECT_EQ(records.at(name)["status"], "skipped");
    EXPECT_EQ(records.at(name)["status_reason"],
              "a path of load steps: the declaration lacks load_steps");
  }
  const Json& mine = records.at("mine");
  EXPECT_EQ(mine["status"], "ok") << mine["status_reason"];
  EXPECT_EQ(mine["load_steps"], 3);
  ASSERT_EQ(mine["steps"].size(), 3u);
  for (const Json& step : mine["steps"]) EXPECT_LT(step["error"], 1e-9);
  EXPECT_GT(mine["steps"][1]["dissipation_Nmm"], 1e-6);
}

TEST_F(ExternalLoadSteps, AStepWithoutAnAnswerEndsThePath) {
  write_right();
  declare("once", "condensed", "cp right/* $2; test ! -e ran || exit 7; touch ran");
  write("scenes/path.json", R"({"load_steps": [{"displacement_mm": [0.02, -0.006]}]})");
  const auto records = records_of("--scene=scenes/path.json", 1);
  EXPECT_EQ(records.at("once")["status"], "crashed");
  EXPECT_EQ(records.at("once")["status_reason"], "load step 2 of 2: once ended with exit code 7");
}

}  // namespace
}  // namespace airybench::external_load_steps_test
