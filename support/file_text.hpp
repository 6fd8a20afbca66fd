#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace airybench {

// A regular file of up to 1 GiB. Both functions throw FileError "file: why".
std::string file_text(const std::filesystem::path& file);

// Never holds the whole file.
void read_parts(const std::filesystem::path& file,
                const std::function<void(std::string_view part)>& take);

}  // namespace airybench
