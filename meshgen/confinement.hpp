// What a user's model may not do. A .geo can call any command (SystemCall) and write any file
// (Save, Printf), which a mesh does not need. Both are for good, and for the children of this
// process too.
#pragma once

#include <filesystem>

namespace airybench {

// Returns false where the kernel, or what is known of the processor's system calls, does not serve.
bool start_no_programs();                                 // execve() ends the process (seccomp)
bool write_only_in(const std::filesystem::path& folder);  // and into open files (Landlock)

}  // namespace airybench
