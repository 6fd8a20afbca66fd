// The bench command in the background of a test, and other processes.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/bench_command.hpp"

namespace airybench::testing {

// A run in the background that can be sent signals.
class BackgroundRun {
 public:
  BackgroundRun(const BenchCommand& folder, const std::string& arguments) {
    std::string command = "cd '" + folder.path("").string();
    command += "' && exec '" + bench_executable().string() + "' ";
    command += arguments;
    command += " >bg_out.txt 2>bg_err.txt </dev/null";
    pid_ = fork();
    if (pid_ == 0) {
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(127);
    }
  }
  ~BackgroundRun() {
    if (pid_ > 0) end(SIGKILL);
  }
  pid_t pid() const { return pid_; }
  // The wait status after this signal.
  int end(int signal) {
    kill(pid_, signal);
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return status;
  }

 private:
  pid_t pid_ = -1;
};

// Waits for something, as long as the test runner's patience lasts.
template <typename Condition>
void wait_for(const Condition& condition) {
  while (!condition()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

// The processes that this one has begun and that have not ended, oldest first.
inline std::vector<pid_t> children_of(pid_t parent) {
  const std::string id = std::to_string(parent);
  std::istringstream children(text_of("/proc/" + id + "/task/" + id + "/children"));
  return std::vector<pid_t>(std::istream_iterator<pid_t>(children), {});
}

inline bool is_there(pid_t pid) {
  const std::string status = text_of("/proc/" + std::to_string(pid) + "/stat");
  return !status.empty() && status.find(") Z ") == status.npos;  // a zombie runs no more
}

}  // namespace airybench::testing
