// Unpacks .gz files (RFC 1952) with one or several members, which may hold up to 1 GiB.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace airybench {

// Both functions throw FileError "file: why".
std::string unpacked_text(const std::filesystem::path& file);

// Never holds the whole file.
void read_unpacked_parts(const std::filesystem::path& file,
                         const std::function<void(std::string_view part)>& take);

}  // namespace airybench
