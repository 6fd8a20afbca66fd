// The bench command as an ordinary user, since root may do everything.
#pragma once

#include <unistd.h>

#include "tests/support/bench_command.hpp"

namespace airybench::testing {

// The program and a mesh where another user can start it: the build tree may be in a home that only
// its owner enters.
inline void copy_program_to(const std::filesystem::path& folder) {
  const std::filesystem::path meshes = folder / "share" / "airybench" / "meshes";
  std::filesystem::create_directories(meshes);
  std::filesystem::create_directories(folder / "bin");
  std::filesystem::copy(bench_executable(), folder / "bin" / "bench");
  std::filesystem::copy(mesh_file("Mesh0"), meshes);
  std::filesystem::permissions(folder, std::filesystem::perms::all);
}

// The exit code of what a shell does in the test's folder, as another user than root. Descriptor 9
// is the program.
inline int run_as_user(const BenchCommand& bench, const std::string& shell) {
  std::filesystem::permissions(bench.path(""), std::filesystem::perms::all);
  const std::string user = geteuid() == 0 ? "setpriv --reuid=54321 --clear-groups " : "";
  const std::string command = "cd '" + bench.path("").string() + "' && exec 9<bin/bench && " +
                              "timeout -s KILL 60 " + user + "bash -c '" + shell +
                              "' >out.txt 2>err.txt";
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace airybench::testing
