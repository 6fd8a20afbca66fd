#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string_view>

#include "bench/claims/claims_command.hpp"
#include "bench/options.hpp"
#include "bench/run_command.hpp"
#include "bench/tracking/compare_command.hpp"
#include "bench/tracking/track_command.hpp"

namespace airybench {
namespace {

enum ExitCode { all_ok = 0, wrong_usage = 2 };

int bench(int argc, const char* const* argv) {
  const std::string_view command = argc > 1 ? argv[1] : "";
  if (command == "claims") {
    claims_command(argc - 1, argv + 1);
    return all_ok;
  }
  if (command == "compare") return compare_command(argc - 1, argv + 1);
  if (command == "track") return track_command(argc - 1, argv + 1);
  return run_command(argc, argv);
}

}  // namespace
}  // namespace airybench

int main(int argc, char** argv) {
  try {
    return airybench::bench(argc, argv);
  } catch (const airybench::HelpRequested& help) {
    fmt::print("{}", help.what());
    return airybench::all_ok;
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench: {}\n", error.what());
    return airybench::wrong_usage;
  }
}
