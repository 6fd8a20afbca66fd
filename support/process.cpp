#include "support/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <exception>
#include <fstream>
#include <iostream>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "support/file_text.hpp"
#include "support/seconds_since.hpp"
#include "support/temporary_folder.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

constexpr int poll_ms = 100;

double now_s(clockid_t clock) {
  timespec now = {};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Called several times a second. A call that is late tells that this process was suspended, by
// SIGSTOP or a freezer; CLOCK_BOOTTIME tells it of a suspended machine, whose other clocks stop.
class Ticks {
 public:
  struct Tick {
    double counted_s, suspended_s;  // since the last tick, together
    bool is_late;
  };
  Tick next() {
    constexpr double longest_s = 1;
    const double since_s = passed_s(CLOCK_MONOTONIC, last_s_);
    const double counted_s = std::min(since_s, longest_s);
    return {counted_s, since_s - counted_s, passed_s(CLOCK_BOOTTIME, last_boot_s_) > longest_s};
  }

 private:
  static double passed_s(clockid_t clock, double& last_s) {
    const double now = now_s(clock);
    return now - std::exchange(last_s, now);
  }
  double last_s_ = now_s(CLOCK_MONOTONIC), last_boot_s_ = now_s(CLOCK_BOOTTIME);
};

[[noreturn]] void fail_to(const char* what, int error = errno) {
  throw std::system_error(error, std::generic_category(), what);
}

bool is_closed(int error) { return error == EPIPE || error == ECONNRESET; }

enum class WhenParentEnds { end, go_on };
pid_t start(WhenParentEnds then, const std::function<void()>& body) {
  const pid_t parent = getpid(), child = fork();
  if (child != 0) return child;
  if (then == WhenParentEnds::end) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(0);  // the parent ended before prctl()
  }
  [&]() noexcept { body(); }();  // an exception would unwind into the parent's part of the stack
  _exit(0);                      // no destructors, no buffers: they are the parent's
}

void note_status(int status, ChildEnd& end) {
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
}

void run_child(const std::function<void(Channel&)>& body, Channel& channel) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_IGN);
  // The kernel kills this process first if memory runs out; no core dump fills the disk.
  std::ofstream("/proc/self/oom_score_adj") << 1000;
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  end_for_lack_of_memory_with("", no_memory_exit_code);
  try {
    body(channel);
  } catch (const std::bad_alloc&) {
    _exit(no_memory_exit_code);
  } catch (const std::exception& error) {
    std::cerr << fmt::format("bench: in a child process: {}\n", error.what());
    _exit(1);
  }
}

}  // namespace

std::string signal_name(int signal) {
  const char* name = sigabbrev_np(signal);
  return name == nullptr ? fmt::format("signal {}", signal) : fmt::format("SIG{}", name);
}

std::string how_it_ended(const ChildEnd& end, double limit_s) {
  if (end.start_error != 0)
    return "cannot be started: " + std::generic_category().message(end.start_error);
  if (end.channel_error != 0)
    return "cannot be asked: " + std::generic_category().message(end.channel_error);
  if (end.timed_out) return fmt::format("was ended after the limit of {:.3g} s", limit_s);
  if (end.over_memory) return "was ended: it passed the memory limit";
  if (end.signal == SIGXFSZ) return "was ended by SIGXFSZ: a file that it wrote became too large";
  if (end.signal != 0) return "was ended by " + signal_name(end.signal);
  return fmt::format("ended with exit code {}", end.exit_code);
}

std::optional<std::int64_t> oom_kills(const std::filesystem::path& root) {
  const auto count_in = [](const std::filesystem::path& file) -> std::optional<std::int64_t> {
    std::ifstream in(file);
    std::string name;
    for (std::int64_t number = 0; in >> name >> number;)
      if (name == "oom_kill") return number;
    return {};
  };
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);)
    if (line.starts_with("0::/"))
      if (const auto of_group = count_in(root / "sys/fs/cgroup" / line.substr(4) / "memory.events"))
        return of_group;
  return count_in(root / "proc/vmstat");
}

Channel::~Channel() { close(socket_); }

