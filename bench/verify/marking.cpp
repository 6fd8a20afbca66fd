#include "bench/verify/marking.hpp"

#include <algorithm>
#include <numeric>

namespace airybench {

std::vector<int> bulk_marks(const std::vector<double>& parts, double fraction) {
  std::vector<int> marks;
  double sum = 0;
  for (int t = 0; t < static_cast<int>(parts.size()); ++t)
    if (parts[t] > 0) {
      marks.push_back(t);
      sum += parts[t];
    }
  std::ranges::stable_sort(marks, [&](int s, int t) { return parts[s] > parts[t]; });
  double held = 0;
  std::size_t count = 0;
  while (count < marks.size() && held < fraction * sum) held += parts[marks[count++]];
  marks.resize(count);
  std::ranges::sort(marks);
  return marks;
}

}  // namespace airybench
