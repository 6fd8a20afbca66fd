// `bench [options]`: plans the cases, runs them, shows the table.
#pragma once

namespace airybench {

// argv[0] is the program's name. Prints; returns the exit code. Throws HelpRequested, UsageError,
// FileError, Interrupted and what reading meshes and scenes throws.
int run_command(int argc, const char* const* argv);

}  // namespace airybench
