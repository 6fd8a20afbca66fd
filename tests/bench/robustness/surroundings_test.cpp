// What a run finds around it: descriptors that are closed or full, an environment that is not its
// own.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "support/messages.hpp"
#include "tests/support/other_user.hpp"
#include "tests/support/sanitized.hpp"

namespace airybench::surroundings_test {
namespace {

using testing::BenchCommand;
using testing::CommandResult;

const std::string two = "--mesh=Mesh0 --method=HYBRID,P2 --repetitions=1 --out=o ";

// Through the shell, with these redirections. -1: ended by a signal.
int redirected(const BenchCommand& bench, const std::string& arguments, const std::string& to) {
  const std::string command = "cd '" + bench.path("").string() + "' && '" +
                              testing::bench_executable().string() + "' " + arguments + " " + to;
  const int status = std::system(command.c_str());
  return WIFEXITED(status) && WEXITSTATUS(status) < 128 ? WEXITSTATUS(status) : -1;
}

class Closed : public ::testing::TestWithParam<const char*> {};
TEST_P(Closed, AreNoRecordsFile) {
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
INSTANTIATE_TEST_SUITE_P(Streams, Closed,
                         ::testing::Values("2>&-", ">&-", ">&- 2>&-", "<&- >&- 2>&-", "<&-"));

TEST(ClosedStreams, AreToldWhereTheResultGoes) {
  const BenchCommand bench;
  ASSERT_EQ(bench.run(two).code, 0);
  for (const char* arguments :
       {"export o --format=csv", "compare o o", "list", "--mesh=Mesh0 --dry-run"}) {
    EXPECT_EQ(redirected(bench, arguments, ">&- 2>err.txt"), 2) << arguments;
    EXPECT_TRUE(testing::contains(bench.content("err.txt"), "bench: standard output: is closed"))
        << arguments;
  }
  EXPECT_EQ(redirected(bench, "export o --format=csv --out=o.csv", ">&-"), 0);
}

TEST(FullStreams, AreTold) {
  const BenchCommand bench;
  ASSERT_EQ(bench.run(two).code, 0);
  for (const char* arguments :
       {"list", "--help", "--version", "compare o o", "export o --format=csv",
        "export o --format=latex", "merge o --out=m", "track --history=h --from=o",
        "--mesh=Mesh0 --method=HYBRID --repetitions=1 --out=p",
        "--mesh=Mesh0 --method=HYBRID --dry-run", "explain --mesh=Mesh0 --method=HYBRID",
        "replay o:1 --out=r"}) {
    EXPECT_EQ(redirected(bench, arguments, ">/dev/full 2>err.txt"), 2) << arguments;
    EXPECT_TRUE(testing::contains(bench.content("err.txt"),
                                  "bench: standard output: cannot be written (a full disk?)\n"))
        << arguments;
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

// BLAS would wait for memory for ever. Sanitizers take more address space than there is.
#ifndef AIRYBENCH_SANITIZED
TEST(AddressSpace, ThatIsTooSmallForBlasIsRefused) {
  const BenchCommand bench;
  for (const char* arguments : {"--threads=2 ", "list ", "compare o o "})
    for (const char* limit : {"ulimit -v 150000; ", "ulimit -v 200000; "}) {
      const CommandResult result =
          bench.run(arguments + std::string(arguments[2] == 't' ? two : ""), limit);
      EXPECT_EQ(result.code, 2) << arguments << limit;
      EXPECT_TRUE(testing::contains(result.err, "the address space is limited to 1"));
      EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
      EXPECT_FALSE(std::filesystem::exists(bench.path("o")));
    }
  EXPECT_EQ(bench.run(two + "--threads=64", "ulimit -v 4000000; ").code, 2);
  EXPECT_EQ(bench.run(two, "export OPENBLAS_NUM_THREADS=2; ulimit -v 500000; ").code, 0);
}
#endif

TEST(Limits, ThatNoCommandCanLiveWithAreTold) {
  const BenchCommand bench;
  for (const char* limit : {"ulimit -s 100; ", "ulimit -s 1023; "})
    bench.expect_refusal(two, " KiB (ulimit -s; allowed: from 1024 KiB on)", limit);
  bench.expect_refusal(two, " files can be opened (ulimit -n; allowed: from 24 on)",
                       "ulimit -n 20; ");
  EXPECT_FALSE(std::filesystem::exists(bench.path("o")));
}

TEST(Machine, WithoutProcIsNoDefectOfTheProgram) {
  if (testing::sanitized || std::system("unshare -m true 2>/dev/null") != 0)
    GTEST_SKIP() << "needs root, to take /proc away, and a program that sanitizers let do without";
  const BenchCommand bench;
  const std::string command = "cd '" + bench.path("").string() +
                              "' && unshare -m sh -c \"umount -l /proc && '" +
                              testing::bench_executable().string() + "' list\" >out.txt 2>err.txt";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_EQ(bench.content("err.txt"), "bench: /proc/self/exe: No such file or directory\n");
}

TEST(Messages, ShowWhatATerminalWouldObey) {
  EXPECT_EQ(escaped("Größe ≤ 5\t\n"), "Größe ≤ 5\t\n");
  EXPECT_EQ(escaped("a\x1b[31mb\rc\x7f"), "a\\x1b[31mb\\x0dc\\x7f");
  EXPECT_EQ(escaped("\u202Ehsm.\u2066\u200F\u061C\u0085"),
            "\\u202ehsm.\\u2066\\u200f\\u061c\\u0085");
  EXPECT_EQ(escaped("\xffx\xc3\xe2\x82"), "\\xffx\\xc3\\xe2\\x82");
}

TEST(Messages, ShowNamesEscapedAndCutWhereverTheyGo) {
  const BenchCommand bench;
  const std::string hostile = "M\u202Eod\uFEFF\x1b[31m\nbench: ok", name = std::string(5000, 'n');
  for (const char* option :
       {"--mesh=", "--scene=", "--method=", "--external=", "--problem=", "--filter=(",
        "--study=", "--role=", "--", "merge ", "replay ", "export --format=", "solve ",
        "advise --mesh=", "--repetitions=", "--timeout=", "--shard=", "--stop="}) {
    const CommandResult said = bench.run(option + ("'" + hostile + "'"));
    EXPECT_EQ(said.code, 2) << option;
    EXPECT_EQ(std::ranges::count(said.err, '\n'), 1) << said.err;
    for (const char* obeyed : {"\x1b", "\u202E", "\uFEFF"})
      EXPECT_FALSE(testing::contains(said.err, obeyed));
    const CommandResult cut = bench.run(option + ("'" + name + "'"));
    EXPECT_EQ(cut.code, 2) << option;
    EXPECT_FALSE(testing::contains(cut.err, std::string(401, 'n')));
    EXPECT_LT(cut.err.size(), 4100u) << cut.err;
  }
}

// script is a terminal. The records keep the name.
TEST(Terminal, IsGivenNoControlCharactersOfNames) {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  if (terminal < 0) GTEST_SKIP() << "this system gives no terminals: " << std::strerror(errno);
  close(terminal);
  const BenchCommand bench;
  const std::string name = "M\u202Eod";
  std::filesystem::copy(testing::mesh_file("Mesh0"), bench.path(name + ".msh"));
  const std::string command = "cd '" + bench.path("").string() + "' && script -qec \"'" +
                              testing::bench_executable().string() + "' --mesh='./" + name +
                              ".msh' --method=HYBRID --repetitions=1 --out='o\x1b[31m'\" shown.txt "
                              ">/dev/null </dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0);
  std::string shown = bench.content("shown.txt");
  shown.erase(0, shown.find('\n'));  // the command, which script wrote
  EXPECT_TRUE(testing::contains(shown, "[1/1] M\\u202eod/default/HYBRID: ok"));
  EXPECT_TRUE(testing::contains(shown, "results.json in o\\x1b[31m"));
  EXPECT_FALSE(testing::contains(shown, "\x1b"));
  EXPECT_FALSE(testing::contains(shown, "\u202E"));
  EXPECT_EQ(bench.record("o\x1b[31m")["mesh"], name);
}

// OpenMP would end the case's process, and BLAS this one.
TEST(Processes, ThatAreTooFewForTheThreadsAreRefused) {
  const BenchCommand bench;
  testing::copy_program_to(bench.path(""));
  EXPECT_EQ(testing::run_as_user(
                bench, "ulimit -u 8; OPENBLAS_NUM_THREADS=1 exec bin/bench " + two + "--threads=6"),
            2)
      << bench.content("err.txt");
  EXPECT_TRUE(testing::contains(bench.content("err.txt"), "bench: --threads: 6 (allowed: fewer"));
  EXPECT_FALSE(std::filesystem::exists(bench.path("o")));
}

TEST(Processes, OfAProgramInAFolderThatOthersCannotEnterSayWhatIsMissing) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root, to become another user";
  const BenchCommand bench;
  testing::copy_program_to(bench.path(""));
  EXPECT_EQ(testing::run_as_user(bench, "exec /proc/self/fd/9 " + two), 0)
      << bench.content("err.txt");
  std::filesystem::permissions(bench.path("bin"), std::filesystem::perms::owner_all);
  std::filesystem::permissions(bench.path("share"), std::filesystem::perms::owner_all);
  EXPECT_EQ(testing::run_as_user(bench, "exec /proc/self/fd/9 list"), 2);
  EXPECT_EQ(bench.content("err.txt"),
            "bench: " + bench.path("share/airybench/meshes").string() +
                ": the program's data cannot be read: Permission denied\n");
}

TEST(Environment, OfGoogleBenchmarkIsIgnored) {
  const BenchCommand bench;
  const CommandResult result = bench.expect_ok(
      two + " -- --benchmark_filter=.",
      "export BENCHMARK_FILTER=nothing BENCHMARK_LIST_TESTS=true BENCHMARK_BENCHMARK_FILTER=P2 "
      "BENCHMARK_BENCHMARK_LIST_TESTS=true BENCHMARK_REPETITIONS=7 BENCHMARK_MIN_TIME=5 "
      "BENCHMARK_OUT=google.json BENCHMARK_ENABLE_RANDOM_INTERLEAVING=true "
      "BENCHMARK_MIN_WARMUP_TIME=3 BENCHMARK_FORMAT=x BENCHMARK_OUT_FORMAT=x "
      "BENCHMARK_TIME_UNIT=x BENCHMARK_COLOR= BENCHMARK_CONTEXT=a=b; ");
  EXPECT_FALSE(testing::contains(result.err, "benchmark"));
  EXPECT_FALSE(testing::contains(result.err, "context"));
  ASSERT_EQ(bench.records().size(), 2u);
  for (const Json& record : bench.records()) EXPECT_EQ(record["samples_s"].size(), 1u);
  EXPECT_FALSE(std::filesystem::exists(bench.path("google.json")));
}

}  // namespace
}  // namespace airybench::surroundings_test
