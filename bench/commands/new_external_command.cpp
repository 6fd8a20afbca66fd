#include <fmt/format.h>

#include "bench/commands/command_line.hpp"
#include "bench/commands/commands.hpp"
#include "bench/external/new_external.hpp"
#include "support/called_as.hpp"
#include "support/errors.hpp"

namespace airybench {

int new_external_command(int argc, const char* const* argv) {
  std::filesystem::path name;
  CLI::App app(
      "Writes NAME.py, a program that solves the contact law and runs as it is, and NAME.json, its "
      "declaration.",
      "{bench} new-external");
  app.footer(
      "\nReplace its contact_forces() by your method (docs/your-program.md).\n\n"
      "Example\n  {bench} new-external mine; {bench} check mine.json\n");
  app.add_option("NAME", name, "of the program; a folder may stand before it")->required();
  parse_command_line(app, argc, argv);
  const auto files = write_new_external(name);
  const std::string declaration = shell_word(files.back().string());
  const std::string bench = called_as("bench");
  fmt::print(
      "{} and {} written: a program that is right as it is. Change its contact_forces(), then:\n"
      "  {} check {}    (small cases that each find one mistake)\n"
      "  {} --study=check --method='HYBRID,EXTERNAL:*' --external={}    (its time, next to ours)\n"
      "Do not test with the default scene of Mesh0 to Mesh7: G is zero but for rounding there, so\n"
      "that a wrong sign of it passes.\n",
      files.front().string(), files.back().string(), bench, declaration, bench, declaration);
  return all_ok;
}

}  // namespace airybench
