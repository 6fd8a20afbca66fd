// The commands of bench, a file each. argv[0] is the command's name. They print, and return the
// exit code. They throw HelpRequested, InputError (wrong usage, an unusable file) and Interrupted.
#pragma once

#include <string>
#include <vector>

namespace airybench {

int advise_command(int argc, const char* const* argv);
int claims_command(int argc, const char* const* argv);
int compare_command(int argc, const char* const* argv);
int export_command(int argc, const char* const* argv);
int export_problem_command(int argc, const char* const* argv);
int merge_command(int argc, const char* const* argv);
int replay_command(int argc, const char* const* argv);
int run_command(int argc, const char* const* argv);  // `bench` without a word
int track_command(int argc, const char* const* argv);

// The arguments of the nightly run: `own` of the user, and the selection for what they leave open.
std::vector<std::string> nightly_arguments(const std::vector<std::string>& own,
                                           const std::string& out);

}  // namespace airybench
