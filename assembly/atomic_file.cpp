#include "assembly/atomic_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <string>

namespace airybench {

void write_file_atomically(const std::filesystem::path& file, std::string_view bytes) {
  std::filesystem::path beside = file;
  beside += ".part" + std::to_string(getpid());
  errno = 0;
  std::ofstream out(beside, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  std::error_code error;
  if (!out)
    error.assign(errno != 0 ? errno : EIO, std::generic_category());
  else
    std::filesystem::rename(beside, file, error);
  if (!error) return;
  std::error_code ignored;
  std::filesystem::remove(beside, ignored);
  throw std::runtime_error(file.string() + ": cannot be written: " + error.message());
}

}  // namespace airybench
