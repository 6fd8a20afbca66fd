// `bench new-external mine`: a program that runs at once, and its declaration.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace airybench {

struct NewExternal {
  std::filesystem::path stem;
  std::string language = "python";  // or c++
  std::string reads = "condensed";  // or, in C++, body
};
// Writes STEM.py or STEM.cpp, and STEM.json, both or neither, and returns their names. The programs
// are those of bench/external/templates. Throws UsageError if the name is not a plain one,
// FileError if a file is there already or no python3 has NumPy.
std::vector<std::filesystem::path> write_new_external(const NewExternal& asked);

}  // namespace airybench
