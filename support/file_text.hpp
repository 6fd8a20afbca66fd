#pragma once

#include <filesystem>
#include <string>

namespace airybench {

// All bytes of a file. Throws FileError "file: why".
std::string file_text(const std::filesystem::path& file);

}  // namespace airybench
