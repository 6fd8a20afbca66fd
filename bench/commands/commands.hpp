// The commands of bench, one per file. argv[0] is the command's name. They return the exit code,
// and throw HelpRequested, InputError (wrong usage, an unusable file) and Interrupted.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace airybench {

struct Command {
  const char* name;
  const char* operand;  // as help shows it
  const char* about;
  int (*run)(int argc, const char* const* argv);
};

std::span<const Command> all_commands();

// One line for each command, and `bench --help`: these, a run's main options, examples.
std::string list_of_commands();
std::string overview();

int advise_command(int argc, const char* const* argv);
int check_command(int argc, const char* const* argv);
int compare_command(int argc, const char* const* argv);
int explain_command(int argc, const char* const* argv);
int export_command(int argc, const char* const* argv);
int export_problem_command(int argc, const char* const* argv);
int list_command(int argc, const char* const* argv);
int merge_command(int argc, const char* const* argv);
int new_external_command(int argc, const char* const* argv);
int new_scene_command(int argc, const char* const* argv);
int profile_command(int argc, const char* const* argv);
int replay_command(int argc, const char* const* argv);
int solve_command(int argc, const char* const* argv);
int run_command(int argc, const char* const* argv);  // `bench` without a command
int track_command(int argc, const char* const* argv);
int validate_command(int argc, const char* const* argv);

// The arguments of a nightly run: the user's, and defaults for the options that these lack.
std::vector<std::string> nightly_arguments(const std::vector<std::string>& own,
                                           const std::string& out);

}  // namespace airybench
