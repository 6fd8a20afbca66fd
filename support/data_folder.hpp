// Where the program finds the data that comes with it.
#pragma once

#include <filesystem>
#include <string_view>

namespace airybench {

// "meshes", "scenes/stability", "results": that folder of ../share/airybench, beside the folder of
// the running executable: in the build tree links to the sources, after an installation copies. So
// no object file holds a path of the machine that compiled it. FileError: it cannot be reached.
std::filesystem::path data_folder(std::string_view name);

}  // namespace airybench
