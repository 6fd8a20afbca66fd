// A folder for a test, gone when the test ends, and texts in it.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace airybench::testing {

struct TemporaryFolder : airybench::TemporaryFolder {
  TemporaryFolder() {  // other users may enter
    std::filesystem::permissions(path(), std::filesystem::perms{0755});
  }
  std::filesystem::path operator/(const std::string& name) const { return path() / name; }
};

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

inline std::filesystem::path write_text(const std::filesystem::path& file, std::string_view text) {
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

}  // namespace airybench::testing
