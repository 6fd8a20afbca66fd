#include <fmt/format.h>

#include "bench/commands/command_line.hpp"
#include "bench/commands/commands.hpp"
#include "bench/external/new_external.hpp"
#include "support/called_as.hpp"
#include "support/errors.hpp"

namespace airybench {

int new_external_command(int argc, const char* const* argv) {
  NewExternal asked;
  CLI::App app(
      "Writes a program that runs, NAME.py or NAME.cpp, and its declaration NAME.json. It solves "
      "the contact law, or in C++ a body in displacements.",
      "{bench} new-external");
  app.footer(
      "\nReplace its contact_forces() by your method (docs/your-program.md).\n\n"
      "Example\n  {bench} new-external mine; {bench} check mine.json\n");
  app.add_option("NAME", asked.stem, "name of the program, with a folder if wanted")->required();
  app.add_option("--language", asked.language, "python, c++")
      ->check(CLI::IsMember({"python", "c++"}))
      ->capture_default_str();
  app.add_option("--reads", asked.reads, "condensed: the contact law; body: mesh and loads")
      ->check(CLI::IsMember({"condensed", "body"}))
      ->capture_default_str();
  parse_command_line(app, argc, argv);
  const auto files = write_new_external(asked);
  const std::string declaration = shell_word(files.back().string());
  const std::string bench = called_as("bench");
  fmt::print("{} and {} written: a program that is right as it is.\n", files.front().string(),
             files.back().string());
  if (asked.language == "c++")
    fmt::print("  g++ -O2 -std=c++17 -I/usr/include/eigen3 -o {} {}    (Debian: libeigen3-dev)\n",
               shell_word(asked.stem.string()), shell_word(files.front().string()));
  fmt::print(
      "Change {}, then:\n"
      "  {} check {}    (small cases that each find one mistake)\n"
      "  {} --study=check --method='HYBRID,EXTERNAL:*' --external={}    (its time, next to ours)\n"
      "Do not test with the default scene of Mesh0 to Mesh7: G is zero but for rounding there, so\n"
      "that a wrong sign of it passes.\n",
      asked.reads == "body" ? "its solve()" : "its contact_forces()", bench, declaration, bench,
      declaration);
  return all_ok;
}

}  // namespace airybench
