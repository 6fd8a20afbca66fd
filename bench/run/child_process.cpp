#include "bench/run/child_process.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <iostream>
#include <new>
#include <system_error>

#include "bench/measure/heap_probe.hpp"
#include "bench/run/oom_kills.hpp"
#include "support/lack_of_memory.hpp"

namespace airybench {
namespace {

constexpr int poll_ms = 100;

[[noreturn]] void run_child(const std::function<void(Channel&)>& body, Channel& channel,
                            pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(0);  // it ended before the line above
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_IGN);
  // If the machine runs out of memory, this one goes first; a night of crashes fills no disk.
  std::ofstream("/proc/self/oom_score_adj") << 1000;
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  end_for_lack_of_memory_with("", no_memory_exit_code);
  std::atexit([] {  // of a library: we use _exit()
    if (heap::was_refused()) _exit(no_memory_exit_code);
  });
  try {
    body(channel);
  } catch (const std::bad_alloc&) {
    _exit(no_memory_exit_code);
  } catch (const std::exception& error) {
    std::cerr << fmt::format("bench: in a child process: {}\n", error.what());
    _exit(1);
  } catch (...) {  // or it would unwind into the parent's part of the stack
    std::abort();
  }
  _exit(0);  // no destructors, no buffers: they are the parent's
}

}  // namespace

Channel::~Channel() { close(socket_); }

bool Channel::send(const std::string& line) {
  const std::string text = line + "\n";
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t n = ::send(socket_, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
    if (n < 0 && errno != EINTR) return false;
    if (n > 0) sent += static_cast<std::size_t>(n);
  }
  return true;
}

std::optional<std::string> Channel::receive(const std::function<bool()>& give_up) {
  for (;;) {
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
    if (n <= 0) return {};
    received_.append(buffer.data(), static_cast<std::size_t>(n));
  }
}

std::string signal_name(int signal) {
  const char* name = sigabbrev_np(signal);
  return name == nullptr ? fmt::format("signal {}", signal) : fmt::format("SIG{}", name);
}

ChildProcess::ChildProcess(const std::function<void(Channel&)>& body) {
  std::array<int, 2> ends;
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw std::system_error(errno, std::generic_category(), "a line to a child process");
  oom_kills_before_ = oom_kills();
  std::fflush(nullptr);  // or the child would write it, too
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) {
    close(ends[0]);
    Channel channel(ends[1]);
    run_child(body, channel, parent);
  }
  const int error = errno;
  close(ends[1]);
  channel_.emplace(ends[0]);
  if (pid_ < 0) throw std::system_error(error, std::generic_category(), "a child process");
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
  if (WIFEXITED(status)) end_.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) end_.signal = WTERMSIG(status);
  if (const auto now = oom_kills(); now && oom_kills_before_)
    end_.oom_killed = end_.signal == SIGKILL && *now > *oom_kills_before_;
  rlimit limit = {};  // its own, too
  end_.used_up_processor_time =
      getrlimit(RLIMIT_CPU, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
      static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec + 1) >= limit.rlim_cur;
  pid_ = -1;
}

bool ChildProcess::is_stopped() const {
  siginfo_t state = {};
  return waitid(P_PID, static_cast<id_t>(pid_), &state, WSTOPPED | WNOHANG | WNOWAIT) == 0 &&
         state.si_pid == pid_;
}

std::optional<std::string> ChildProcess::ask(const std::string& line,
                                             const std::function<bool()>& give_up) {
  if (pid_ < 0) return {};
  constexpr int most_stopped_ms = 5000;
  int stopped_ms = 0;
  const auto gives_up = [&] {
    stopped_ms = is_stopped() ? stopped_ms + poll_ms : 0;
    end_.stopped = stopped_ms > most_stopped_ms;
    end_.given_up = give_up && give_up();
    return end_.stopped || end_.given_up;
  };
  std::optional<std::string> answer;
  if (channel_->send(line)) answer = channel_->receive(gives_up);
  // Who has closed the line is ending by itself, and shall be seen to do so.
  if (!answer) finish(end_.given_up || end_.stopped ? 0 : 2000);
  return answer;
}

}  // namespace airybench
