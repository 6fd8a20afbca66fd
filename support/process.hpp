// Starts, watches and ends processes; every fork of the project is in process.cpp (start()).
//
//   ChildProcess   a function of this program in a fork; both exchange lines of text
//   run_program    another program, with all that it starts (program.cpp)
//
// Both end when this process ends, even by a crash.
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

struct ChildEnd {
  int exit_code = -1;                   // if it exited
  int signal = 0;                       // that ended it
  int start_error = 0;                  // errno if the program could not be started
  bool timed_out = false;               // it passed its limit, or its caller gave up
  bool over_memory = false;             // its processes together passed the limit
  bool stopped = false;                 // it was suspended (SIGSTOP) for seconds
  bool lingered = false;                // it closed its channel but did not exit
  int channel_error = 0;                // errno of a failed send or receive
  bool used_up_processor_time = false;  // up to its limit (ulimit -t)
  std::optional<bool> oom_killed;       // SIGKILL while the kernel's count of OOM kills rose
  double wall_s = 0, processor_s = 0;   // of a program; with all that it started
  std::int64_t peak_bytes = 0;          // of a program, see run_program
};
std::string signal_name(int signal);  // "SIGSEGV"
std::string how_it_ended(const ChildEnd& end, double limit_s);

// The kernel's kills for lack of memory in this process's control group (version 2, memory.events),
// else on this machine (/proc/vmstat); empty if unknown. root: folder of /proc and /sys.
std::optional<std::int64_t> oom_kills(const std::filesystem::path& root = "/");
void note_oom_kill(std::optional<std::int64_t> kills_before, ChildEnd& end);

// The highest memory in use so far (VmHWM); 0: it has ended.
std::int64_t resident_peak_bytes(pid_t process);

class Channel {
 public:
  explicit Channel(int socket) : socket_(socket) {}
  ~Channel();
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;

  // Both fail if the other end is closed, and always after an error().
  bool send(const std::string& line);
  // Also empty if give_up(), asked ten times a second, returns true.
  std::optional<std::string> receive(const std::function<bool()>& give_up = {});
  int error() const { return error_; }  // errno of a failed call

 private:
  int socket_, error_ = 0;
  std::string received_;
};

// Of a ChildProcess: it ran out of memory; its channel failed.
inline constexpr int no_memory_exit_code = 97, no_channel_exit_code = 98;

// A fork shares its parent's memory without a copy. The parent must not have started threads that
// the child needs (OpenMP). The child ignores signals from the terminal.
class ChildProcess {
 public:
  // The child exits with 0 after body, with 1 after an exception. Throws std::system_error.
  explicit ChildProcess(const std::function<void(Channel&)>& body);
  ~ChildProcess();  // kills it
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // suspended_s: for which this process was suspended since the last call.
  using GiveUp = std::function<bool(double suspended_s)>;
  // Empty if the child has ended: see end(). Kills it if give_up() is true or it stays suspended.
  std::optional<std::string> ask(
      const std::string& line, const GiveUp& give_up = [](double) { return false; });
  const ChildEnd& end() const { return end_; }
  pid_t pid() const { return pid_; }  // -1: it has ended
  // During the last ask(): the child, or this process for over a second.
  bool was_suspended() const { return was_suspended_; }

 private:
  void finish(int patience_ms);  // reaps the child; kills it after patience_ms
  bool is_stopped() const;

  pid_t pid_ = -1;
  std::optional<std::int64_t> oom_kills_before_;
  std::optional<Channel> channel_;
  ChildEnd end_;
  bool was_suspended_ = false;
};

struct Program {
  std::vector<std::string> command = {};                // a file or a name in PATH, then arguments
  std::filesystem::path folder = "";                    // working folder; empty: the current one
  std::map<std::string, std::string> environment = {};  // added to ours
  std::filesystem::path output = {};                    // file for its standard output
  std::filesystem::path errors = {};   // for its standard error, if not the same file
  std::filesystem::path scratch = {};  // removed if this process ends first
  bool in_own_session = true;          // receives no signals from the terminal
};

struct ProgramLimits {
  double time_s = 0;
  std::optional<std::int64_t> memory_bytes = {};
  // For each file that it writes, its output included (RLIMIT_FSIZE, SIGXFSZ).
  std::int64_t file_bytes = std::int64_t{4} << 30;
};

// Runs a program without input until it ends or passes a limit. A guardian process in between
// adopts orphans (PR_SET_CHILD_SUBREAPER), checks the process tree every 1 to 10 ms, and kills all
// of it when a limit is passed, the program ends, or this process ends.
//
// peak_bytes is the largest sum, at any check, of the resident peaks (VmHWM) of all live processes:
// for one process its peak up to the last check, for several an upper bound; 0 if never checked.
//
// The guardian's suspension does not count for time_s, the program's does.
//
// Throws std::system_error (no process, no shared memory), std::runtime_error (guardian killed).
ChildEnd run_program(const Program& program, const ProgramLimits& limits);

// From now on processes whose parent has ended become this process's children, not those of init.
void adopt_orphans();
// Ends all descendants of this process but these children of it and theirs.
void end_others_than(const std::vector<pid_t>& children);

// Returns the output as text. Also throws FileError if there is no temporary folder.
struct ProgramEnd : ChildEnd {
  std::string out, err;
};
ProgramEnd run_program(const std::filesystem::path& program,
                       const std::vector<std::string>& arguments, double time_limit_s);

}  // namespace airybench
