#include "support/lack_of_memory.hpp"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

namespace airybench {
namespace {

const char* last_words = "";
int last_code = 0;

[[noreturn]] void end() {
  try {
    if (std::current_exception() != nullptr) throw;
  } catch (const std::bad_alloc&) {
    std::fputs(last_words, stderr);
    std::_Exit(last_code);
  } catch (...) {
  }
  std::abort();
}

}  // namespace

void end_for_lack_of_memory_with(const char* message, int exit_code) {
  last_words = message;
  last_code = exit_code;
  std::set_terminate(end);
}

}  // namespace airybench
