// Processes that this one starts, watches and ends; every fork of the project is in process.cpp.
//
//   ChildProcess   a function of this program in a fork; the two talk in lines of text
//   run_program    another program, with all that it starts
//
// Each ends when this process does, however that ends.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace airybench {

// How a process ended, and why it was killed.
struct ChildEnd {
  int exit_code = -1;                   // of one that ended by itself
  int signal = 0;                       // that ended it
  int start_error = 0;                  // errno: the program could not be started
  bool timed_out = false;               // it took longer than its limit, or than its caller waits
  bool over_memory = false;             // its processes together passed the limit
  bool stopped = false;                 // somebody had suspended it (SIGSTOP) for seconds
  bool lingered = false;                // it closed the line and did not end
  bool used_up_processor_time = false;  // as much as its limit (ulimit -t) allows
  std::optional<bool> oom_killed;       // did the kernel kill for lack of memory meanwhile?
  double wall_s = 0;                    // of a program
  std::int64_t peak_bytes = 0;          // of a program: see run_program
};
std::string signal_name(int signal);  // "SIGSEGV"
// "ended with exit code 3", "was ended by SIGSEGV", "was ended after the limit of 60 s".
std::string how_it_ended(const ChildEnd& end, double limit_s);

// Processes that the kernel has killed for lack of memory: in this process's control group (version
// 2, memory.events), else on this machine (/proc/vmstat); empty: neither is known. root: where
// /proc and /sys are.
std::optional<std::int64_t> oom_kills(const std::filesystem::path& root = "/");

// One end of a line between two processes.
class Channel {
 public:
  explicit Channel(int socket) : socket_(socket) {}
  ~Channel();
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;

  bool send(const std::string& line);  // false: the other end is closed
  // The next line; empty: the other end is closed, or give_up() says so. It is asked ten times a
  // second.
  std::optional<std::string> receive(const std::function<bool()>& give_up = {});

 private:
  int socket_;
  std::string received_;
};

inline constexpr int no_memory_exit_code = 97;  // of a ChildProcess that could not go on without it

// A fork has everything that its parent had, without copying it. The parent must not have started
// threads that the child needs: OpenMP's regions do not survive a fork. Signals from the terminal
// are for the parent to handle.
class ChildProcess {
 public:
  // The child runs body and ends with exit code 0; an exception: 1. Throws std::system_error.
  explicit ChildProcess(const std::function<void(Channel&)>& body);
  ~ChildProcess();  // kills it
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // Sends a line, waits for the answer; empty: the child has ended, end() says how. It is killed
  // when give_up says so, or when it stays suspended.
  std::optional<std::string> ask(const std::string& line,
                                 const std::function<bool()>& give_up = {});
  const ChildEnd& end() const { return end_; }

 private:
  void finish(int patience_ms);  // reaps; kills after so long
  bool is_stopped() const;

  pid_t pid_ = -1;  // -1: reaped
  std::optional<std::int64_t> oom_kills_before_;
  std::optional<Channel> channel_;
  ChildEnd end_;
};

struct Program {
  std::vector<std::string> command = {};  // its file, or a name to look for in PATH; arguments
  std::filesystem::path folder = "";      // that it runs in; empty: this one
  std::map<std::string, std::string> environment = {};  // besides ours
  std::filesystem::path output = {};                    // file for what it prints
  std::filesystem::path errors = {};                    // for standard error, if not the same
  std::filesystem::path scratch = {};  // removed with this process, should it end first
  bool in_own_session = true;          // no signals from the terminal
};

struct ProgramLimits {
  double time_s = 0;
  std::optional<std::int64_t> memory_bytes = {};
  // Of each file that it writes, what it prints included (RLIMIT_FSIZE): SIGXFSZ ends it.
  std::int64_t file_bytes = std::int64_t{4} << 30;
};

// Runs a program, without input, to its end or to a limit. Between this process and the program
// stands a guardian, a fork: it adopts what the program leaves behind (PR_SET_CHILD_SUBREAPER),
// looks at the tree every one to ten milliseconds, and kills all of it when a limit is passed, when
// the program ends, or when this process does.
//
// peak_bytes is the sum of the resident peaks (VmHWM) of the processes that are alive at once, its
// largest value at any look: of one process its own peak, but for what it added since the last
// look; of several no less than what they had together. 0: it was too short to be seen.
//
// Throws std::system_error: no process, or no memory to share with it; std::runtime_error: somebody
// ended the guardian.
ChildEnd run_program(const Program& program, const ProgramLimits& limits);

// The same with what it prints as text. Throws FileError, too: no temporary folder.
struct ProgramEnd : ChildEnd {
  std::string out, err;
};
ProgramEnd run_program(const std::filesystem::path& program,
                       const std::vector<std::string>& arguments, double time_limit_s);

}  // namespace airybench
