// Where no exception may pass, inside a library say, std::bad_alloc is no crash either.
#pragma once

namespace airybench {

// From now on std::terminate() for a std::bad_alloc writes the message, a line or nothing, to
// standard error and ends the process at once with this exit code.
void end_for_lack_of_memory_with(const char* message, int exit_code);

}  // namespace airybench
