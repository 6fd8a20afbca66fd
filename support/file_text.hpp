#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace airybench {

// All bytes of a regular file of up to 1 GiB. Throws FileError "file: why".
std::string file_text(const std::filesystem::path& file);

// The same bytes, part by part, without ever holding them all.
void read_parts(const std::filesystem::path& file,
                const std::function<void(std::string_view part)>& take);

}  // namespace airybench
