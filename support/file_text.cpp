#include "support/file_text.hpp"

#include <fstream>
#include <vector>

#include "support/errors.hpp"

namespace airybench {

std::string file_text(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    throw FileError(file.string() + ": a folder, not a file");
  std::ifstream in(file, std::ios::binary);
  if (!in) throw FileError(file.string() + ": cannot be opened");
  std::string text;
  std::vector<char> chunk(1 << 16);
  do {
    in.read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
    text.append(chunk.data(), static_cast<std::size_t>(in.gcount()));
  } while (in);
  if (in.bad()) throw FileError(file.string() + ": cannot be read");
  return text;
}

}  // namespace airybench
