#include "support/atomic_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <string>

#include "support/errors.hpp"

namespace airybench {

void write_file_atomically(const std::filesystem::path& file, std::string_view bytes) {
  std::error_code error, ignored;
  // A link stays, and what it points to is replaced; a device or a pipe is written to.
  const std::filesystem::path target = std::filesystem::is_symlink(file, ignored)
                                           ? std::filesystem::weakly_canonical(file, ignored)
                                           : file;
  const std::filesystem::file_status there = std::filesystem::status(target, ignored);
  const bool in_place = std::filesystem::exists(there) &&
                        !std::filesystem::is_regular_file(there) &&
                        !std::filesystem::is_directory(there);
  std::filesystem::path beside = target;
  if (!in_place) beside += ".part" + std::to_string(getpid());
  errno = 0;
  std::ofstream out(beside, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out)
    error.assign(errno != 0 ? errno : EIO, std::generic_category());
  else if (!in_place)
    std::filesystem::rename(beside, target, error);
  if (!error) return;
  if (!in_place) std::filesystem::remove(beside, ignored);
  throw FileError(file.string() + ": cannot be written: " + error.message());
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw FileError(folder.string() + ": cannot be made a folder: " + error.message());
}

}  // namespace airybench
