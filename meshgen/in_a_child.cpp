#include "meshgen/in_a_child.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <optional>

#include "meshgen/complaints.hpp"
#include "meshgen/confinement.hpp"
#include "meshgen/geo_script.hpp"
#include "meshgen/gmsh_mesher.hpp"
#include "support/errors.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

struct Attempt {
  ChildEnd end;
  std::optional<std::string> algorithm;  // that Gmsh had begun to mesh with
  bool is_crash() const { return end.signal != 0 && end.signal != SIGKILL; }
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

// scratch: what a crash leaves is removed with it.
Attempt attempt(const std::filesystem::path& model, const std::filesystem::path& scratch,
                const std::function<void(const AboutToMesh&)>& work) {
  ChildProcess child([&](Channel& channel) {
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
      std::signal(signal, SIG_DFL);  // sanitizers catch some, and exit
    setenv("TMPDIR", scratch.c_str(), 1);
    const auto begin = [&](int algorithm) { channel.send(std::to_string(algorithm)); };
    const auto confined = [&] {
      const bool writes_here = write_only_in(scratch), starts_none = start_no_programs();
      refuse_if_it_needs_confinement(model, writes_here, starts_none);
      work(begin);
      return 0;
    };
    _exit(checked_exit_code(complained(confined), "meshgen"));
  });
  Attempt made;
  while (const std::optional<std::string> line = child.ask("")) made.algorithm = line;
  made.end = child.end();
  return made;
}

}  // namespace

int in_a_child(const std::filesystem::path& model, const ModelOptions& options,
               const std::function<void(const ModelOptions&, const AboutToMesh&,
                                        const std::filesystem::path& folder)>& work,
               const InFolder& take) {
  const TemporaryFolder scratch;
  const Attempt first = attempt(model, scratch.path(), [&](const AboutToMesh& begin) {
    work(options, begin, scratch.path());
  });
  if (first.end.exit_code == no_memory_exit_code)
    return complain(model.string() + ": out of memory", exit_failure);
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
  const Attempt second = attempt(
      model, other.path(), [&](const AboutToMesh& begin) { work(with_6, begin, other.path()); });
  if (second.end.signal != 0)
    return complain(cause + (first.algorithm && first.algorithm != "6" ? ", and with 6" : ""),
                    exit_failure);
  if (second.end.exit_code == no_memory_exit_code)
    return complain(model.string() + ": out of memory", exit_failure);
  if (second.end.exit_code == 0) {
    fmt::print(stderr, "note: {}: meshed with 6\n", cause);
    take(other.path());
  }
  return second.end.exit_code;
}

}  // namespace airybench
