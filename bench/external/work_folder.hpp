// The folder that a program works in, and what it has printed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/external/process_tree.hpp"
#include "support/atomic_folder.hpp"

namespace airybench {

// A new folder below that of temporary files ($TMPDIR); gone with all in it when the object is.
class WorkFolder {
 public:
  WorkFolder();  // throws FileError
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  // A folder in it with these files. Throws FileError.
  std::filesystem::path add(const std::string& name, const Files& files) const;

 private:
  std::filesystem::path path_;
};

// Lines that are not empty, each shortened: the first, and the last if there are more.
std::vector<std::string> printed_lines(const std::filesystem::path& file);

// "ended with exit code 3", "was ended by SIGSEGV", "was ended after the limit of 60 s".
std::string how_it_ended(const ProcessTreeEnd& end, double limit_s);

}  // namespace airybench
