// What the commands' lines have in common.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace airybench {

// app.parse(argc, argv), with CLI11's ways to end as ours: HelpRequested (help, version),
// UsageError (one line; for an unknown word with what is valid).
void parse_command_line(CLI::App& app, int argc, const char* const* argv);

// The items of a list, "a,b"; a backslash before a comma or a backslash makes it a part of its
// item.
std::vector<std::string> split_list(const std::string& list);

}  // namespace airybench
