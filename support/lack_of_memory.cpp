#include "support/lack_of_memory.hpp"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

namespace airybench {
namespace {

const char* line = "";
int code = 0;

[[noreturn]] void end() {
  try {
    if (std::current_exception() != nullptr) throw;
  } catch (const std::bad_alloc&) {
    std::fputs(line, stderr);
    std::_Exit(code);
  } catch (...) {
  }
  std::abort();
}

}  // namespace

void end_for_lack_of_memory_with(const char* message, int exit_code) {
  line = message;
  code = exit_code;
  std::set_terminate(end);
}

}  // namespace airybench
