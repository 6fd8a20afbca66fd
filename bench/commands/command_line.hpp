// What the commands' lines have in common.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace airybench {

// app.parse(argc, argv), with CLI11's ways to end as ours: HelpRequested (help, version),
// UsageError (one line; for an unknown word with what is valid; also for "--out=", whose value
// would be the next argument).
void parse_command_line(CLI::App& app, int argc, const char* const* argv);

// Options whose values are numbers, read by support/numbers.hpp. Others are refused with option,
// value and what is allowed.
CLI::Option* add_whole(CLI::App& app, const std::string& name, std::int64_t least,
                       std::int64_t most, std::int64_t preset,
                       const std::function<void(std::int64_t)>& set,
                       const std::string& description);
enum class Least { zero, above_zero };
CLI::Option* add_number(CLI::App& app, const std::string& name, Least least, double most,
                        double& number, const std::string& description);

// --role, --parameter and --mesh-size, as `meshgen --convert` has them and judges them; settings
// gets them in its words.
void add_model_settings(CLI::App& app, std::vector<std::string>& settings);

// A word as the shell reads it again: in quotation marks where it has more than letters, digits and
// what is nothing to the shell.
std::string shell_word(const std::string& word);

// A command for the shell with the folder as its last argument, whatever becomes of it; empty:
// none.
void run_after(const std::string& command, const std::filesystem::path& folder);

}  // namespace airybench
