// SHA256SUMS next to mesh files, as `sha256sum -c` reads it: "<64 hexadecimal digits>  <file>".
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace airybench {

inline constexpr std::string_view checksums_file_name = "SHA256SUMS";

// Hash by file name. Throws std::runtime_error "file:line: ..." for a line of another form.
std::map<std::string, std::string> read_checksums(const std::filesystem::path& file);

// The text for all catalogue meshes present in a folder.
std::string checksums_of_folder(const std::filesystem::path& folder);

}  // namespace airybench
