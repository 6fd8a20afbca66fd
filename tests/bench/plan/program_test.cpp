#include "support/program.hpp"

#include <gtest/gtest.h>

#include <csignal>

namespace airybench::program_test {
namespace {

constexpr double patience_s = 600;

ProgramEnd shell(const std::string& script, double time_limit_s = patience_s) {
  return run_program("/bin/sh", {"-c", script}, time_limit_s);
}

TEST(Program, OutputAndExitCode) {
  const ProgramEnd end = shell("echo out; echo err >&2; exit 7");
  EXPECT_EQ(end.exit_code, 7);
  EXPECT_EQ(end.signal, 0);
  EXPECT_EQ(end.out, "out\n");
  EXPECT_EQ(end.err, "err\n");
}

TEST(Program, MoreThanAPipeHolds) {
  const ProgramEnd end = shell("head -c 300000 /dev/zero >&2; head -c 300000 /dev/zero");
  EXPECT_EQ(end.exit_code, 0);
  EXPECT_EQ(end.out.size(), 300000u);
  EXPECT_EQ(end.err.size(), 300000u);
}

TEST(Program, EndedByASignal) {
  const ProgramEnd end = shell("kill -SEGV $$");
  EXPECT_EQ(end.signal, SIGSEGV);
  EXPECT_EQ(end.exit_code, -1);
}

TEST(Program, IsEndedAtItsTimeLimit) {
  const ProgramEnd end = shell("echo begun; exec sleep 1000", 0.5);
  EXPECT_TRUE(end.timed_out);
  EXPECT_EQ(end.signal, SIGKILL);
  EXPECT_FALSE(shell("exit 0").timed_out);
}

TEST(Program, ThatIsNotThere) {
  EXPECT_EQ(run_program("/nowhere/program", {}, patience_s).exit_code, 127);
}

TEST(Program, HasNoInput) { EXPECT_EQ(shell("cat").out, ""); }

TEST(Program, OfOursThatDoesNotExist) { EXPECT_FALSE(program_of_ours("no-such-program")); }

}  // namespace
}  // namespace airybench::program_test
