// `bench [options]`: plans the cases, runs them, shows the table.
#pragma once

namespace airybench {

enum ExitCode { all_ok = 0, some_case_failed = 1, wrong_usage = 2 };  // 128 + n: ended by signal n

// argv[0] is the program's name. Prints; returns the exit code. Throws HelpRequested, UsageError,
// OutputError, Interrupted and what reading meshes and scenes throws.
int run_command(int argc, const char* const* argv);

}  // namespace airybench
