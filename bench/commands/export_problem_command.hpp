// `bench export-problem --mesh=... --scene=... --format=... --out=FOLDER`: the matrices of a
// problem.
#pragma once

namespace airybench {

// argv[0] is "export-problem". Writes the folder; returns the exit code. Throws HelpRequested,
// UsageError, FileError and what reading meshes and scenes throws.
int export_problem_command(int argc, const char* const* argv);

}  // namespace airybench
