#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <ctime>
#include <fstream>
#include <new>
#include <stdexcept>

#include "support/file_text.hpp"
#include "support/forks.hpp"
#include "support/process.hpp"
#include "support/seconds_since.hpp"
#include "support/temporary_folder.hpp"

namespace airybench {
namespace {

class SharedEnd {
 public:
  SharedEnd()
      : page_(mmap(nullptr, sizeof(ChildEnd), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS,
                   -1, 0)) {
    if (page_ == MAP_FAILED) fail_to("a page shared with a program");
    new (page_) ChildEnd;
  }
  ~SharedEnd() { munmap(page_, sizeof(ChildEnd)); }
  SharedEnd(const SharedEnd&) = delete;
  SharedEnd& operator=(const SharedEnd&) = delete;
  ChildEnd& operator*() const { return *static_cast<ChildEnd*>(page_); }

 private:
  void* page_;
};

std::vector<pid_t> descendants(pid_t of, const std::vector<pid_t>& except = {}) {
  std::vector<pid_t> found = {of};
  for (std::size_t k = 0; k < found.size(); ++k) {
    std::error_code error;
    const std::string tasks = fmt::format("/proc/{}/task", found[k]);
    for (const auto& task : std::filesystem::directory_iterator(tasks, error)) {
      std::ifstream children(task.path() / "children");
      for (pid_t child; children >> child;)
        if (std::ranges::find(except, child) == except.end()) found.push_back(child);
    }
  }
  found.erase(found.begin());
  return found;
}

// Repeats because a process may start another while they are killed.
void end_descendants(const std::vector<pid_t>& except,
                     const std::function<void(pid_t, int status)>& reaped) {
  constexpr int max_tries = 5000;  // another user's process cannot be killed
  std::vector<pid_t> left;
  for (int k = 0; k < max_tries && !(left = descendants(getpid(), except)).empty(); ++k) {
    for (const pid_t process : left) {
      kill(process, SIGKILL);
      int status = 0;
      if (waitpid(process, &status, WNOHANG) > 0) reaped(process, status);
    }
    usleep(1000);
  }
}

bool lead(int descriptor, const std::filesystem::path& to, int flags) {
  const int file = open(to.c_str(), flags, 0666);
  return file >= 0 && dup2(file, descriptor) == descriptor;
}

// Executes the program; returns only if it cannot be started, see errno.
void become(const Program& program, const ProgramLimits& limits, const sigset_t& signals) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXFSZ}) std::signal(signal, SIG_DFL);
  sigprocmask(SIG_SETMASK, &signals, nullptr);
  rlimit file = {};
  getrlimit(RLIMIT_FSIZE, &file);
  file.rlim_max = std::min(file.rlim_max, static_cast<rlim_t>(limits.file_bytes));
  file.rlim_cur = std::min(file.rlim_cur, file.rlim_max);
  setrlimit(RLIMIT_FSIZE, &file);
  if (program.in_own_session) setsid();
  for (const auto& [name, value] : program.environment) setenv(name.c_str(), value.c_str(), 1);
  std::vector<char*> arguments;
  for (const std::string& argument : program.command)
    arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  constexpr int writing = O_WRONLY | O_CREAT | O_TRUNC;
  const bool is_ready =
      lead(0, "/dev/null", O_RDONLY) && lead(1, program.output, writing) &&
      (program.errors.empty() ? dup2(1, 2) == 2 : lead(2, program.errors, writing)) &&
      close_range(3, ~0U, CLOSE_RANGE_CLOEXEC) == 0 &&
      (program.folder.empty() || chdir(program.folder.c_str()) == 0);
  if (is_ready) execvp(arguments.front(), arguments.data());
}

