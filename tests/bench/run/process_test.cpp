// Processes: how they end, what is told of it, and that nothing is left of them.
#include "support/process.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "support/data_folder.hpp"
#include "support/errors.hpp"
#include "support/time_limit.hpp"
#include "tests/support/background_run.hpp"
#include "tests/support/environment_variable.hpp"
#include "tests/support/test_folder.hpp"

namespace airybench::process_test {
namespace {

constexpr double patience_s = 600;  // of what is to end by itself

bool is_gone(pid_t process) { return kill(process, 0) != 0 && errno == ESRCH; }

class ProcessTree : public ::testing::Test {
 protected:
  Program shell(const std::string& script) const {
    return {.command = {"sh", "-c", script},
            .folder = folder_.path(),
            .output = folder_ / "printed",
            .scratch = folder_ / "scratch"};
  }
  ChildEnd run(const std::string& script, const ProgramLimits& limits = {patience_s}) const {
    return run_program(shell(script), limits);
  }
  pid_t pid_in(const std::string& file) const {
    return std::stoi(testing::text_of(folder_ / file));
  }
  const testing::TemporaryFolder folder_;
};

// Three that stay: a child, one in another session whose parent has ended, the program.
constexpr const char* three = R"(
sleep 1000 & echo $! > child
( setsid sh -c 'echo $$ > orphan; exec sleep 1000' & )
while ! test -s orphan; do sleep 0.01; done
echo $$ > program.new; mv program.new program
)";

class ProcessTreeWithOrphan : public ProcessTree {
 protected:
  void SetUp() override {
    if (prctl(PR_SET_CHILD_SUBREAPER, 0) != 0)  // this process is none now
      GTEST_SKIP() << "nobody can adopt orphans here: prctl(PR_SET_CHILD_SUBREAPER) fails: "
                   << std::strerror(errno);
  }
  void expect_nobody_is_left() const {
    for (const char* file : {"child", "orphan", "program"})
      EXPECT_TRUE(is_gone(pid_in(file))) << file;
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);  // no zombie
    EXPECT_EQ(errno, ECHILD);
  }
};

TEST_F(ProcessTree, SaysHowTheProgramEnded) {
  EXPECT_EQ(run("exit 0").exit_code, 0);
  EXPECT_EQ(run("exit 3").exit_code, 3);
  const ChildEnd killed = run("kill -SEGV $$");
  EXPECT_EQ(killed.signal, SIGSEGV);
  EXPECT_EQ(killed.exit_code, -1);
  EXPECT_FALSE(killed.timed_out || killed.over_memory);
}

TEST_F(ProcessTree, WhatCannotBeStartedHasAnErrno) {
  testing::write_text(folder_ / "no-program", "text");
  const auto expect = [&](int error, const auto& change) {
    Program program = shell("exit 0");
    change(program);
    EXPECT_EQ(run_program(program, {patience_s}).start_error, error);
  };
  expect(ENOENT, [](Program& program) { program.command = {"no-such-program"}; });
  expect(ENOENT, [&](Program& program) { program.folder = folder_ / "none"; });
  expect(EACCES, [](Program& program) { program.command = {"./no-program"}; });
  expect(EISDIR, [&](Program& program) { program.output = folder_.path(); });
}

TEST_F(ProcessTree, WhatOneOfOursPrintsIsText) {
  const auto shell = [](const char* script) {
    return run_program("/bin/sh", {"-c", script}, patience_s);
  };
  const ProgramEnd end = shell("cat; echo out; echo err >&2; exit 7");
  EXPECT_EQ(end.exit_code, 7);
  EXPECT_EQ(end.out, "out\n");
  EXPECT_EQ(end.err, "err\n");
  const ProgramEnd much = shell("head -c 300000 /dev/zero >&2; head -c 300000 /dev/zero");
  EXPECT_EQ(much.out.size(), 300000u);
  EXPECT_EQ(much.err.size(), 300000u);
  EXPECT_FALSE(program_of_ours("no-such-program"));
}

TEST_F(ProcessTree, InputIsEmptyPrintsAreKeptAndNoFilesAreInherited) {
  const std::string script = "cat; echo to stdout; echo to stderr >&2; echo $OWN; ls /proc/self/fd";
  const int open_here = dup(1);
  Program program = shell(script);
  program.environment = {{"OWN", "its own"}};
  EXPECT_EQ(run_program(program, {patience_s}).exit_code, 0);
  close(open_here);
  EXPECT_EQ(testing::text_of(folder_ / "printed"),
            "to stdout\nto stderr\nits own\n0\n1\n2\n3\n");  // 3: the folder that ls reads
}

TEST_F(ProcessTreeWithOrphan, WhatTheProgramLeavesBehindIsEnded) {
  EXPECT_EQ(run(three).exit_code, 0);
  expect_nobody_is_left();
}

