// Lists of indices, one after the other.
#pragma once

#include <numeric>
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
  std::span<int> operator[](int i) {
    return {entry.data() + start[i], entry.data() + start[i + 1]};
  }
  std::size_t bytes() const { return (start.size() + entry.size()) * sizeof(int); }
  void end_list() { start.push_back(static_cast<int>(entry.size())); }
};

// Of each of `count` lists the indices i, ascending, with list[i] its number; negative: in none.
inline IndexLists members(int count, const std::vector<int>& list) {
  IndexLists lists;
  lists.start.assign(static_cast<std::size_t>(count) + 1, 0);
  for (const int l : list)
    if (l >= 0) ++lists.start[l + 1];
  std::partial_sum(lists.start.begin(), lists.start.end(), lists.start.begin());
  lists.entry.resize(static_cast<std::size_t>(lists.start.back()));
  std::vector<int> next(lists.start.begin(), lists.start.end() - 1);
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i] >= 0) lists.entry[next[list[i]]++] = static_cast<int>(i);
  return lists;
}

}  // namespace airybench
