#include "meshgen/last_words.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>

#include "meshgen/gmsh_mesher.hpp"

namespace airybench {
namespace {

std::string file_in_work;
std::terminate_handler handler_before = nullptr;

[[noreturn]] void end_with(const char* why) {
  std::fprintf(stderr, "meshgen: %s: %s\n", file_in_work.c_str(), why);
  _exit(1);
}

void at_exit() {
  if (!file_in_work.empty()) end_with("the model ends Gmsh (Exit)");
}

[[noreturn]] void at_terminate() {
  try {
    if (std::current_exception()) end_with(("Gmsh: " + message_of_gmsh()).c_str());
  } catch (const std::bad_alloc&) {
    end_with("out of memory");
  } catch (const std::exception& error) {
    end_with(error.what());
  } catch (...) {
  }
  end_with("Gmsh ended");
}

}  // namespace

LastWords::LastWords(const std::string& file) {
  file_in_work = file;
  [[maybe_unused]] static const int registered = std::atexit(at_exit);
  handler_before = std::set_terminate(at_terminate);
}

LastWords::~LastWords() {
  std::set_terminate(handler_before);
  file_in_work.clear();
}

}  // namespace airybench