bool Channel::send(const std::string& line) {
  const std::string text = line + "\n";
  for (std::size_t sent = 0; sent < text.size() && error_ == 0;) {
    const ssize_t n = ::send(socket_, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
    if (n < 0 && is_closed(errno)) return false;
    if (n < 0 && errno != EINTR) error_ = errno;
    if (n > 0) sent += static_cast<std::size_t>(n);
  }
  return error_ == 0;
}

std::optional<std::string> Channel::receive(const std::function<bool()>& give_up) {
  while (error_ == 0) {
    if (const std::size_t end = received_.find('\n'); end != received_.npos) {
      std::string line = received_.substr(0, end);
      received_.erase(0, end + 1);
      return line;
    }
    pollfd ready{socket_, POLLIN, 0};
    const int events = poll(&ready, 1, give_up ? poll_ms : -1);
    if (give_up && give_up()) return {};
    if (events <= 0) continue;  // a tick, or a signal
    std::array<char, 65536> buffer;
    const ssize_t n = recv(socket_, buffer.data(), buffer.size(), 0);
    if (n < 0 && errno == EINTR) continue;
    if (n == 0 || (n < 0 && is_closed(errno))) return {};
    if (n < 0) error_ = errno;
    if (n > 0) received_.append(buffer.data(), static_cast<std::size_t>(n));
  }
  return {};
}

ChildProcess::ChildProcess(const std::function<void(Channel&)>& body)
    : oom_kills_before_(oom_kills()) {
  std::array<int, 2> ends;
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    fail_to("a line to a child process");
  std::fflush(nullptr);  // otherwise the child would write it again
  pid_ = start(WhenParentEnds::end, [&] {
    close(ends[0]);
    Channel channel(ends[1]);
    run_child(body, channel);
    _exit(channel.error() != 0 ? no_channel_exit_code : 0);
  });
  const int error = errno;
  close(ends[1]);
  channel_.emplace(ends[0]);
  if (pid_ < 0) fail_to("a child process", error);
}

ChildProcess::~ChildProcess() { finish(0); }

void ChildProcess::finish(int patience_ms) {
  if (pid_ < 0) return;
  int status = 0;
  rusage used = {};
  for (int waited_ms = 0;; ++waited_ms) {
    if (waited_ms >= patience_ms) {
      kill(pid_, SIGKILL);
      end_.lingered = patience_ms > 0;
    }
    const pid_t reaped = wait4(pid_, &status, waited_ms >= patience_ms ? 0 : WNOHANG, &used);
    if (reaped == pid_ || (reaped < 0 && errno != EINTR)) break;
    usleep(1000);
  }
  pid_ = -1;
  note_status(status, end_);
  if (const auto now = oom_kills(); now && oom_kills_before_)
    end_.oom_killed = end_.signal == SIGKILL && *now > *oom_kills_before_;
  rlimit limit = {};  // inherited by the child
  end_.used_up_processor_time =
      getrlimit(RLIMIT_CPU, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
      static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec + 1) >= limit.rlim_cur;
}

bool ChildProcess::is_stopped() const {
  siginfo_t state = {};
  return waitid(P_PID, static_cast<id_t>(pid_), &state, WSTOPPED | WNOHANG | WNOWAIT) == 0 &&
         state.si_pid == pid_;
}

std::optional<std::string> ChildProcess::ask(const std::string& line, const GiveUp& give_up) {
  if (pid_ < 0) return {};
  constexpr int most_stopped_ms = 5000;
  int stopped_ms = 0;
  Ticks ticks;
  was_suspended_ = false;
  const auto gives_up = [&] {
    const Ticks::Tick tick = ticks.next();
    stopped_ms = is_stopped() ? stopped_ms + poll_ms : 0;
    was_suspended_ |= tick.is_late || stopped_ms > 0;
    end_.stopped = stopped_ms > most_stopped_ms;
    end_.timed_out = give_up(tick.suspended_s);
    return end_.stopped || end_.timed_out;
  };
  std::optional<std::string> answer;
  if (channel_->send(line)) answer = channel_->receive(gives_up);
  end_.channel_error = channel_->error();
  if (!answer) finish(end_.timed_out || end_.stopped || end_.channel_error != 0 ? 0 : 2000);
  return answer;
}

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

std::vector<pid_t> descendants(pid_t of) {
  std::vector<pid_t> found = {of};
  for (std::size_t k = 0; k < found.size(); ++k) {
    std::error_code error;
    const std::string tasks = fmt::format("/proc/{}/task", found[k]);
    for (const auto& task : std::filesystem::directory_iterator(tasks, error)) {
      std::ifstream children(task.path() / "children");
      for (pid_t child; children >> child;) found.push_back(child);
    }
  }
  found.erase(found.begin());
  return found;
}

// Repeats because a process may start another while they are killed.
void end_descendants(const std::vector<pid_t>& except,
                     const std::function<void(pid_t, int status)>& reaped = {}) {
  for (bool any = true; any; usleep(1000)) {
    any = false;
    for (const pid_t process : descendants(getpid())) {
      if (std::ranges::find(except, process) != except.end()) continue;
      any = true;
      kill(process, SIGKILL);
      int status = 0;
      if (waitpid(process, &status, WNOHANG) > 0 && reaped) reaped(process, status);
    }
  }
}

std::int64_t resident_peak_bytes(pid_t process) {
  std::ifstream status(fmt::format("/proc/{}/status", process));
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024 * std::stoll(line.substr(6));
  return 0;  // it has ended
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

class Guardian {
 public:
  Guardian(const Program& program, const ProgramLimits& limits, ChildEnd& end)
      : program_(program), limits_(limits), end_(end) {}

  void run(pid_t parent) {
    prctl(PR_SET_CHILD_SUBREAPER, 1);
    prctl(PR_SET_PDEATHSIG, SIGCONT);  // a stopped one must see that its parent has ended
    sigset_t all, before;              // the guardian must outlive a signal that ends its parent
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, &before);
    std::signal(SIGCHLD, SIG_DFL);
    std::array<int, 2> until_executed;  // its writing end is closed by execvp()
    if (pipe2(until_executed.data(), O_CLOEXEC) != 0) {
      end_.start_error = errno;
      return;
    }
    const auto begun = std::chrono::steady_clock::now();
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

ChildEnd run_program(const Program& program, const ProgramLimits& limits) {
  const SharedEnd end;
  const pid_t parent = getpid();
  const std::vector<pid_t> others = descendants(parent);
  int adopts = 0;
  prctl(PR_GET_CHILD_SUBREAPER, &adopts);
  prctl(PR_SET_CHILD_SUBREAPER, 1);  // of a guardian that is killed
  const pid_t guardian =
      start(WhenParentEnds::go_on, [&] { Guardian(program, limits, *end).run(parent); });
  const int error = errno;
  const int status = guardian < 0 ? 0 : status_of(guardian);
  const bool is_killed = !WIFEXITED(status) || WEXITSTATUS(status) != 0;
  if (is_killed) end_descendants(others);
  prctl(PR_SET_CHILD_SUBREAPER, adopts);
  if (guardian < 0) fail_to("a program's process", error);
  if (is_killed) throw std::runtime_error("the program's guardian was ended");
  return *end;
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