TEST_F(ProcessTreeWithOrphan, TheTimeLimitEndsAll) {
  const ChildEnd end = run(std::string(three) + "sleep 1000", {0.5});
  EXPECT_TRUE(end.timed_out);
  EXPECT_EQ(end.signal, SIGKILL);
  EXPECT_FALSE(end.over_memory);
  if (std::filesystem::exists(folder_ / "program")) expect_nobody_is_left();
}

TEST_F(ProcessTreeWithOrphan, TheMemoryLimitEndsAll) {
  const ChildEnd end = run(std::string(three) + "head -c 300M /dev/zero | tail -c 300M",
                           {patience_s, std::int64_t{100} << 20});
  EXPECT_TRUE(end.over_memory);
  EXPECT_NE(end.exit_code, 0);
  EXPECT_FALSE(end.timed_out);
  expect_nobody_is_left();
}

TEST_F(ProcessTree, WhatItPrintsAndWritesIsLimited) {
  ProgramLimits limits = {patience_s};
  limits.file_bytes = 1 << 20;
  EXPECT_EQ(run("exec yes", limits).signal, SIGXFSZ);
  EXPECT_EQ(std::filesystem::file_size(folder_ / "printed"), 1u << 20);
  EXPECT_EQ(run("exec dd if=/dev/zero of=file bs=1M count=3", limits).signal, SIGXFSZ);
  EXPECT_EQ(run("head -c 1M /dev/zero >file", limits).exit_code, 0);
}

TEST_F(ProcessTree, MemoryIsThatOfTheLargestMoment) {
  const ChildEnd end =
      run("dd if=/dev/zero of=/dev/null bs=200M count=10", {patience_s, std::int64_t{1} << 30});
  EXPECT_EQ(end.exit_code, 0);
  EXPECT_GE(end.peak_bytes, std::int64_t{200} << 20);
  EXPECT_LE(end.peak_bytes, std::int64_t{230} << 20);
}

TEST_F(ProcessTree, MemoryIsNotThatOfItsParent) {
  const std::string ballast(std::size_t{64} << 20, 'x');
  std::int64_t max_bytes = 0;  // of each 0, if it ended before the first check
  for (int k = 0; k < 5; ++k) max_bytes = std::max(max_bytes, run("sleep 0.1").peak_bytes);
  EXPECT_GT(max_bytes, 0);
  EXPECT_LE(max_bytes, std::int64_t{8} << 20);
}

TEST_F(ProcessTreeWithOrphan, WhoEndsItsGuardianIsNoAnswer) {
  EXPECT_THROW(run(std::string(three) + "kill -KILL $PPID; sleep 1000"), std::runtime_error);
  expect_nobody_is_left();
}

TEST_F(ProcessTree, WhoStopsItsGuardianIsEnded) {
  EXPECT_EQ(run("kill -STOP $PPID; sleep 0.1; exit 3").exit_code, 3);
  EXPECT_TRUE(run("kill -STOP $PPID; sleep 1000", {0.5}).timed_out);
}

