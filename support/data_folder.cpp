#include "support/data_folder.hpp"

namespace airybench {

std::filesystem::path data_folder(std::string_view name) {
  const auto executable = std::filesystem::read_symlink("/proc/self/exe");
  return std::filesystem::weakly_canonical(executable.parent_path() / ".." / "share" / "airybench" /
                                           name);
}

}  // namespace airybench
