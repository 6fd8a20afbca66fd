#include "support/data_folder.hpp"

#include "support/errors.hpp"

namespace airybench {

std::filesystem::path data_folder(std::string_view name) {
  const auto executable = std::filesystem::read_symlink("/proc/self/exe");
  const auto place = executable.parent_path().parent_path() / "share" / "airybench" / name;
  // Permission is missing where a folder above cannot be entered by the user who started us.
  std::error_code error;
  std::filesystem::path folder = std::filesystem::weakly_canonical(place, error);
  if (error)
    throw FileError(place.string() + ": the program's data cannot be read: " + error.message());
  return folder;
}

}  // namespace airybench
