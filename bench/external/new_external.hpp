// `bench new-external mine`: a program that runs at once, and its declaration.
#pragma once

#include <filesystem>
#include <vector>

namespace airybench {

// Writes STEM.py and STEM.json, both or neither, and returns their names. Throws UsageError if the
// name is not a plain one, FileError if a file is there already or no python3 has NumPy.
std::vector<std::filesystem::path> write_new_external(const std::filesystem::path& stem);

}  // namespace airybench
