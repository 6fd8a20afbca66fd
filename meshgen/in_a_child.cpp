#include "meshgen/in_a_child.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <optional>

#include "meshgen/complaints.hpp"
#include "meshgen/gmsh_mesher.hpp"
#include "meshgen/no_programs.hpp"
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

Attempt attempt(const std::function<int(const AboutToMesh&)>& work) {
  const TemporaryFolder scratch;  // what a crash leaves is removed with it
  ChildProcess child([&](Channel& channel) {
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
      std::signal(signal, SIG_DFL);  // sanitizers catch some, and exit
    setenv("TMPDIR", scratch.path().c_str(), 1);
    start_no_programs();
    const auto begin = [&](int algorithm) { channel.send(std::to_string(algorithm)); };
    _exit(checked_exit_code(complained([&] { return work(begin); }), "meshgen"));
  });
  Attempt made;
  while (const std::optional<std::string> line = child.ask("")) made.algorithm = line;
  made.end = child.end();
  return made;
}

}  // namespace

int in_a_child(const std::filesystem::path& model, const ModelOptions& options,
               const std::function<int(const ModelOptions&, const AboutToMesh&)>& work) {
  const Attempt first = attempt([&](const AboutToMesh& begin) { return work(options, begin); });
  if (first.end.exit_code == no_memory_exit_code)
    return complain(model.string() + ": out of memory", exit_failure);
  if (first.end.signal == 0) return first.end.exit_code;
  const std::string cause =
      fmt::format("{}: Gmsh {} {} while it {} ({})", model.string(), version_of_gmsh(),
                  first.is_crash() ? "crashed" : "was ended",
                  first.algorithm ? "meshed with Mesh.Algorithm=" + *first.algorithm : "read this",
                  signal_name(first.end.signal));
  if (!first.is_crash()) return complain(cause, exit_failure);
  ModelOptions with_6 = options;
  with_6.algorithm = 6;
  const Attempt second = attempt([&](const AboutToMesh& begin) { return work(with_6, begin); });
  if (second.end.signal != 0)
    return complain(cause + (first.algorithm && first.algorithm != "6" ? ", and with 6" : ""),
                    exit_failure);
  fmt::print(stderr, "note: {}: meshed with 6\n", cause);
  return second.end.exit_code;
}

}  // namespace airybench