double processor_s_of_children() {
  rusage used = {};
  getrusage(RUSAGE_CHILDREN, &used);
  const auto seconds = [](const timeval& t) { return t.tv_sec + 1e-6 * t.tv_usec; };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

class Guardian {
 public:
  Guardian(const Program& program, const ProgramLimits& limits, ChildEnd& end)
      : program_(program), limits_(limits), end_(end) {}

  void run(pid_t parent) {
    adopt_orphans();
    prctl(PR_SET_PDEATHSIG, SIGCONT);  // a stopped one must see that its parent has ended
    sigset_t all, before;              // the guardian must outlive a signal that ends its parent
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, &before);
    std::signal(SIGCHLD, SIG_DFL);
    std::array<int, 2> until_executed;  // its writing end is closed by execvp()
    const auto begun = std::chrono::steady_clock::now();
    if (pipe2(until_executed.data(), O_CLOEXEC) == 0)
      program_pid_ = start(WhenParentEnds::end, [&] {
        become(program_, limits_, before);
        end_.start_error = errno;
        _exit(127);
      });
    if (program_pid_ < 0) {
      end_.start_error = errno;
      return;
    }
    // Until then its memory is a copy of ours, which must not be counted.
    close(until_executed[1]);
    for (char nothing; read(until_executed[0], &nothing, 1) < 0 && errno == EINTR;) continue;
    Ticks ticks;
    double counted_s = 0;
    while (!is_over(counted_s += ticks.next().counted_s) && getppid() == parent)
      wait_for_child(counted_s);
    end_.wall_s = seconds_since(begun);
    end_descendants({}, [this](pid_t process, int status) { note(process, status); });
    end_.processor_s = processor_s_of_children();
    if (getppid() != parent) remove_folder(program_.scratch);
  }

 private:
  bool is_over(double elapsed_s) {
    std::int64_t bytes = 0;
    for (const pid_t process : descendants(getpid())) bytes += resident_peak_bytes(process);
    end_.peak_bytes = std::max(end_.peak_bytes, bytes);
    reap();
    if (has_ended_) return true;
    end_.timed_out = elapsed_s > limits_.time_s;
    end_.over_memory = limits_.memory_bytes && bytes > *limits_.memory_bytes;
    return end_.timed_out || end_.over_memory;
  }

  static void wait_for_child(double elapsed_s) {
    const timespec most = {0, static_cast<long>(1e9 * std::clamp(elapsed_s / 50, 1e-3, 10e-3))};
    sigset_t ended;
    sigemptyset(&ended);
    sigaddset(&ended, SIGCHLD);
    sigtimedwait(&ended, nullptr, &most);
  }

  void reap() {
    int status = 0;
    for (pid_t ended; (ended = waitpid(-1, &status, WNOHANG)) > 0;) note(ended, status);
  }
  void note(pid_t ended, int status) {
    if (ended != program_pid_) return;
    has_ended_ = true;
    note_status(status, end_);
  }

  const Program& program_;
  const ProgramLimits& limits_;
  ChildEnd& end_;
  pid_t program_pid_ = -1;
  bool has_ended_ = false;
};

// Waits for its end. The program may have stopped it.
int status_of(pid_t guardian) {
  int status = 0;
  for (;;) {
    const pid_t waited = waitpid(guardian, &status, WUNTRACED);
    if (waited < 0 && errno != EINTR) return 0;
    if (waited == guardian && !WIFSTOPPED(status)) return status;
    kill(guardian, SIGCONT);
  }
}

}  // namespace

void adopt_orphans() { prctl(PR_SET_CHILD_SUBREAPER, 1); }

void end_others_than(const std::vector<pid_t>& children) {
  end_descendants(children, [](pid_t, int) {});
}

ChildEnd run_program(const Program& program, const ProgramLimits& limits) {
  const SharedEnd end;
  const pid_t parent = getpid();
  const std::vector<pid_t> others = descendants(parent);
  const auto oom_kills_before = oom_kills();
  int adopts = 0;
  prctl(PR_GET_CHILD_SUBREAPER, &adopts);
  adopt_orphans();  // of a guardian that is killed
  const pid_t guardian =
      start(WhenParentEnds::go_on, [&] { Guardian(program, limits, *end).run(parent); });
  const int error = errno;
  const int status = guardian < 0 ? 0 : status_of(guardian);
  const bool is_killed = !WIFEXITED(status) || WEXITSTATUS(status) != 0;
  if (is_killed) end_others_than(others);
  prctl(PR_SET_CHILD_SUBREAPER, adopts);
  if (guardian < 0) fail_to("a program's process", error);
  if (is_killed) throw std::runtime_error("the program's guardian was ended");
  ChildEnd ended = *end;
  note_oom_kill(oom_kills_before, ended);
  return ended;
}

ProgramEnd run_program(const std::filesystem::path& program,
                       const std::vector<std::string>& arguments, double time_limit_s) {
  const TemporaryFolder work;
  Program ours = {.command = {program.string()},
                  .output = work.path() / "out",
                  .errors = work.path() / "err",
                  .scratch = work.path(),
                  .in_own_session = false};
  ours.command.insert(ours.command.end(), arguments.begin(), arguments.end());
  const ChildEnd end = run_program(ours, {.time_s = time_limit_s});
  if (end.start_error != 0) return {end, {}, {}};
  return {end, file_text(ours.output), file_text(ours.errors)};
}

}  // namespace airybench
