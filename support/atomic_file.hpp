// Files that are either the old or the new text, never a part of it, also after a power failure.
#pragma once

#include <filesystem>
#include <string_view>

namespace airybench {

// Writes beside the file under a name of chance, waits until it is on disk, renames. A link stays,
// and what it points to is replaced, with its permissions. Throws FileError "file: why", also where
// there is anything but a regular file; what was there is untouched then.
void write_file_atomically(const std::filesystem::path& file, std::string_view bytes);

// A name of chance in the same folder.
std::filesystem::path name_beside(const std::filesystem::path& target);
// All bytes, however often the kernel takes only a part. 0, or errno.
int write_all(int descriptor, std::string_view bytes);
// Is what is open the file of that name, not one that was removed or replaced since?
bool is_open_as(int descriptor, const std::filesystem::path& file);
// Waits until names made or removed in the folder are on disk, where the file system can say so.
void sync_folder(const std::filesystem::path& folder);

// With all above it, unless it is there. Throws FileError.
void make_folder(const std::filesystem::path& folder);

}  // namespace airybench
