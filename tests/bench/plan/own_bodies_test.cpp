// The bodies of docs/bodies, as a user runs them: a model and a scene, one command.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/bench_command.hpp"
#include "tests/support/sanitized.hpp"

namespace airybench::own_bodies_test {
namespace {

namespace fs = std::filesystem;

class OwnBodies : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!fs::exists(testing::meshgen_executable())) GTEST_SKIP() << "meshgen is not built here";
  }
  std::string body(const std::string& suffix) const {
    return (testing::source_folder() / "docs/bodies" / (GetParam() + suffix)).string();
  }
  testing::CommandResult run(const std::string& arguments) const {
    return bench_.run("--mesh=" + body(".geo") + " --scene=" + body(".json") +
                          " --method=HYBRID,P2 --repetitions=1 --out=o " + arguments,
                      "export AIRYBENCH_CACHE_DIR=cache; ");
  }
  const testing::BenchCommand bench_;
};

TEST_P(OwnBodies, FromTheModelToTablePicturesAndAdaptedMeshes) {
  const testing::CommandResult result = run("--adapt=5% --fields");
  const std::vector<Json> records = bench_.records();
  ASSERT_GE(records.size(), 2u) << result.err << result.out;
  bool all_ok = true;
  for (const Json& record : records) {
    // The first mesh of L meets its disc at one point: nothing is known there.
    const bool known = record["error_discretisation"].get<double>() <= 1;
    EXPECT_EQ(record["status"], known ? "ok" : "inaccurate") << record;
    all_ok &= known;
    EXPECT_GT(record["n_stick"].get<int>() + record["n_slip"].get<int>(), 0) << record;
    EXPECT_TRUE(fs::exists(bench_.path("o") / record["mesh_file"].get<std::string>())) << record;
  }
  EXPECT_EQ(result.code, all_ok ? 0 : 1) << result.err << result.out;
  double error = 1;
  for (const Json& record : records)
    if (record["method"] == "HYBRID") error = record["error_discretisation"];
  EXPECT_LE(error, 0.05);
  int pictures = 0;
  for (const auto& file : fs::directory_iterator(bench_.path("o/fields")))
    pictures += file.path().extension() == ".vtu" ? 1 : 0;
  EXPECT_GE(pictures, static_cast<int>(records.size()));
}

// The record says all of the scene.
TEST_P(OwnBodies, RecordsCanBeReplayed) {
  if (GetParam() != std::string("cylinder")) return;  // once is enough
  ASSERT_EQ(run("").code, 0);
  const testing::CommandResult replayed = bench_.run("replay o:1");
  EXPECT_EQ(replayed.code, 0) << replayed.err << replayed.out;
}

// Two bodies' faces are proposed as a pair, with their shapes and without walls.
TEST_P(OwnBodies, FacesOfDifferentBodiesAreProposedInPairs) {
  if (GetParam() != std::string("stack")) return;
  const testing::CommandResult made = bench_.run("new-scene " + body(".geo"));
  ASSERT_EQ(made.code, 0) << made.err;
  const Json scene = Json::parse(bench_.content("stack.json"));
  const std::vector<Json> expected = {Json::array({"contact:first", "contact:second_below"}),
                                      Json::array({"contact:second_above", "contact:third"})};
  ASSERT_EQ(scene["contacts"].size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(scene["contacts"][k]["between"], expected[k]);
  EXPECT_FALSE(scene["boundary"]["contact:first"].contains("wall"));
  const testing::CommandResult cg = bench_.run(
      "--mesh=" + body(".geo") + " --scene=" + body(".json") + " --method=HYBRID:CG --out=o",
      "export AIRYBENCH_CACHE_DIR=cache; ");
  EXPECT_EQ(bench_.records().at(0)["status"], "skipped") << cg.err;
  EXPECT_TRUE(testing::contains(cg.out, "active sets on K hold edges at walls only"));
  EXPECT_TRUE(testing::contains(cg.err, "faces in contact are matched: "));
}

// Its middle and upper block are held by contact alone.
TEST_P(OwnBodies, WhatContactAloneHoldsIsNotExportedAndSomeMethodsSkipIt) {
  if (GetParam() != std::string("pile")) return;
  const std::string of = " --mesh=" + body(".geo") + " --scene=" + body(".json"),
                    cache = "export AIRYBENCH_CACHE_DIR=cache; ";
  const testing::CommandResult refused =
      bench_.run("export-problem --format=npz --out=exported" + of, cache);
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(testing::contains(refused.err, "pile: a body that contact alone holds has no D"));
  EXPECT_FALSE(fs::exists(bench_.path("exported")));
  const testing::CommandResult skipped = bench_.run("--method=ALM:AUTO --out=o" + of, cache);
  EXPECT_EQ(bench_.records().at(0)["status"], "skipped") << skipped.err;
  EXPECT_TRUE(testing::contains(skipped.out, "a body held by contact or points alone"));
}

const std::vector<const char*> few = {"cylinder", "plate", "stack"},
                               all = {"punch",  "dovetail", "cylinder",  "L",        "plate",
                                      "ring",   "stack",    "cylinders", "indenter", "lug",
                                      "blocks", "snap",     "gear",      "roller",   "pile"};
INSTANTIATE_TEST_SUITE_P(Of, OwnBodies, ::testing::ValuesIn(testing::sanitized ? few : all),
                         [](const auto& body) { return std::string(body.param); });

}  // namespace
}  // namespace airybench::own_bodies_test
