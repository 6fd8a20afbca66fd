// `bench compare A,... B,...`: the runs of two programs, case by case.
#pragma once

namespace airybench {

// argv[0] is "compare". Prints, and writes --out where asked. 0, or 1 for a regression. Throws
// HelpRequested, UsageError, FileError.
int compare_command(int argc, const char* const* argv);

}  // namespace airybench
