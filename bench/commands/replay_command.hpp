// `bench replay RECORD`: runs one recorded case again.
#pragma once

namespace airybench {

// argv[0] is "replay". Returns the exit code. Throws HelpRequested, UsageError, FileError and
// what a run throws.
int replay_command(int argc, const char* const* argv);

}  // namespace airybench
