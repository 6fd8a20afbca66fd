// Rows of equal length, one after the other.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace airybench {

template <typename Entry>
class EqualRows {
 public:
  explicit EqualRows(int length = 1) : length_(static_cast<std::size_t>(length)) {}
  EqualRows(std::size_t rows, int length, const Entry& value)
      : length_(static_cast<std::size_t>(length)), entries_(rows * length_, value) {}

  std::size_t size() const { return entries_.size() / length_; }
  int length() const { return static_cast<int>(length_); }
  std::size_t bytes() const { return entries_.size() * sizeof(Entry); }
  std::span<Entry> operator[](std::size_t row) {
    return {entries_.data() + row * length_, length_};
  }
  std::span<const Entry> operator[](std::size_t row) const {
    return {entries_.data() + row * length_, length_};
  }
  void reserve(std::size_t rows) { entries_.reserve(rows * length_); }
  void push_back(const Entry* row) { entries_.insert(entries_.end(), row, row + length_); }
  // Of all rows, one after the other.
  std::vector<Entry>& entries() { return entries_; }
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::size_t length_;
  std::vector<Entry> entries_;
};

}  // namespace airybench
