#include "support/program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <system_error>

#include "support/seconds_since.hpp"

namespace airybench {
namespace {

class Pipe {
 public:
  Pipe() {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0)
      throw std::system_error(errno, std::generic_category(), "a pipe");
  }
  ~Pipe() {
    for (int& end : ends_) shut(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int read_end() const { return ends_[0]; }
  int write_end() const { return ends_[1]; }
  void shut_write_end() { shut(ends_[1]); }

 private:
  static void shut(int& end) {
    if (end >= 0) close(end);
    end = -1;
  }
  std::array<int, 2> ends_ = {-1, -1};
};

[[noreturn]] void become(const char* program, char* const* argv, const Pipe& out, const Pipe& err,
                         pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);  // it ended before the line above
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  dup2(nothing, STDIN_FILENO);
  dup2(out.write_end(), STDOUT_FILENO);
  dup2(err.write_end(), STDERR_FILENO);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
  execv(program, argv);
  _exit(127);
}

// Until both are closed by all who write into them, or the time is over.
void read_both(const Pipe& out, const Pipe& err, double time_limit_s, ProgramEnd& end) {
  const auto start = std::chrono::steady_clock::now();
  std::array<pollfd, 2> ready = {{{out.read_end(), POLLIN, 0}, {err.read_end(), POLLIN, 0}}};
  const std::array<std::string*, 2> texts = {&end.out, &end.err};
  while (ready[0].fd >= 0 || ready[1].fd >= 0) {
    const double left_s = time_limit_s - seconds_since(start);
    end.timed_out = left_s <= 0;
    if (end.timed_out) return;
    const double most_s = std::min(left_s, 1000.0);
    if (poll(ready.data(), ready.size(), static_cast<int>(std::ceil(1000 * most_s))) < 0)
      continue;  // a signal
    for (std::size_t k = 0; k < ready.size(); ++k) {
      if (ready[k].fd < 0 || ready[k].revents == 0) continue;
      std::array<char, 65536> buffer;
      const ssize_t n = read(ready[k].fd, buffer.data(), buffer.size());
      if (n > 0) texts[k]->append(buffer.data(), static_cast<std::size_t>(n));
      if (n == 0 || (n < 0 && errno != EINTR)) ready[k].fd = -1;
    }
  }
}

}  // namespace

ProgramEnd run_program(const std::filesystem::path& program,
                       const std::vector<std::string>& arguments, double time_limit_s) {
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  Pipe out, err;
  const pid_t parent = getpid(), child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "a process");
  if (child == 0) become(argv[0], argv.data(), out, err, parent);
  out.shut_write_end();
  err.shut_write_end();
  ProgramEnd end;
  read_both(out, err, time_limit_s, end);
  if (end.timed_out) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  return end;
}

std::optional<std::filesystem::path> program_of_ours(const std::string& name) {
  const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  std::error_code error;
  for (const std::filesystem::path& file :
       {folder / ("airybench-" + name), folder / ".." / name / name})
    if (std::filesystem::is_regular_file(file, error)) return file.lexically_normal();
  return {};
}

}  // namespace airybench