// Suspends a process and its guardian for longer than the limit, as a scheduler does.
TEST_F(ProcessTree, ASuspensionOfAllDoesNotCount) {
  const pid_t caller = fork();
  if (caller == 0) {
    const ChildEnd end = run("echo $PPID > guardian; sleep 0.5; echo $$ > program", {3});
    _exit(end.timed_out ? 1 : end.exit_code);
  }
  testing::wait_for([&] { return !testing::text_of(folder_ / "guardian").empty(); });
  const std::vector<pid_t> all = {caller, pid_in("guardian")};
  for (const pid_t process : all) kill(process, SIGSTOP);
  std::this_thread::sleep_for(std::chrono::seconds(4));
  for (const pid_t process : all) kill(process, SIGCONT);
  int status = 0;
  waitpid(caller, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

// The caller ends by this signal, which all of its process group gets.
class CallerEnded : public ProcessTreeWithOrphan, public ::testing::WithParamInterface<int> {};

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

TEST(ChildProcess, AnswersUntilItEnds) {
  ChildProcess child([](Channel& channel) {
    while (const auto line = channel.receive()) channel.send("you said " + *line);
  });
  EXPECT_EQ(child.ask("yes"), "you said yes");
  const std::string text(1 << 20, 'x');  // more than a socket holds
  EXPECT_EQ(child.ask(text).value_or("").size(), text.size() + 9);
}

TEST(ChildProcess, ThatClosesTheLineIsReapedAllTheSame) {
  ChildProcess child([](Channel&) {
    for (int descriptor = 3; descriptor < 64; ++descriptor) close(descriptor);
    for (;;) pause();
  });
  EXPECT_FALSE(child.ask("are you there"));
  EXPECT_EQ(child.end().signal, SIGKILL);
  EXPECT_TRUE(child.end().lingered);
}

TEST(ChildProcess, SaysThatItWasSuspended) {
  ChildProcess child([](Channel& channel) {
    while (const auto line = channel.receive()) {
      if (*line == "stop") std::raise(SIGSTOP);
      channel.send("here");
    }
  });
  EXPECT_EQ(child.ask("are you there"), "here");
  int asked = 0;
  EXPECT_EQ(child.ask("stop",
                      [&](double) {
                        if (++asked == 3) kill(testing::children_of(getpid()).back(), SIGCONT);
                        return false;
                      }),
            "here");
  EXPECT_TRUE(child.was_suspended());
}

TEST(TimeLimit, EndsItsProcessWhileItLives) {
  ChildProcess child([](Channel& channel) {
    { const TimeLimit limit(1e-3, "this is not printed"); }
    channel.receive();
    channel.send("past it");
    channel.receive();
    const TimeLimit limit(0.01, "(of a test: it took too long)");
    for (;;) pause();
  });
  EXPECT_EQ(child.ask("first"), "past it");
  EXPECT_FALSE(child.ask("second"));
  EXPECT_EQ(child.end().exit_code, wrong_usage);
}

TEST(TemporaryFolder, OfAKilledProcessIsRemovedByTheNextRun) {
  const testing::TemporaryFolder place;
  const testing::EnvironmentVariable parent("TMPDIR", place.path().string());
  const testing::TemporaryFolder in_use;
  std::filesystem::create_directories(place / "other/content");
  std::filesystem::create_directory_symlink("other", in_use.path().string() + "link");
  const pid_t killed = fork();
  if (killed == 0) {
    const testing::TemporaryFolder left;
    testing::write_text(left / "file", "text");
    std::raise(SIGKILL);
  }
  waitpid(killed, nullptr, 0);
  const auto count = [&] {
    return std::distance(std::filesystem::directory_iterator(place.path()), {});
  };
  EXPECT_EQ(count(), 4);
  remove_abandoned_folders();
  EXPECT_EQ(count(), 3);
  EXPECT_TRUE(std::filesystem::exists(in_use.path()));
  EXPECT_TRUE(std::filesystem::exists(place / "other/content"));
}

// As an ordinary user, and with few descriptors.
TEST(TemporaryFolder, IsRemovedAtAnyDepthAndWithoutPermissions) {
  const testing::TemporaryFolder place;
  std::filesystem::permissions(place.path(), std::filesystem::perms::all);
  const pid_t user = fork();
  if (user == 0) {
    if (geteuid() == 0 && setuid(65534) != 0) _exit(1);
    const testing::EnvironmentVariable parent("TMPDIR", place.path().string());
    const testing::TemporaryFolder folder;
    std::filesystem::create_directory_symlink("..", folder / "link");
    std::filesystem::create_directories(folder / "closed/inner/file");
    int inside = open(folder.path().c_str(), O_RDONLY | O_DIRECTORY);
    for (int depth = 0; depth < 5000; ++depth) {  // of names longer than paths may be
      const int outside = std::exchange(inside, -1);
      mkdirat(outside, "folder", 0700);
      inside = openat(outside, "folder", O_RDONLY | O_DIRECTORY);
      close(outside);
    }
    close(inside);
    for (const char* closed : {"closed/inner", "closed", "folder"})
      std::filesystem::permissions(folder / closed, std::filesystem::perms::none);
    chmod(folder.path().c_str(), 0);
  }
  if (user == 0) _exit(0);
  int status = 0;
  waitpid(user, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(std::filesystem::is_empty(place.path()));
}

// Whom the kernel killed is what its counters say: the control group's, else the machine's.
TEST(OomKills, AreTheKernelsCount) {
  const testing::TemporaryFolder root;
  EXPECT_EQ(oom_kills(root.path()), std::nullopt);
  for (const char* folder : {"proc/self", "sys/fs/cgroup/job/run"})
    std::filesystem::create_directories(root / folder);
  testing::write_text(root / "proc/vmstat", "nr_free_pages 81\noom_kill 4\nswap_ra 0\n");
  EXPECT_EQ(oom_kills(root.path()), 4);
  testing::write_text(root / "proc/self/cgroup", "1:cpu:/\n0::/job/run\n");
  EXPECT_EQ(oom_kills(root.path()), 4) << "the group has no count";
  testing::write_text(root / "sys/fs/cgroup/job/run/memory.events",
                      "low 0\nhigh 7\nmax 9\noom 3\noom_kill 2\noom_group_kill 1\n");
  EXPECT_EQ(oom_kills(root.path()), 2);
}

}  // namespace
}  // namespace airybench::process_test
