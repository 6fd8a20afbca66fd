// Other people's programs and all that they start: how they end, and that nothing is left of them.
#include "bench/external/process_tree.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>

#include "tests/support/background_run.hpp"
#include "tests/support/temporary_folder.hpp"

namespace airybench::process_tree_test {
namespace {

constexpr double patience_s = 600;  // of what is to end by itself

// Three that stay: a child, one in a session of its own whose parent has ended, the program.
constexpr const char* three = R"(
sleep 1000 & echo $! > child
( setsid sh -c 'echo $$ > orphan; exec sleep 1000' & )
while ! test -s orphan; do sleep 0.01; done
echo $$ > program.new; mv program.new program
)";

bool is_gone(pid_t process) { return kill(process, 0) != 0 && errno == ESRCH; }

class ProcessTree : public ::testing::Test {
 protected:
  Program shell(const std::string& script) const {
    return {.command = {"sh", "-c", script},
            .folder = folder_.path(),
            .output = folder_ / "printed",
            .scratch = folder_ / "scratch"};
  }
  ProcessTreeEnd run(const std::string& script, const ProcessLimits& limits = {patience_s}) const {
    return run_process_tree(shell(script), limits);
  }
  pid_t pid_in(const std::string& file) const {
    return std::stoi(testing::text_of(folder_ / file));
  }
  void expect_nobody_is_left() const {
    for (const char* file : {"child", "orphan", "program"})
      EXPECT_TRUE(is_gone(pid_in(file))) << file;
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);  // no zombie
    EXPECT_EQ(errno, ECHILD);
  }
  const testing::TemporaryFolder folder_;
};

TEST_F(ProcessTree, SaysHowTheProgramEnded) {
  EXPECT_EQ(run("exit 0").exit_code, 0);
  EXPECT_EQ(run("exit 3").exit_code, 3);
  const ProcessTreeEnd killed = run("kill -SEGV $$");
  EXPECT_EQ(killed.signal, SIGSEGV);
  EXPECT_EQ(killed.exit_code, -1);
  EXPECT_FALSE(killed.timed_out || killed.over_memory);
}

TEST_F(ProcessTree, WhatCannotBeStartedHasAnErrno) {
  Program program = shell("");
  program.command = {"no-such-program"};
  EXPECT_EQ(run_process_tree(program, {patience_s}).start_error, ENOENT);
  program = shell("exit 0");
  program.folder = folder_ / "none";
  EXPECT_EQ(run_process_tree(program, {patience_s}).start_error, ENOENT);
  testing::write_text(folder_ / "no-program", "text");
  program = shell("");
  program.command = {"./no-program"};
  EXPECT_EQ(run_process_tree(program, {patience_s}).start_error, EACCES);
  program = shell("exit 0");
  program.output = folder_.path();
  EXPECT_EQ(run_process_tree(program, {patience_s}).start_error, EISDIR);
}

TEST_F(ProcessTree, InputIsEmptyPrintsAreKeptAndNoFilesAreInherited) {
  const std::string script = "cat; echo to stdout; echo to stderr >&2; echo $OWN; ls /proc/self/fd";
  const int open_here = dup(1);
  Program program = shell(script);
  program.environment = {{"OWN", "its own"}};
  EXPECT_EQ(run_process_tree(program, {patience_s}).exit_code, 0);
  close(open_here);
  EXPECT_EQ(testing::text_of(folder_ / "printed"),
            "to stdout\nto stderr\nits own\n0\n1\n2\n3\n");  // 3: the folder that ls reads
}

TEST_F(ProcessTree, WhatTheProgramLeavesBehindIsEnded) {
  EXPECT_EQ(run(three).exit_code, 0);
  expect_nobody_is_left();
}

TEST_F(ProcessTree, TheTimeLimitEndsAll) {
  const ProcessTreeEnd end = run(std::string(three) + "sleep 1000", {0.5});
  EXPECT_TRUE(end.timed_out);
  EXPECT_NE(end.exit_code, 0);
  EXPECT_FALSE(end.over_memory);
  if (std::filesystem::exists(folder_ / "program")) expect_nobody_is_left();
}

TEST_F(ProcessTree, TheMemoryLimitEndsAll) {
  const ProcessTreeEnd end = run(std::string(three) + "head -c 300M /dev/zero | tail -c 300M",
                                 {patience_s, std::int64_t{100} << 20});
  EXPECT_TRUE(end.over_memory);
  EXPECT_NE(end.exit_code, 0);
  EXPECT_FALSE(end.timed_out);
  expect_nobody_is_left();
}

TEST_F(ProcessTree, WhatItPrintsAndWritesIsLimited) {
  ProcessLimits limits = {patience_s};
  limits.file_bytes = 1 << 20;
  EXPECT_EQ(run("exec yes", limits).signal, SIGXFSZ);
  EXPECT_EQ(std::filesystem::file_size(folder_ / "printed"), 1u << 20);
  EXPECT_EQ(run("exec dd if=/dev/zero of=file bs=1M count=3", limits).signal, SIGXFSZ);
  EXPECT_EQ(run("head -c 1M /dev/zero >file", limits).exit_code, 0);
}

TEST_F(ProcessTree, MemoryIsThatOfTheLargestMoment) {
  const ProcessTreeEnd end =
      run("dd if=/dev/zero of=/dev/null bs=200M count=10", {patience_s, std::int64_t{1} << 30});
  EXPECT_EQ(end.exit_code, 0);
  EXPECT_GE(end.peak_bytes, std::int64_t{200} << 20);
  EXPECT_LE(end.peak_bytes, std::int64_t{230} << 20);
  const std::int64_t little = run("sleep 0.1").peak_bytes;  // not that of the test, its parent
  EXPECT_GT(little, 0);
  EXPECT_LE(little, std::int64_t{8} << 20);
}

TEST_F(ProcessTree, WhoEndsItsGuardianIsNoAnswer) {
  EXPECT_THROW(run("kill -KILL $PPID; sleep 1000"), std::runtime_error);
}

// The caller ends by this signal, which all of its process group gets.
class CallerEnded : public ProcessTree, public ::testing::WithParamInterface<int> {};

TEST_P(CallerEnded, EverythingEndsWithIt) {
  std::filesystem::create_directories(folder_ / "scratch/input");
  const pid_t caller = fork();
  if (caller == 0) {
    setpgid(0, 0);
    std::signal(GetParam(), SIG_DFL);
    run(std::string(three) + "sleep 1000");
    _exit(0);
  }
  testing::wait_for([&] { return std::filesystem::exists(folder_ / "program"); });
  kill(GetParam() == SIGKILL ? caller : -caller, GetParam());
  int status = 0;
  waitpid(caller, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  for (const char* file : {"child", "orphan", "program"})
    testing::wait_for([&] { return is_gone(pid_in(file)); });
  testing::wait_for([&] { return !std::filesystem::exists(folder_ / "scratch"); });
}

INSTANTIATE_TEST_SUITE_P(By, CallerEnded, ::testing::Values(SIGKILL, SIGINT, SIGQUIT, SIGHUP),
                         [](const auto& of) { return std::string(sigabbrev_np(of.param)); });

}  // namespace
}  // namespace airybench::process_tree_test
