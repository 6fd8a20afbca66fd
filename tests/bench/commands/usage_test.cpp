// Wrong usage of bench: exit code 2, one line, nothing written.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/support/bench_command.hpp"

namespace airybench::usage_test {
namespace {

namespace fs = std::filesystem;
using testing::BenchCommand;
using testing::CommandResult;
using testing::lines_of;
using testing::write_text;

#ifndef AIRYBENCH_SANITIZED  // which needs more address space than any limit
TEST(Usage, ALackOfMemoryIsNotWrongUsage) {
  const BenchCommand bench;
  fs::create_directory(bench.path("big"));  // of its one line there is more than one copy
  write_text(bench.path("big/records.jsonl"),
             R"({"mesh":")" + std::string(120'000'000, 'x') + "\"}\n");
  const CommandResult result = bench.run("export big --format=junit", "ulimit -v 400000; ");
  EXPECT_EQ(result.code, 3);
  EXPECT_EQ(result.err, "bench: out of memory\n");
}
#endif

TEST(Usage, WrongUsageIsOneLineAndNothingIsWritten) {
  const BenchCommand bench;
  const CommandResult unknown = bench.run("--method=4STEP");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_EQ(unknown.err.rfind("bench: no method matches '4STEP' (valid: SDTIC3, ", 0), 0u);
  EXPECT_EQ(std::count(unknown.err.begin(), unknown.err.end(), '\n'), 1);
  const auto expect_usage_error = [&](const std::string& arguments, const std::string& line) {
    const CommandResult result = bench.run(arguments);
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_EQ(result.err, "bench: " + line + "\n") << arguments;
    EXPECT_FALSE(fs::exists(bench.path("results"))) << arguments;
  };
  expect_usage_error("--mesh=nowhere.msh",
                     "nowhere.msh: cannot be opened: No such file or directory");
  expect_usage_error("--scene=nowhere.json",
                     "nowhere.json: cannot be opened: No such file or directory");
  write_text(bench.path("bad.json"), R"({"friction": -2})");
  expect_usage_error("--scene=bad.json", "bad.json: friction: -2 (allowed: >= 0)");
  write_text(bench.path("four.json"), R"({"teeth": 4})");
  expect_usage_error("--mesh=Mesh0 --scene=four.json",
                     "four.json: teeth: 4 contradicts the mesh Mesh0, which has 1 contact face(s)");
  write_text(bench.path("broken.msh"), "hello\n");
  expect_usage_error("--mesh=broken.msh",
                     "broken.msh:1: not a mesh file: the first line must be $MeshFormat");
  EXPECT_EQ(bench.run("--mesh=Mesh9").code, 2);
  for (const char* arguments : {"--repetitions=0", "--repetitions=x", "--timeout=-1", "--threads=0",
                                "--target-error=0", "--memory-limit=0", "--wrong", "extra"}) {
    const CommandResult result = bench.run(arguments);
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_FALSE(fs::exists(bench.path("results"))) << arguments;
  }
}

TEST(Usage, AnOutputFolderThatCannotBeMadeIsNamed) {
  const BenchCommand bench;
  write_text(bench.path("taken"), "a file");
  const CommandResult result = bench.run("--mesh=Mesh0 --repetitions=1 --out=taken/inside");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err, "bench: taken/inside: cannot be made a folder: Not a directory\n");
}

TEST(Usage, ArgumentsThatCannotBeUsedLeaveEarlierResultsAlone) {
  const BenchCommand bench;
  ASSERT_EQ(bench.run("--mesh=Mesh0 --method=3STEPD --repetitions=1 --out=o").code, 0);
  const auto all = [&] {
    return bench.content("o/records.jsonl") + bench.content("o/results.csv") +
           bench.content("o/results.json");
  };
  const std::string before = all();
  for (const char* arguments :
       {"--no_such_option", "--benchmark_out=x", "--benchmark_report_aggregates_only=true",
        "--benchmark_filter=NoSuchCase", "--benchmark_list_tests"}) {
    const CommandResult result =
        bench.run(std::string("--mesh=Mesh0 --repetitions=1 --out=o -- ") + arguments);
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_NE(result.err.find("bench: "), std::string::npos) << result.err;
    EXPECT_EQ(all(), before) << arguments;
  }
}

TEST(Usage, WrongMethodsFiguresAndStopsAreOneLine) {
  const BenchCommand bench;
  const std::pair<const char*, const char*> wrong[] = {
      {"--figure=4 --mesh=Mesh0", "--mesh excludes --figure"},
      {"--figure=4 --method=3STEPD", "--method excludes --figure"},
      {"--figure=2", "--figure: "},
      {"--stop=wrong", "--stop: wrong"},
      {"--method=SYMMLQ:DTIC9", "'DTIC9' is no preconditioner (valid: DTIC3..DTIC6"},
      {"--method=SYMMLQ:", "'' is no preconditioner"},
      {"--method=ALM:r=0,rho=1", "r='0' (allowed: a number above 0)"},
      {"--method=ALM:r=1", "rho='' (allowed: a number above 0)"},
      {"--method=ALM:r=1,rho=inf", "rho='inf'"},
      {"--method=ALM:r=1,rho=1,r=2", "'r' is there twice"},
      {"--method=ALM:r=1,rho=1,s=2", "unknown option 's' (valid: r, rho)"},
      {"--method=3STEPCG:DTIC3,lanes=3", "lanes=3 (allowed: 1, 16)"},
      {"--method=3STEPCG:DTIC3,schur=sparse", "unknown option 'schur' (valid: lanes, refine)"},
      {"--method=SYMMLQ:DTIC3,schur=x", "schur=x (allowed: dense, sparse)"},
      {"--method=BLIND:DTIC3", "no method matches 'BLIND:DTIC3'"},
      {"--method=3STEPD,,HYBRID", "no method matches ''"},
  };
  for (const auto& [arguments, line] : wrong) {
    const CommandResult result = bench.run(arguments);
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_EQ(result.err.rfind("bench: ", 0), 0u) << result.err;
    EXPECT_NE(result.err.find(line), std::string::npos) << arguments << ": " << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_FALSE(fs::exists(bench.path("results"))) << arguments;
  }
}

TEST(Usage, AppendToAMalformedFileIsRefusedBeforeAnythingIsRun) {
  const BenchCommand bench;
  ASSERT_EQ(bench.run("--mesh=Mesh0 --method=3STEPD --repetitions=1 --out=o").code, 0);
  std::ofstream(bench.path("o/records.jsonl"), std::ios::app) << "{\"mesh\": \n";
  const std::string before = bench.content("o/records.jsonl");
  const CommandResult result =
      bench.run("--mesh=Mesh0 --method=HYBRID --repetitions=1 --out=o --append");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err.rfind("bench: o/records.jsonl:2: ", 0), 0u) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_EQ(bench.content("o/records.jsonl"), before);
  EXPECT_EQ(lines_of(bench.content("o/results.csv")).size(), 2u);
}

}  // namespace
}  // namespace airybench::usage_test
