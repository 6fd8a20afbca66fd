#include "bench/external/process_tree.hpp"

#include <fcntl.h>
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
#include <stdexcept>
#include <system_error>

#include "support/seconds_since.hpp"

namespace airybench {
namespace {

// A short life is looked at more often.
timespec until_next_look(double elapsed_s) {
  const double wait_s = std::clamp(elapsed_s / 50, 1e-3, 10e-3);
  return {0, static_cast<long>(wait_s * 1e9)};
}

// All processes below this one, the nearest first.
std::vector<pid_t> descendants(pid_t of) {
  std::vector<pid_t> found = {of};
  for (std::size_t k = 0; k < found.size(); ++k) {
    std::error_code error;
    const std::string tasks = "/proc/" + std::to_string(found[k]) + "/task";
    for (const auto& task : std::filesystem::directory_iterator(tasks, error)) {
      std::ifstream children(task.path() / "children");
      for (pid_t child; children >> child;) found.push_back(child);
    }
  }
  found.erase(found.begin());
  return found;
}

std::int64_t resident_peak_bytes(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024 * std::stoll(line.substr(6));
  return 0;  // it has ended
}

// The program's own process, up to its first instruction. An errno into the pipe: it has none.
[[noreturn]] void become(const Program& program, const ProcessLimits& limits, int error_pipe,
                         const sigset_t& signals) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXFSZ}) std::signal(signal, SIG_DFL);
  sigprocmask(SIG_SETMASK, &signals, nullptr);
  rlimit file = {};
  getrlimit(RLIMIT_FSIZE, &file);
  file.rlim_max = std::min(file.rlim_max, static_cast<rlim_t>(limits.file_bytes));
  file.rlim_cur = std::min(file.rlim_cur, file.rlim_max);
  setrlimit(RLIMIT_FSIZE, &file);
  setsid();  // the terminal's signals are not for it
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int input = open("/dev/null", O_RDONLY);
  const int output = open(program.output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  for (const auto& [name, value] : program.environment) setenv(name.c_str(), value.c_str(), 1);
  std::vector<char*> arguments;
  for (const std::string& argument : program.command)
    arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  if (input >= 0 && output >= 0 && dup2(input, 0) == 0 && dup2(output, 1) == 1 &&
      dup2(output, 2) == 2 && close_range(3, ~0U, CLOSE_RANGE_CLOEXEC) == 0 &&
      chdir(program.folder.c_str()) == 0)
    execvp(arguments.front(), arguments.data());
  const int error = errno;
  if (write(error_pipe, &error, sizeof error) != sizeof error) _exit(126);
  _exit(127);
}

// Runs in the guardian.
class Guardian {
 public:
  Guardian(const Program& program, const ProcessLimits& limits, pid_t parent)
      : program_(program), limits_(limits), parent_(parent) {
    prctl(PR_SET_CHILD_SUBREAPER, 1);
    sigemptyset(&waited_for_);
    sigaddset(&waited_for_, SIGCHLD);
    sigset_t all;  // it ends when its parent has ended, not with it
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, &signals_before_);
    std::signal(SIGCHLD, SIG_DFL);
  }

  ProcessTreeEnd run() {
    const auto start = std::chrono::steady_clock::now();
    if (!begin()) return end_;
    for (;;) {  // the first look at once: it may be short
      std::int64_t bytes = 0;
      for (const pid_t process : descendants(getpid())) bytes += resident_peak_bytes(process);
      end_.peak_bytes = std::max(end_.peak_bytes, bytes);
      reap(WNOHANG);
      if (has_ended_) break;
      end_.timed_out = seconds_since(start) > limits_.time_s;
      end_.over_memory = limits_.memory_bytes && bytes > *limits_.memory_bytes;
      if (getppid() != parent_ || end_.timed_out || end_.over_memory) break;
      const timespec look = until_next_look(seconds_since(start));
      sigtimedwait(&waited_for_, nullptr, &look);
    }
    end_.wall_s = seconds_since(start);
    end_all();
    if (std::error_code ignored; getppid() != parent_)
      std::filesystem::remove_all(program_.scratch, ignored);
    return end_;
  }

 private:
  bool begin() {
    std::array<int, 2> errors;
    if (pipe2(errors.data(), O_CLOEXEC) != 0) {
      end_.start_error = errno;
      return false;
    }
    program_pid_ = fork();
    if (program_pid_ == 0) become(program_, limits_, errors[1], signals_before_);
    end_.start_error = program_pid_ < 0 ? errno : 0;
    close(errors[1]);
    int error = 0;
    if (program_pid_ > 0 && read(errors[0], &error, sizeof error) == sizeof error)
      end_.start_error = error;
    close(errors[0]);
    return end_.start_error == 0;
  }

  void reap(int flags) {
    int status = 0;
    for (pid_t ended; (ended = waitpid(-1, &status, flags)) > 0;) {
      if (ended != program_pid_) continue;
      has_ended_ = true;
      if (WIFEXITED(status)) end_.exit_code = WEXITSTATUS(status);
      if (WIFSIGNALED(status)) end_.signal = WTERMSIG(status);
    }
  }

  // One may start another while they are killed: until there is none.
  void end_all() {
    for (std::vector<pid_t> left; !(left = descendants(getpid())).empty();) {
      for (const pid_t process : left) kill(process, SIGKILL);
      reap(WNOHANG);
      usleep(1000);
    }
  }

  const Program& program_;
  const ProcessLimits& limits_;
  const pid_t parent_;
  sigset_t signals_before_, waited_for_;
  pid_t program_pid_ = -1;
  bool has_ended_ = false;
  ProcessTreeEnd end_;
};

}  // namespace

ProcessTreeEnd run_process_tree(const Program& program, const ProcessLimits& limits) {
  std::array<int, 2> answer;
  if (pipe2(answer.data(), O_CLOEXEC) != 0)
    throw std::system_error(errno, std::generic_category(), "a line to a program");
  const pid_t parent = getpid();
  const pid_t guardian = fork();
  if (guardian == 0) {
    close(answer[0]);
    const ProcessTreeEnd end = Guardian(program, limits, parent).run();
    _exit(write(answer[1], &end, sizeof end) == sizeof end ? 0 : 1);
  }
  const int error = errno;
  close(answer[1]);
  ProcessTreeEnd end;
  ssize_t got = 0;
  if (guardian > 0) {
    do got = read(answer[0], &end, sizeof end);
    while (got < 0 && errno == EINTR);
    while (waitpid(guardian, nullptr, 0) < 0 && errno == EINTR) continue;
  }
  close(answer[0]);
  if (guardian < 0) throw std::system_error(error, std::generic_category(), "a program's process");
  if (got != sizeof end) throw std::runtime_error("the program's guardian was ended");
  return end;
}

}  // namespace airybench
