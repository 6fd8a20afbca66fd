// A piece of the program's work in a process of its own: whatever it does to itself, crash, hang or
// eat all memory, it does to nobody else.
//
// The child is a fork: it has everything that the parent had, without copying it, and talks with
// the parent in lines of text. It ends when the parent does, however that ends (PR_SET_PDEATHSIG);
// signals from the terminal are the parent's to handle. Its parent must not have started threads
// that it needs (OpenMP's regions do not survive a fork).
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace airybench {

// One end of the line.
class Channel {
 public:
  explicit Channel(int socket) : socket_(socket) {}
  ~Channel();
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;

  bool send(const std::string& line);  // false: nobody is there any more
  // The next line; empty: nobody is there any more, or give_up() said so. It is asked ten times a
  // second.
  std::optional<std::string> receive(const std::function<bool()>& give_up = {});

 private:
  int socket_;
  std::string received_;
};

inline constexpr int no_memory_exit_code = 97;  // of a child: nobody could go on without the memory
struct ChildEnd {
  int exit_code = -1;     // of one that ended by itself
  int signal = 0;         // that ended it
  bool given_up = false;  // receive()'s give_up ended it
  bool stopped = false;   // somebody had stopped it (SIGSTOP) for seconds: it was killed
  bool lingered = false;  // it closed the line and did not end: it was killed
  bool used_up_processor_time = false;  // as much as its limit (ulimit -t) allows
  std::optional<bool> oom_killed;       // did the kernel kill for lack of memory meanwhile?
};
std::string signal_name(int signal);  // "SIGSEGV"

class ChildProcess {
 public:
  // The child runs body and ends with exit code 0; an exception: 1. Throws std::system_error.
  explicit ChildProcess(const std::function<void(Channel&)>& body);
  ~ChildProcess();  // ends it
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // Sends a line, waits for the answer; empty: the child has ended, end() says how. When give_up
  // says so, or while it does not run at all, it is killed.
  std::optional<std::string> ask(const std::string& line,
                                 const std::function<bool()>& give_up = {});
  const ChildEnd& end() const { return end_; }

 private:
  void finish(int patience_ms);  // reaps; kills after so long
  bool is_stopped() const;

  pid_t pid_ = -1;  // -1: reaped
  std::optional<Channel> channel_;
  std::optional<std::int64_t> oom_kills_before_;
  ChildEnd end_;
};

}  // namespace airybench
