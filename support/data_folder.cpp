#include "support/data_folder.hpp"

#include <fmt/format.h>

#include "support/errors.hpp"

namespace airybench {
namespace {

namespace fs = std::filesystem;

fs::path known_folder;  // empty: that of the executable

fs::path folder_of_program() {
  if (!known_folder.empty()) return known_folder;
  const char* const link = "/proc/self/exe";
  std::error_code error;
  const fs::path program = fs::read_symlink(link, error);
  if (error) throw FileError(fmt::format("{}: {}", link, error.message()));
  return program.parent_path();
}

}  // namespace

void take_for_program_in(fs::path folder) { known_folder = std::move(folder); }

fs::path data_folder(std::string_view name) {
  const fs::path place = folder_of_program().parent_path() / "share" / "airybench" / name;
  // Fails if the user may not enter a folder above.
  std::error_code error;
  fs::path folder = fs::weakly_canonical(place, error);
  if (error)
    throw FileError(place.string() + ": the program's data cannot be read: " + error.message());
  return folder;
}

std::optional<fs::path> program_of_ours(const std::string& name) {
  const fs::path folder = folder_of_program();
  std::error_code error;
  for (const fs::path& file : {folder / ("airybench-" + name), folder.parent_path() / name / name})
    if (fs::is_regular_file(file, error)) return file;
  return {};
}

}  // namespace airybench
