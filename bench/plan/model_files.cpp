#include "bench/plan/model_files.hpp"

#include <fmt/format.h>

#include <cstring>
#include <iostream>
#include <sstream>

#include "support/data_folder.hpp"
#include "support/errors.hpp"
#include "support/process.hpp"

namespace airybench {
namespace {

constexpr const char* converter = "meshgen";
constexpr double time_limit_s = 900;

// What it says last, without its name.
std::string complaint_of(const ProgramEnd& end) {
  if (end.signal != 0)
    return fmt::format("{} was ended by a signal: {}", converter, strsignal(end.signal));
  std::istringstream lines(end.err);
  std::string last;
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) last = line;
  const std::string prefix = fmt::format("{}: ", converter);
  if (last.starts_with(prefix)) return last.substr(prefix.size());
  return fmt::format("{} ended with exit code {}: {}", converter, end.exit_code, last);
}

}  // namespace

bool can_convert_models() { return program_of_ours(converter).has_value(); }

std::string mesh_text_of_model(const std::filesystem::path& model,
                               const std::vector<std::string>& settings) {
  const auto program = program_of_ours(converter);
  if (!program)
    throw FileError(
        fmt::format("{}: a Gmsh model, but there is no {} beside this program (Debian: "
                    "install libgmsh-dev and build again, as ./run bench does)",
                    model.string(), converter));
  std::vector<std::string> arguments = {"--convert=" + model.string(), "--out=-"};
  arguments.insert(arguments.end(), settings.begin(), settings.end());
  ProgramEnd end = run_program(*program, arguments, time_limit_s);
  if (end.timed_out)
    throw FileError(fmt::format(
        "{}: {} was ended after {} s (allowed: that long; {} --convert by itself has no limit)",
        model.string(), converter, time_limit_s, converter));
  if (end.exit_code != 0) throw FileError(complaint_of(end));
  std::cerr << end.err;
  return std::move(end.out);
}

}  // namespace airybench
