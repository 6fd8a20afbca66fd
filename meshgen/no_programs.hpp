#pragma once

namespace airybench {

// From now on this process and its children start no other program: execve() fails with EPERM
// (seccomp, for good). A .geo can call any command (SystemCall), which a mesh does not need.
// Does nothing where the kernel or the processor's system calls are not known to it.
void start_no_programs();

}  // namespace airybench
