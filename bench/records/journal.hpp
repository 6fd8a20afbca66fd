// A file of lines that only grows, each line on disk before the run goes on.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "support/errors.hpp"

namespace airybench {

class Journal {
 public:
  Journal() = default;  // closed
  // Opens for appending. Throws FileError, also where there is anything but a regular file.
  explicit Journal(const std::filesystem::path& file);
  ~Journal();
  Journal(Journal&& other) noexcept;
  Journal& operator=(Journal&& other) noexcept;

  bool is_open() const { return descriptor_ >= 0; }
  // Returns when the line is on disk (fsync). Throws FileError: it cannot be written, and is taken
  // back; or the file was removed or replaced.
  void append(const std::string& line);

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

struct JournalLines {
  std::vector<std::string> lines;  // whole ones, without their ends
  bool torn = false;               // the start of another follows, whose writer was stopped
};
JournalLines journal_lines_of(const std::string& text);
// A file that is not there has no lines. Throws FileError.
JournalLines read_journal(const std::filesystem::path& file);

}  // namespace airybench
