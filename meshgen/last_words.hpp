#pragma once

#include <string>

namespace airybench {

// While it lives, a process that Gmsh ends says so, "meshgen: FILE: why" on standard error, and
// ends with exit code 1. Gmsh has two ways: Exit in a .geo, and an exception that leaves one of its
// threads. One at a time.
class LastWords {
 public:
  explicit LastWords(const std::string& file);
  ~LastWords();
  LastWords(const LastWords&) = delete;
  LastWords& operator=(const LastWords&) = delete;
};

}  // namespace airybench
