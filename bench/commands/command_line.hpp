// What the commands' lines have in common.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "bench/plan/options.hpp"

namespace airybench {

// app.parse(argc, argv), with CLI11's ways to end as ours: HelpRequested (help, version),
// UsageError (one line; for an unknown word with what is valid; also for "--out=", whose value
// would be the next argument).
void parse_command_line(CLI::App& app, int argc, const char* const* argv);

// Numbers of options (support/numbers.hpp). Throw UsageError: option, value and what is allowed.
enum class Least { zero, above_zero };
double read_number(const std::string& option, const std::string& text, Least least, double most);
std::int64_t read_whole(const std::string& option, const std::string& text, std::int64_t least,
                        std::int64_t most);
inline constexpr double most_of_a_limit = 1e9;

CLI::Option* add_number(CLI::App& app, const std::string& name, Least least, double most,
                        double& number, const std::string& description);
// Of an int, or an optional without a default.
template <typename Number>
CLI::Option* add_whole(CLI::App& app, const std::string& name, std::int64_t least,
                       std::int64_t most, Number& number, const std::string& description) {
  CLI::Option* option = app.add_option_function<std::string>(
      name,
      [=, &number](const std::string& text) {
        number = static_cast<int>(read_whole(name, text, least, most));
      },
      description);
  if constexpr (std::is_arithmetic_v<Number>) option->default_str(std::to_string(number));
  return option->type_name("INT");
}

// "5..50,within=30": items of an option's value, and settings by their keys. Throws UsageError for
// another key than `keys`, or one that is there twice.
struct ValueParts {
  ValueParts(const std::string& option, const std::string& text,
             const std::vector<std::string>& keys);

  const std::string& only_item() const;  // UsageError: there are more, or none
  std::optional<std::string> setting(const std::string& key) const;
  std::optional<double> number(const std::string& key, double most) const;  // above 0

  std::string option, text;
  std::vector<std::string> items;
  std::map<std::string, std::string> settings;
};

// Files and globs, separated by commas; a glob that matches nothing is a file's name.
void add_files(CLI::App& app, const char* option, std::vector<std::filesystem::path>& files,
               const std::string& about);
// --memory-limit, in MiB.
void add_memory_limit(CLI::App& app, Options& options);
// --role, --parameter and --mesh-size, as `meshgen --convert` has them and judges them; settings
// gets them in its words.
void add_model_settings(CLI::App& app, std::vector<std::string>& settings);
// --mesh with these, and --scene, for a command that takes one of each.
void add_one_body(CLI::App& app, Options& options);

// The command line of a run (run_options.cpp). Throws UsageError, HelpRequested.
Options parse_options(int argc, const char* const* argv);

}  // namespace airybench
