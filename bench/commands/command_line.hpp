// Options and parsing that several commands share.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "bench/plan/options.hpp"

namespace airybench {

// Throws HelpRequested (help, version) or UsageError (one line; lists the valid options if one is
// unknown). Refuses "--out=", because CLI11 would take the next argument as its value.
void parse_command_line(CLI::App& app, int argc, const char* const* argv);

// Parse numbers (support/numbers.hpp). Throw UsageError: option, value, allowed values.
enum class Least { zero, above_zero };
double read_number(const std::string& option, const std::string& text, Least least, double most);
std::int64_t read_whole(const std::string& option, const std::string& text, std::int64_t least,
                        std::int64_t most);
inline constexpr double max_limit = 1e9;

CLI::Option* add_number(CLI::App& app, const std::string& name, Least least, double most,
                        double& number, const std::string& description);
// Number: int, or std::optional<int> without a default.
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

// Splits an option's value, as "5..50,within=30", into items and settings. Throws UsageError for a
// key that is not in `keys` or is repeated.
struct ValueParts {
  ValueParts(const std::string& option, const std::string& text,
             const std::vector<std::string>& keys);

  const std::string& only_item() const;  // throws UsageError unless there is one
  std::optional<std::string> setting(const std::string& key) const;
  std::optional<double> number(const std::string& key, double most) const;  // above 0

  std::string option, text;
  std::vector<std::string> items;
  std::map<std::string, std::string> settings;
};

// Takes files and globs, separated by commas; a glob without a match is taken as a file name.
void add_files(CLI::App& app, const char* option, std::vector<std::filesystem::path>& files,
               const std::string& about);
void add_memory_limit(CLI::App& app, Limits& limits);
// --role, --parameter and --mesh-size become `settings` for `meshgen --convert`, which checks them.
void add_model_settings(CLI::App& app, std::vector<std::string>& settings);
// --mesh with model settings, and --scene: one of each.
void add_one_body(CLI::App& app, RunSettings& run);
// MODEL, SCENE, --steps and model settings, of one part.
void add_part(CLI::App& app, RunSettings& run);

// --degree: of HYBRID, for the levels and, unless methods were given, for the cases. After the
// goals of --adapt, which `auto` goes by. Throws UsageError.
void read_degree(const std::string& text, bool keeps_methods, RunSettings& run);

// Stores an argument of Google Benchmark's as options, because plan and records depend on them.
// Throws UsageError.
void take_benchmark_argument(const std::string& argument, Options& options);

// The options of a run, or of what is told of it instead. Throws UsageError, HelpRequested.
enum class Asked { run, explanation };
Options parse_options(int argc, const char* const* argv, Asked asked = Asked::run);

}  // namespace airybench
