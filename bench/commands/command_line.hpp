// What the commands' lines have in common.
#pragma once

#include <CLI/CLI.hpp>

namespace airybench {

// app.parse(argc, argv), with CLI11's ways to end as ours: HelpRequested (help, version),
// UsageError (one line; for an unknown word with what is valid).
void parse_command_line(CLI::App& app, int argc, const char* const* argv);

}  // namespace airybench
