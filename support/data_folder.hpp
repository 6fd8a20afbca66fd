// Where the program finds what comes with it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace airybench {

// "meshes", "scenes/stability", "results": that folder of ../share/airybench, next to the folder of
// the running executable: in the build tree links to the sources, after an installation copies. So
// no object file holds a path of the machine that compiled it. FileError: it cannot be reached.
std::filesystem::path data_folder(std::string_view name);

// Another program of this project: "airybench-name" next to the running one where both are
// installed, in a folder of its name in the build tree. Empty: there is none.
std::optional<std::filesystem::path> program_of_ours(const std::string& name);

}  // namespace airybench
