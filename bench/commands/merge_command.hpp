// `bench merge DIR... --out=DIR`: joins the shards of a run.
#pragma once

namespace airybench {

// argv[0] is "merge". Returns the exit code. Throws HelpRequested, UsageError, FileError.
int merge_command(int argc, const char* const* argv);

}  // namespace airybench
