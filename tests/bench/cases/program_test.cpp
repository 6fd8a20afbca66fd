#include "support/program.hpp"

#include <gtest/gtest.h>

#include <csignal>

namespace airybench::program_test {
namespace {

ProgramEnd shell(const std::string& script) { return run_program("/bin/sh", {"-c", script}); }

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

TEST(Program, ThatIsNotThere) { EXPECT_EQ(run_program("/nowhere/program", {}).exit_code, 127); }

TEST(Program, HasNoInput) { EXPECT_EQ(shell("cat").out, ""); }

TEST(Program, OfOursThatDoesNotExist) { EXPECT_FALSE(program_of_ours("no-such-program")); }

}  // namespace
}  // namespace airybench::program_test
