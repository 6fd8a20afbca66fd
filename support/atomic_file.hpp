// Writes files and folders completely or not at all, even after a power failure.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace airybench {

// Follows a link and keeps the permissions of the file it replaces. Throws FileError "file: why",
// also for anything but a regular file; the old file is untouched then.
void write_file_atomically(const std::filesystem::path& file, std::string_view bytes);

using Files = std::map<std::string, std::string>;  // bytes by name

// Throws FileError "folder: why", also for anything but an empty folder; leaves nothing then.
void write_folder_atomically(const std::filesystem::path& folder, const Files& files);
// Throws FileError as write_folder_atomically() would, before the work for its files.
void check_is_free(const std::filesystem::path& folder);

// Also makes its parents. Throws FileError.
void make_folder(const std::filesystem::path& folder);

// Continues after partial writes. Returns 0 or errno.
int write_all(int descriptor, std::string_view bytes);
// False if the file of that name was removed or replaced since it was opened.
bool is_open_as(int descriptor, const std::filesystem::path& file);
// Waits until names made or removed in the folder are on disk, where the file system supports it.
void sync_folder(const std::filesystem::path& folder);

}  // namespace airybench
