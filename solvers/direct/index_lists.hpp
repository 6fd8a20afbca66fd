// Lists of indices, one after the other.
#pragma once

#include <span>
#include <vector>

namespace airybench {

struct IndexLists {
  std::vector<int> start = {0};  // of each list in `entry`, and the end
  std::vector<int> entry;
  int count() const { return static_cast<int>(start.size()) - 1; }
  std::span<const int> operator[](int i) const {
    return {entry.data() + start[i], entry.data() + start[i + 1]};
  }
  void end_list() { start.push_back(static_cast<int>(entry.size())); }
};

}  // namespace airybench
