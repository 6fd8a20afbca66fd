// Files that are either the old or the new text, never a part of it.
#pragma once

#include <filesystem>
#include <string_view>

namespace airybench {

// Writes beside the file, then renames; a device or a pipe is written to as it is. Throws
// FileError "file: why"; the file that was there is untouched then.
void write_file_atomically(const std::filesystem::path& file, std::string_view bytes);

// With all above it, unless it is there. Throws FileError.
void make_folder(const std::filesystem::path& folder);

}  // namespace airybench
