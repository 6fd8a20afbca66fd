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
  int bench(const std::string& arguments) const { return bench_.run("advise " + arguments).code; }
  std::string complaint() const { return bench_.content("err.txt"); }
  const testing::BenchCommand bench_;
};

TEST_F(AdviseCommand, TheFirstRowMeetsTheErrorAndItsFieldsAreThere) {
  ASSERT_EQ(bench("--mesh=Mesh0 --error=2% --method=HYBRID,3STEPD --out=o"), 0) << complaint();
  std::istringstream csv(bench_.content("o/advice.csv"));
  std::string header, best;
  std::getline(csv, header);
  std::getline(csv, best);
  EXPECT_EQ(
      header,
      "mesh,method,n_phi,error_total,time_s,adapt_time_s,peak_heap_bytes,basis,status,command");
  EXPECT_NE(best.find(" --mesh=Mesh0 --adapt=2%,levels=last --method="), std::string::npos) << best;
  EXPECT_NE(bench_.content("o/advice.csv").find("\"Mesh0+refine1\""), std::string::npos);
  const auto records = bench_.records();
  const auto meeting = std::ranges::count_if(
      records, [](const Json& r) { return r["error_total"].get<double>() <= 0.02; });
  EXPECT_EQ(meeting, 2);
  EXPECT_FALSE(std::filesystem::is_empty(bench_.path("o/fields")));
}

TEST_F(AdviseCommand, TheCommandRunsAsItIsPrinted) {
  const auto advice = bench_.run("advise --mesh=Mesh0 --error=5% --method=HYBRID,P2 --out=o");
  ASSERT_EQ(advice.code, 0) << advice.err;
  EXPECT_NE(advice.out.find("P2 gives displacements. Its stresses are not in equilibrium"),
            std::string::npos)
      << advice.out;
  const std::size_t begin = advice.out.find(":\n  ") + 4;
  const std::string command = advice.out.substr(begin, advice.out.find('\n', begin) - begin);
  const std::string copied =
      "cd '" + bench_.path("").string() + "' && " + command + " --repetitions=1 --out=again";
  EXPECT_EQ(std::system((copied + " >/dev/null 2>&1").c_str()), 0) << copied;
  EXPECT_TRUE(std::filesystem::exists(bench_.path("again/records.jsonl")));
}

TEST_F(AdviseCommand, RefiningEverywhereIsForecastWithARange) {
  const auto advice =
      bench_.run("advise --mesh=Mesh0 --error=1% --method=HYBRID,HYBRID:k=2 --out=o");
  ASSERT_EQ(advice.code, 0) << advice.err;
  std::smatch found;
  const std::regex row(
      R"(\nMesh0\+refine(\d) +HYBRID +(\d+) .* forecast: \S+ m?s to \S+ m?s, the error at best\n)");
  ASSERT_TRUE(std::regex_search(advice.out, found, row)) << advice.out;
  ASSERT_EQ(found[1], "3") << advice.out;
  EXPECT_NEAR(std::stod(found[2]), 44035, 0.01 * 44035);  // bench --mesh=Mesh0+refine3
  EXPECT_NE(advice.out.find("Mesh0+adapt2   HYBRID:k=2 "), std::string::npos) << advice.out;
  EXPECT_EQ(bench_.records().size(), 4u);
}

TEST_F(AdviseCommand, HopelessMethodsAreLeftOutByForecast) {
  // The limit of time is another reason, on a slow machine.
  ASSERT_EQ(bench("--mesh=Mesh0 --error=0.5% --method=HYBRID,SDTIC3 --timeout=1000 --budget=1000 "
                  "--out=o"),
            0)
      << complaint();
  EXPECT_NE(bench_.content("o/advice.csv").find(" times the fastest,skipped,"), std::string::npos)
      << bench_.content("o/advice.csv");
}

TEST_F(AdviseCommand, WhatDoesNotFitIntoTheBudgetIsLeftOutAndSaid) {
  ASSERT_EQ(bench("--mesh=Mesh0 --error=2% --method=HYBRID,BLIND --budget=0.01 --out=o"), 0)
      << complaint();
  EXPECT_NE(bench_.content("o/advice.csv").find(",forecast: over --budget,skipped,"),
            std::string::npos)
      << bench_.content("o/advice.csv");
  for (const Json& record : bench_.records()) EXPECT_EQ(record["method"], "HYBRID");
}

TEST_F(AdviseCommand, RefusesWhatItCannotAdviseOn) {
  for (const auto& [arguments, said] : std::vector<std::pair<std::string, std::string>>{
           {"--mesh=Mesh0", "--error"},
           {"--error=1%", "--mesh"},
           {"--mesh=Mesh0 --error=5000", "--error: 5000 (allowed"},
           {"--mesh=Mesh0 --error=0%", "--error: 0% (allowed"},
           {"--mesh=Mesh0 --error=1% --budget=0", "--budget: 0 (allowed"},
           {"--mesh=Mesh0..Mesh3 --error=1%", "--mesh: Mesh0..Mesh3: 4 meshes (allowed: one)"}}) {
    EXPECT_EQ(bench(arguments + " --out=o"), 2) << arguments;
    EXPECT_NE(complaint().find(said), std::string::npos) << complaint();
    EXPECT_EQ(std::ranges::count(complaint(), '\n'), 1) << complaint();
    EXPECT_FALSE(std::filesystem::exists(bench_.path("o"))) << arguments;
  }
}

#ifndef AIRYBENCH_SANITIZED  // no limit on the heap there
TEST_F(AdviseCommand, SaysWhenNothingMeetsTheError) {
  EXPECT_EQ(bench("--mesh=Mesh0 --error=0.01% --memory-limit=3 --method=HYBRID --out=o"), 1);
  EXPECT_NE(complaint().find("not reached"), std::string::npos) << complaint();
}
#endif

}  // namespace
}  // namespace airybench::advise_command_test
