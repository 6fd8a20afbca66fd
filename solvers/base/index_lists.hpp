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

// `count` lists of what visit(add) adds by add(list, index), in that order; it is called twice.
template <typename Visit>
IndexLists gather_lists(int count, Visit visit) {
  IndexLists lists;
  lists.start.assign(static_cast<std::size_t>(count) + 1, 0);
  visit([&](int list, int) { ++lists.start[list + 1]; });
  std::partial_sum(lists.start.begin(), lists.start.end(), lists.start.begin());
  lists.entry.resize(static_cast<std::size_t>(lists.start.back()));
  std::vector<int> next(lists.start.begin(), lists.start.end() - 1);
  visit([&](int list, int index) { lists.entry[next[list]++] = index; });
  return lists;
}

}  // namespace airybench
