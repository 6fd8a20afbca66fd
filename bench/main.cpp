#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <map>
#include <string_view>

#include "bench/claims/claims_command.hpp"
#include "bench/exports/export_command.hpp"
#include "bench/isolation/isolated_scene.hpp"
#include "bench/options.hpp"
#include "bench/records/merge_command.hpp"
#include "bench/replay_command.hpp"
#include "bench/run_command.hpp"
#include "bench/tracking/compare_command.hpp"
#include "bench/tracking/track_command.hpp"

namespace {

using Command = int (*)(int argc, const char* const* argv);

// `bench WORD …`; without such a word it is a run.
const std::map<std::string_view, Command> commands = {
    {"claims", airybench::claims_command}, {"compare", airybench::compare_command},
    {"export", airybench::export_command}, {"merge", airybench::merge_command},
    {"replay", airybench::replay_command}, {"track", airybench::track_command},
};

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto found = argc > 1 ? commands.find(argv[1]) : commands.end();
    return found == commands.end() ? airybench::run_command(argc, argv)
                                   : found->second(argc - 1, argv + 1);
  } catch (const airybench::HelpRequested& help) {
    fmt::print("{}", help.what());
    return airybench::all_ok;
  } catch (const airybench::Interrupted& interrupted) {
    fmt::print(stderr,
               "bench: {}: what was measured by then is in the output folder; --resume goes on\n",
               interrupted.what());
    return 128 + interrupted.signal;
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench: {}\n", error.what());
    return airybench::wrong_usage;
  }
}
