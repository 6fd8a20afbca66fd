// Standard input, output and error: there from the start, checked at the end.
#pragma once

namespace airybench {

// Opens those of the descriptors 0 to 2 that are closed, on /dev/null: else the first files that
// are opened would be taken for them.
void open_standard_streams();

// How a command ends: `code`, but wrong_usage where that is less and something could not be written
// to standard output (a full disk; said on standard error in the program's name) or to standard
// error.
int checked_exit_code(int code, const char* program);

}  // namespace airybench
