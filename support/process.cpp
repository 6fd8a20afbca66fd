#include "support/process.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <exception>
#include <fstream>
#include <iostream>
#include <new>
#include <system_error>
#include <utility>

#include "support/forks.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

constexpr int poll_ms = 100;

double now_s(clockid_t clock) {
  timespec now = {};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Seconds since last_s, which becomes now.
double passed_s(clockid_t clock, double& last_s) {
  const double now = now_s(clock);
  return now - std::exchange(last_s, now);
}

bool is_closed(int error) { return error == EPIPE || error == ECONNRESET; }

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

void fail_to(const char* what, int error) {
  throw std::system_error(error, std::generic_category(), what);
}

Ticks::Tick Ticks::next() {
  constexpr double longest_s = 1;
  const double since_s = passed_s(CLOCK_MONOTONIC, last_s_);
  const double counted_s = std::min(since_s, longest_s);
  return {counted_s, since_s - counted_s, passed_s(CLOCK_BOOTTIME, last_boot_s_) > longest_s};
}

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
  if (end.oom_killed == true) return "was ended by the kernel for lack of memory";
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

void note_oom_kill(std::optional<std::int64_t> kills_before, ChildEnd& end) {
  if (const auto now = oom_kills(); now && kills_before && end.signal == SIGKILL)
    end.oom_killed = *now > *kills_before;
}

std::int64_t resident_peak_bytes(pid_t process) {
  std::ifstream status(fmt::format("/proc/{}/status", process));
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024 * std::stoll(line.substr(6));
  return 0;
}

Channel::~Channel() { close(socket_); }

bool Channel::send(const std::string& line) {
  const std::string text = line + "\n";
  for (std::size_t sent = 0; sent < text.size() && error_ == 0;) {
    const ssize_t n = ::send(socket_, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
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
    if (n == 0) return {};
    if (n < 0 && errno != EINTR) error_ = errno;
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
  note_oom_kill(oom_kills_before_, end_);
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
  constexpr int max_stopped_ms = 5000;
  int stopped_ms = 0;
  Ticks ticks;
  was_suspended_ = false;
  const auto gives_up = [&] {
    const Ticks::Tick tick = ticks.next();
    stopped_ms = is_stopped() ? stopped_ms + poll_ms : 0;
    was_suspended_ |= tick.is_late || stopped_ms > 0;
    end_.stopped = stopped_ms > max_stopped_ms;
    end_.timed_out = give_up(tick.suspended_s);
    return end_.stopped || end_.timed_out;
  };
  std::optional<std::string> answer;
  if (channel_->send(line)) answer = channel_->receive(gives_up);
  if (answer) return answer;
  end_.channel_error = channel_->error();
  const bool may_have_ended = end_.channel_error == 0 || is_closed(end_.channel_error);
  finish(end_.timed_out || end_.stopped || !may_have_ended ? 0 : 2000);
  if (may_have_ended && !end_.lingered) end_.channel_error = 0;  // its end closed the line
  return answer;
}

}  // namespace airybench
