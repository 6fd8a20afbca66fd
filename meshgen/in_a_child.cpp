#include "meshgen/in_a_child.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <new>
#include <optional>

#include "meshgen/complaints.hpp"
#include "meshgen/confinement.hpp"
#include "meshgen/geo_script.hpp"
#include "meshgen/gmsh_mesher.hpp"
#include "support/errors.hpp"
#include "support/process.hpp"
#include "support/seconds_since.hpp"
#include "support/temporary_folder.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

struct Attempt {
  ChildEnd end;
  std::string passed_limit;              // what to say of it
  std::optional<std::string> algorithm;  // that Gmsh had begun to mesh with
  bool is_crash() const { return end.signal != 0 && end.signal != SIGKILL; }
  bool is_out_of_memory() const {
    return end.exit_code == no_memory_exit_code || end.oom_killed == true;
  }
};

void refuse_if_it_needs_confinement(const std::filesystem::path& model, bool writes_here,
                                    bool starts_none) {
  if (writes_here && starts_none) return;
  const GeoScript script = what_is_read(model);
  if ((!writes_here && script.may_write) || (!starts_none && script.may_start_programs))
    throw FileError(
        model.string() +
        ": this kernel (or container) cannot keep it from writing files and starting "
        "programs, and it has words that may (allowed: a model without them; Linux with "
        "Landlock and seccomp)");
}

// What the child says on standard error, in memory that both share: in a crash the C library says
// something there, too.
class Said {
 public:
  Said() : descriptor_(memfd_create("said", MFD_CLOEXEC)) {}
  ~Said() { close(descriptor_); }
  Said(const Said&) = delete;
  Said& operator=(const Said&) = delete;
  void lead_here() const { dup2(descriptor_, STDERR_FILENO); }  // in the child
  // To standard error: all, or the notes that come before anything else.
  void pass_on(bool all) {
    std::array<char, 4096> part;
    for (ssize_t n; (n = pread(descriptor_, part.data(), part.size(), read_)) > 0; read_ += n)
      unsaid_.append(part.data(), static_cast<std::size_t>(n));
    for (std::size_t end; (end = unsaid_.find('\n')) != unsaid_.npos; unsaid_.erase(0, end + 1)) {
      if (!all && !unsaid_.starts_with("note: ")) return;
      std::cerr << unsaid_.substr(0, end + 1);
    }
  }

 private:
  int descriptor_;
  off_t read_ = 0;
  std::string unsaid_;
};

// scratch: what a crash leaves is removed with it.
Attempt attempt(const std::filesystem::path& model, const ModelLimits& limits,
                const std::filesystem::path& scratch,
                const std::function<void(const AboutToMesh&)>& work) {
  Said said;
  ChildProcess child([&](Channel& channel) {
    said.lead_here();
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
      std::signal(signal, SIG_DFL);  // sanitizers catch some, and exit
    setenv("TMPDIR", scratch.c_str(), 1);
    const auto begin = [&](int algorithm) { channel.send(std::to_string(algorithm)); };
    const auto confined = [&] {
      const bool writes_here = write_only_in(scratch), starts_none = start_no_programs();
      refuse_if_it_needs_confinement(model, writes_here, starts_none);
      try {
        work(begin);
      } catch (const std::bad_alloc&) {
        return no_memory_exit_code;  // for the parent to tell, which names the model
      }
      return 0;
    };
    _exit(checked_exit_code(complained(confined), "meshgen"));
  });
  Attempt made;
  const auto begun = std::chrono::steady_clock::now();
  double suspended_s = 0;
  const auto passes_a_limit = [&](double further_s) {
    suspended_s += further_s;
    said.pass_on(/*all=*/false);
    if (seconds_since(begun) - suspended_s > limits.time_s)
      made.passed_limit = fmt::format("more than {:g} s (more with {}=SECONDS)", limits.time_s,
                                      model_time_setting.option);
    else if (static_cast<double>(resident_peak_bytes(child.pid())) > limits.memory_MiB * (1 << 20))
      made.passed_limit = fmt::format("more than {:g} MiB of memory (more with {}=MIB)",
                                      limits.memory_MiB, model_memory_setting.option);
    return !made.passed_limit.empty();
  };
  while (const std::optional<std::string> line = child.ask("", passes_a_limit))
    made.algorithm = line;
  made.end = child.end();
  said.pass_on(/*all=*/made.end.signal == 0);
  return made;
}

int complain_of_limit(const std::filesystem::path& model, const Attempt& made) {
  return complain(fmt::format("{}: {} took {}", model.string(),
                              made.algorithm ? "meshing it (--mesh-size=200% makes fewer triangles)"
                                             : "reading it",
                              made.passed_limit),
                  exit_failure);
}

}  // namespace

int in_a_child(const std::filesystem::path& model, const ModelOptions& options,
               const std::function<void(const ModelOptions&, const AboutToMesh&,
                                        const std::filesystem::path& folder)>& work,
               const InFolder& take) {
  const TemporaryFolder scratch;
  const Attempt first =
      attempt(model, options.limits, scratch.path(),
              [&](const AboutToMesh& begin) { work(options, begin, scratch.path()); });
  if (!first.passed_limit.empty()) return complain_of_limit(model, first);
  if (first.is_out_of_memory()) return complain(model.string() + ": out of memory", exit_failure);
  if (first.end.signal == 0) {
    if (first.end.exit_code == 0) take(scratch.path());
    return first.end.exit_code;
  }
  const std::string cause =
      fmt::format("{}: Gmsh {} {} while it {} ({})", model.string(), version_of_gmsh(),
                  first.is_crash() ? "crashed" : "was ended",
                  first.algorithm ? "meshed with Mesh.Algorithm=" + *first.algorithm : "read this",
                  signal_name(first.end.signal));
  if (!first.is_crash()) return complain(cause, exit_failure);
  ModelOptions with_6 = options;
  with_6.algorithm = 6;
  const TemporaryFolder other;
  const Attempt second =
      attempt(model, options.limits, other.path(),
              [&](const AboutToMesh& begin) { work(with_6, begin, other.path()); });
  if (!second.passed_limit.empty()) return complain_of_limit(model, second);
  if (second.is_out_of_memory()) return complain(model.string() + ": out of memory", exit_failure);
  if (second.end.signal != 0)
    return complain(cause + (first.algorithm && first.algorithm != "6" ? ", and with 6" : ""),
                    exit_failure);
  if (second.end.exit_code == 0) {
    fmt::print(stderr, "note: {}: meshed with 6\n", cause);
    take(other.path());
  }
  return second.end.exit_code;
}

}  // namespace airybench
