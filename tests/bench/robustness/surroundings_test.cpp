// What a run finds around it: descriptors that are closed or full, an environment that is not its
// own.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/bench_command.hpp"

namespace airybench::surroundings_test {
namespace {

using testing::BenchCommand;
using testing::CommandResult;
using testing::text_of;

const std::string two = "--mesh=Mesh0 --method=HYBRID,P2 --repetitions=1 --out=o ";

// Through the shell, with these redirections. -1: ended by a signal.
int redirected(const BenchCommand& bench, const std::string& arguments, const std::string& to) {
  const std::string command = "cd '" + bench.path("").string() + "' && '" +
                              testing::bench_executable().string() + "' " + arguments + " " + to;
  const int status = std::system(command.c_str());
  return WIFEXITED(status) && WEXITSTATUS(status) < 128 ? WEXITSTATUS(status) : -1;
}

class ClosedStreams : public ::testing::TestWithParam<const char*> {};
TEST_P(ClosedStreams, AreNoRecordsFile) {
  const BenchCommand bench;
  EXPECT_EQ(redirected(bench, two, GetParam()), 0);
  const std::vector<Json> records = bench.records();
  ASSERT_EQ(records.size(), 2u);
  for (const Json& record : records) {
    EXPECT_EQ(record["mesh"], "Mesh0");
    EXPECT_EQ(record["status"], "ok") << record["status_reason"];
  }
  EXPECT_EQ(bench.run(two + "--resume").code, 0) << "the folder can be read";
}
INSTANTIATE_TEST_SUITE_P(All, ClosedStreams,
                         ::testing::Values("2>&-", ">&-", ">&- 2>&-", "<&- >&- 2>&-", "<&-"));

TEST(FullStreams, AreTold) {
  const BenchCommand bench;
  ASSERT_EQ(bench.run(two).code, 0);
  for (const char* arguments :
       {"--list", "--help", "--version", "compare o o", "claims o", "export o --format=csv",
        "export o --format=junit", "merge o --out=m", "track --history=h --from=o",
        "--mesh=Mesh0 --method=HYBRID --repetitions=1 --out=p",
        "--mesh=Mesh0 --method=HYBRID --dry-run", "--mesh=Mesh0 --method=HYBRID --explain",
        "replay o:1 --out=r"}) {
    EXPECT_EQ(redirected(bench, arguments, ">/dev/full 2>err.txt"), 2) << arguments;
    EXPECT_NE(
        bench.content("err.txt").find("bench: standard output: cannot be written (a full disk?)\n"),
        std::string::npos)
        << arguments << ": " << bench.content("err.txt");
  }
  EXPECT_EQ(bench.records("p").size(), 1u) << "what was measured is in the folder";
}

TEST(FullStreams, OfErrorsEndNoRun) {
  const BenchCommand bench;
  EXPECT_EQ(redirected(bench, two, "2>/dev/full >out.txt"), 2);
  EXPECT_EQ(bench.records().size(), 2u);
  EXPECT_EQ(redirected(bench, "--mesh=Mesh9", "2>/dev/full"), 2);
  EXPECT_EQ(redirected(bench, "--mesh=Mesh9", "2>/dev/full >/dev/full"), 2);
}

TEST(Environment, OfGoogleBenchmarkIsIgnored) {
  for (const char* variable :
       {"BENCHMARK_FILTER=nothing", "BENCHMARK_FILTER=P2", "BENCHMARK_LIST_TESTS=true",
        "BENCHMARK_BENCHMARK_FILTER=P2", "BENCHMARK_BENCHMARK_LIST_TESTS=true",
        "BENCHMARK_REPETITIONS=7", "BENCHMARK_MIN_TIME=5", "BENCHMARK_OUT=google.json",
        "BENCHMARK_ENABLE_RANDOM_INTERLEAVING=true", "BENCHMARK_MIN_WARMUP_TIME=3"}) {
    const BenchCommand bench;
    const CommandResult result = bench.run(two, std::string("export ") + variable + "; ");
    EXPECT_EQ(result.code, 0) << variable << result.err;
    const std::vector<Json> records = bench.records();
    EXPECT_EQ(records.size(), 2u) << variable;
    for (const Json& record : records) EXPECT_EQ(record["samples_s"].size(), 1u) << variable;
    EXPECT_FALSE(std::filesystem::exists(bench.path("google.json")));
  }
}

}  // namespace
}  // namespace airybench::surroundings_test
