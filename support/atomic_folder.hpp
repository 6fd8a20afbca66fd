// Folders that are there with all their files or not at all.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace airybench {

using Files = std::map<std::string, std::string>;  // bytes by name

// Writes beside the folder under a name of chance, waits until it is on disk, renames. Throws
// FileError "folder: why", also where there is anything but an empty folder; nothing is left then.
void write_folder_atomically(const std::filesystem::path& folder, const Files& files);

// What the same would throw of a folder that is in the way, before the work for its files.
void check_is_free(const std::filesystem::path& folder);

}  // namespace airybench
