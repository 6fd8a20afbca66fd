#include "support/standard_streams.hpp"

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <iostream>

#include "support/errors.hpp"

namespace airybench {

void open_standard_streams() {
  for (const int descriptor : {0, 1, 2})
    if (fcntl(descriptor, F_GETFD) == -1 && errno == EBADF)
      // The lowest that is free: this one.
      static_cast<void>(open("/dev/null", descriptor == 0 ? O_RDONLY : O_WRONLY));
}

int checked_exit_code(int code, const char* program) {
  const bool flushed = std::fflush(stdout) == 0;
  if (!flushed || std::ferror(stdout) != 0) {
    std::fprintf(stderr, "%s: standard output: cannot be written (a full disk?)\n", program);
    code = std::max<int>(code, wrong_usage);
  }
  if (std::ferror(stderr) != 0 || !std::cerr) code = std::max<int>(code, wrong_usage);
  return code;
}

}  // namespace airybench
