// An append-only file of lines. Each line is on disk before the run continues.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "support/errors.hpp"

namespace airybench {

struct Line {
  std::int64_t begin = 0, size = 0;  // in its file, without '\n'
  std::int64_t number = 0;           // from 1
};

class Journal {
 public:
  Journal() = default;  // closed
  // Opens a file of this size for appending. Throws FileError, also if it is another file by now.
  Journal(const std::filesystem::path& file, std::int64_t size);
  ~Journal();
  Journal(Journal&& other) noexcept;
  Journal& operator=(Journal&& other) noexcept;

  bool is_open() const { return descriptor_ >= 0; }
  // Returns where the line begins, when it is on disk (fsync). Throws FileError if writing fails,
  // and removes the partial line, or if somebody removed, replaced or changed the file.
  std::int64_t append(const std::string& line);
  std::string text_of(const Line& line) const;  // throws FileError

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
  std::int64_t end_ = 0;
};

inline constexpr std::size_t longest_line = std::size_t{16} << 20;

// Splits text that comes in parts into its complete lines.
class LineSplitter {
 public:
  using Take = std::function<void(const std::string& text, const Line& line)>;
  LineSplitter(std::string file, Take take);  // file: in messages
  // Throws FileError if a line is longer than 16 MiB, or if there are more than a million.
  void add(std::string_view part);
  bool is_torn() const { return !text_.empty(); }  // an incomplete line follows

 private:
  std::string file_;
  Take take_;
  std::string text_;
  Line line_{0, 0, 1};
};

}  // namespace airybench
