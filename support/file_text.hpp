#pragma once

#include <filesystem>
#include <string>

namespace airybench {

// All bytes of a regular file of up to 1 GiB. Throws FileError "file: why".
std::string file_text(const std::filesystem::path& file);

}  // namespace airybench
