// Finds the data and programs that come with this program.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace airybench {

// "meshes", "scenes/stability", "results": a folder of ../share/airybench as seen from the
// executable, so that no object file holds a path of the build machine. Throws FileError.
std::filesystem::path data_folder(std::string_view name);

// Of a library in another program: what follows is found from this folder, not the executable's.
void take_for_program_in(std::filesystem::path folder);

// "airybench-name" next to this program, or name/name in the build tree; empty if there is none.
std::optional<std::filesystem::path> program_of_ours(const std::string& name);

}  // namespace airybench
