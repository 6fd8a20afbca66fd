// `bench --problem` from outside, and what other commands do with its records.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/support/bench_command.hpp"
#include "tests/support/environment_variable.hpp"

namespace airybench::given_problem_command_test {
namespace {

class GivenProblemCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(bench_.run("export-problem --mesh=Mesh0 --format=fclib --out=fclib").code, 0);
  }
  testing::CommandResult run(const std::string& arguments) const {
    return bench_.run("--problem=fclib/problem.hdf5 --repetitions=1 --out=o " + arguments);
  }
  void refused(const std::string& arguments, const std::string& beginning) const {
    bench_.expect_refusal(arguments, "bench: " + beginning);
  }
  const testing::BenchCommand bench_;
};

TEST_F(GivenProblemCommand, SeveralFilesAreRunUnderTheNamesOfTheirCases) {
  bench_.expect_ok("export-problem --mesh=Mesh1 --format=fclib --out=other");
  std::filesystem::create_directories(bench_.path("folder"));
  testing::write_text(bench_.path("folder/one.dat"), "2\n1\n0\n2\n2\n2 2\n1 0 0 1\n-1 0.5\n0.5\n");
  testing::write_text(bench_.path("folder/no_problem.txt"), "text");
  const testing::EnvironmentVariable to_draw("AIRYBENCH_TO_DRAW", "drawn");
  const auto ran = bench_.expect_ok(
      "--problem=fclib/problem.hdf5,other/problem.hdf5,folder --contact=newton --repetitions=1 "
      "--out=o");
  EXPECT_FALSE(std::filesystem::exists(bench_.path("drawn")));  // no body, no figure
  EXPECT_FALSE(testing::contains(ran.out, "--fields"));         // nor a picture
  std::vector<std::string> names;
  for (const Json& record : bench_.records()) names.push_back(record["mesh"]);
  EXPECT_EQ(names, (std::vector<std::string>{"Mesh0-default", "Mesh1-default", "one"}));
}

// Each precision has a run that stops there, and not before.
TEST_F(GivenProblemCommand, TheContactStudyRunsToTwoPrecisions) {
  const testing::EnvironmentVariable to_draw("AIRYBENCH_TO_DRAW", "drawn");
  const auto ran = run("--study=contact");
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(std::filesystem::exists(bench_.path("drawn")));
  const std::vector<Json> records = bench_.records();
  ASSERT_EQ(records.size(), 8u);
  std::set<std::string> cases;
  std::map<std::string, int> iterations;  // of the looser precision
  for (const Json& record : records) {
    const auto precision = record["knob_value"].get<double>();
    const std::string solver = record["contact_solver"];
    SCOPED_TRACE(solver + " to " + std::to_string(precision));
    EXPECT_EQ(record["status"], "ok");
    EXPECT_EQ(record["knob"], "tolerance");
    EXPECT_EQ(record["target_error"], precision);
    EXPECT_LE(record["natural_map_residual"], precision / 10);
    EXPECT_LE(record["siconos_error"], precision);
    cases.insert(solver + (precision == 1e-4 ? " 1e-4" : precision == 1e-8 ? " 1e-8" : " other"));
    const int count = record["contact_iterations"];
    if (solver == "newton") continue;  // its active sets end at once
    if (precision == 1e-4)
      iterations[solver] = count;
    else
      EXPECT_LT(iterations.at(solver), count);
  }
  EXPECT_EQ(cases.size(), 8u);
  EXPECT_FALSE(cases.contains("newton other"));
}

TEST_F(GivenProblemCommand, MethodsOfBodiesAreSkipped) {
  ASSERT_EQ(run("--method=HYBRID,CONDENSED --contact=newton").code, 0);
  const std::vector<Json> records = bench_.records();
  ASSERT_EQ(records.size(), 2u);
  EXPECT_EQ(records[0]["status"], "skipped");
  EXPECT_EQ(records[0]["status_reason"], "the problem has no body");
  EXPECT_EQ(records[1]["status"], "ok");
}

TEST_F(GivenProblemCommand, PlansAreShown) {
  EXPECT_TRUE(testing::contains(run("--dry-run").out, "the run: about 0 "));
  EXPECT_TRUE(testing::contains(bench_.run("explain --problem=fclib/problem.hdf5").out,
                                "[1/4] Mesh0-default/fclib/CONDENSED  n_c 40\n"));
}

TEST_F(GivenProblemCommand, WrongUseIsRefused) {
  const std::string problem = "--problem=fclib/problem.hdf5 ";
  refused(problem + "--method=NONE", "no method matches 'NONE' (valid: ");
  for (const char* option :
       {"--mesh=Mesh0", "--scene=a.json", "--figure=3", "--study=error", "--adapt=1%", "--fields"})
    refused(problem + option, std::string(option).substr(0, std::string(option).find('=')) +
                                  ": not with --problem, which has no body");
  refused("--problem=fclib/problem.hdf5,fclib/problem.hdf5", "--problem: fclib/problem.hdf5 (allo");
  std::filesystem::create_directory(bench_.path("empty"));
  refused("--problem=empty", "--problem: empty (allowed: a folder with .hdf5, .h5 or .dat files)");
  refused("--problem=fclib/problem.json", "fclib/problem.json: cannot be opened (allowed: an HDF5");
  refused("--problem='none*.hdf5'", "none*.hdf5: cannot be opened: no such file");
}

TEST_F(GivenProblemCommand, OtherCommandsTakeItsRecords) {
  ASSERT_EQ(run("").code, 0);
  EXPECT_EQ(run("--resume").code, 0);
  for (const char* arguments : {"compare o o", "merge o --out=merged", "export o --format=csv",
                                "export o --format=google-benchmark"})
    EXPECT_EQ(bench_.run(arguments).code, 0) << arguments << ": " << bench_.content("err.txt");
  bench_.expect_refusal("replay o:1",
                        "o:1: a contact problem of --problem (allowed: cases with a mesh)\n");
}

}  // namespace
}  // namespace airybench::given_problem_command_test
