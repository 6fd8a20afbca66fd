#include "meshgen/quiet_stdout.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>

namespace airybench {
namespace {

void flush_stdout() {
  std::cout.flush();
  std::fflush(stdout);
}

}  // namespace

QuietStdout::QuietStdout() {
  flush_stdout();
  saved_ = dup(STDOUT_FILENO);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, STDOUT_FILENO);
  close(nowhere);
}

QuietStdout::~QuietStdout() {
  flush_stdout();
  dup2(saved_, STDOUT_FILENO);
  close(saved_);
}

}  // namespace airybench
