// `bench [options]`: measures cases and writes their records.
#pragma once

namespace airybench {

// argv[0] is the program's name. Prints progress and the table. 0: every case is ok or skipped; 1:
// some case is not. Throws HelpRequested, UsageError and what reading and writing files throws.
int run_command(int argc, const char* const* argv);

}  // namespace airybench
