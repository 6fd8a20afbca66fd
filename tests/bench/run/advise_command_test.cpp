// bench advise from outside: the table, its CSV, and what it leaves in the folder.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <regex>

#include "tests/support/bench_command.hpp"

namespace airybench::advise_command_test {
namespace {

class AdviseCommand : public ::testing::Test {
 protected:
  // Its advice on Mesh0; what it printed.
  std::string advice(const std::string& arguments, const std::string& folder = "o") const {
    return bench_.expect_ok("advise --mesh=Mesh0 --out=" + folder + " " + arguments).out;
  }
  const testing::BenchCommand bench_;
};

TEST_F(AdviseCommand, TheFirstRowMeetsTheErrorAndItsFieldsAreThere) {
  advice("--error=1.5% --method=HYBRID,3STEPD");
  const std::vector<std::string> csv = testing::lines_of(bench_.content("o/advice.csv"));
  EXPECT_EQ(
      csv.at(0),
      "mesh,method,n_phi,error_total,time_s,adapt_time_s,peak_heap_bytes,basis,status,command");
  EXPECT_TRUE(testing::contains(csv.at(1), " --mesh=Mesh0 --adapt=1.5%,levels=last --method="));
  const auto refined = std::ranges::find_if(
      csv, [](const std::string& row) { return row.starts_with("\"Mesh0+refine1\""); });
  ASSERT_NE(refined, csv.end());
  const std::size_t scene = refined->find(" --scene=") + 9;  // of the command, which reads it
  EXPECT_TRUE(std::filesystem::exists(
      bench_.path(refined->substr(scene, refined->find(' ', scene) - scene))))
      << *refined;
  EXPECT_EQ(
      std::ranges::count_if(bench_.records(),
                            [](const Json& r) { return r["error_total"].get<double>() <= 0.015; }),
      2);
  EXPECT_FALSE(std::filesystem::is_empty(bench_.path("o/fields")));
}

TEST_F(AdviseCommand, TheCommandRunsAsItIsPrinted) {
  const std::string out = advice("--error=5% --method=HYBRID,P2");
  EXPECT_TRUE(
      testing::contains(out, "P2 gives displacements. Its stresses are not in equilibrium"));
  const std::size_t begin = out.find(":\n  ") + 4;
  const std::string command = out.substr(begin, out.find('\n', begin) - begin);
  const std::string copied =
      "cd '" + bench_.path("").string() + "' && " + command + " --repetitions=1 --out=again";
  EXPECT_EQ(std::system((copied + " >/dev/null 2>&1").c_str()), 0) << copied;
  EXPECT_TRUE(std::filesystem::exists(bench_.path("again/records.jsonl")));
}

TEST_F(AdviseCommand, RefiningEverywhereIsScaledFromItsMeasurement) {
  const std::string out = advice("--error=0.8% --method=HYBRID,HYBRID:k=2");
  std::smatch found;
  const std::regex row(
      R"(\nMesh0\+refine(\d) +HYBRID +(\d+) .* Mesh0\+refine1 scaled by n log n, the error at best\n)");
  ASSERT_TRUE(std::regex_search(out, found, row)) << out;
  ASSERT_EQ(found[1], "3") << out;
  EXPECT_NEAR(std::stod(found[2]), 44035, 0.01 * 44035);  // bench --mesh=Mesh0+refine3
  EXPECT_TRUE(testing::contains(out, "Mesh0+adapt2   HYBRID:k=2 "));
  EXPECT_EQ(bench_.records().size(), 4u);
}

TEST_F(AdviseCommand, WhatIsHopelessOrOverTheBudgetIsLeftOutByForecast) {
  // The limit of time is another reason, on a slow machine.
  advice("--error=0.5% --method=HYBRID,SDTIC3 --timeout=1000 --budget=1000");
  EXPECT_TRUE(testing::contains(bench_.content("o/advice.csv"), " times the fastest,skipped,"));
  advice("--error=2% --method=HYBRID,BLIND --budget=0.01", "p");
  EXPECT_TRUE(
      testing::contains(bench_.content("p/advice.csv"), ",forecast: over --budget,skipped,"));
  for (const Json& record : bench_.records("p")) EXPECT_EQ(record["method"], "HYBRID");
}

TEST_F(AdviseCommand, RefusesWhatItCannotAdviseOn) {
  for (const auto& [arguments, named] :
       {std::pair("--mesh=Mesh0", "--error"),
        {"--error=1%", "--mesh"},
        {"--mesh=Mesh0 --error=5000", "--error: 5000 (allowed"},
        {"--mesh=Mesh0 --error=0%", "--error: 0% (allowed"},
        {"--mesh=Mesh0 --error=1% --budget=0", "--budget: 0 (allowed"},
        {"--mesh=Mesh0..Mesh3 --error=1%", "--mesh: Mesh0..Mesh3: 4 meshes (allowed: one)"}}) {
    bench_.expect_refusal(std::string("advise --out=o ") + arguments, named);
    EXPECT_FALSE(std::filesystem::exists(bench_.path("o"))) << arguments;
  }
}

#ifndef AIRYBENCH_SANITIZED  // no limit on the heap there
TEST_F(AdviseCommand, SaysWhenNothingMeetsTheError) {
  const testing::CommandResult result =
      bench_.run("advise --mesh=Mesh0 --error=0.01% --memory-limit=3 --method=HYBRID --out=o");
  EXPECT_EQ(result.code, 1);
  EXPECT_TRUE(testing::contains(result.err, "not reached"));
}
#endif

}  // namespace
}  // namespace airybench::advise_command_test
