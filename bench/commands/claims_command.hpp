// `bench claims DIR`: the paper's sentences against the records of a results folder.
#pragma once

namespace airybench {

// argv[0] is "claims". Returns the exit code. Prints, and writes --out where asked. Throws
// HelpRequested, UsageError, FileError.
int claims_command(int argc, const char* const* argv);

}  // namespace airybench
