// An append-only file of lines. Each line is on disk before the run continues.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "support/errors.hpp"

namespace airybench {

class Journal {
 public:
  Journal() = default;  // closed
  // Opens for appending. Throws FileError, also if the file is not a regular file.
  explicit Journal(const std::filesystem::path& file);
  ~Journal();
  Journal(Journal&& other) noexcept;
  Journal& operator=(Journal&& other) noexcept;

  bool is_open() const { return descriptor_ >= 0; }
  // Returns when the line is on disk (fsync). Throws FileError if writing fails, and removes the
  // partial line, or if the file was removed or replaced.
  void append(const std::string& line);

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

struct JournalLines {
  std::vector<std::string> lines;  // complete lines without '\n'
  bool torn = false;               // an incomplete line follows; its writer was stopped
};
JournalLines journal_lines_of(const std::string& text);
// A missing file has no lines. Throws FileError.
JournalLines read_journal(const std::filesystem::path& file);

}  // namespace airybench
