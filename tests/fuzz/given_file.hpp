// For readers that take a file, not text.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "support/temporary_folder.hpp"

namespace airybench::fuzz {

// A file of this extension with the text, until the next call.
inline std::filesystem::path given_file(const std::string& extension, const std::string& text) {
  static const TemporaryFolder folder;
  std::filesystem::path file = folder.path() / ("fuzz" + extension);
  std::ofstream(file, std::ios::binary) << text;  // nobody waits for the disk
  return file;
}

}  // namespace airybench::fuzz
