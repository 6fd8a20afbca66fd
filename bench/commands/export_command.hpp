// `bench export DIR --format=...`: the records of a results folder in the formats of other tools.
#pragma once

namespace airybench {

// argv[0] is "export". Prints, or writes --out; returns the exit code. Throws HelpRequested,
// UsageError, FileError.
int export_command(int argc, const char* const* argv);

}  // namespace airybench
