#include "bench/measure/contact_zones.hpp"

#include <algorithm>
#include <cmath>

namespace airybench {
namespace {

// Points from the given side on without a gap.
int leading(const ZoneEdge& edge, bool from_start) {
  int count = 0;
  for (int n = static_cast<int>(edge.is_inside.size()); count < n; ++count)
    if (!edge.is_inside[from_start ? count : n - 1 - count]) break;
  return count;
}
int inside(const ZoneEdge& edge) {
  return static_cast<int>(std::ranges::count(edge.is_inside, true));
}
bool is_whole(const ZoneEdge& edge) { return std::ranges::count(edge.is_inside, false) == 0; }

// a − s₁. An edge that is all in the zone may have the forces of as much of the next as that one's
// first point, which has none, stands for.
double reach_mm(const ZoneEdge& before, const ZoneEdge& last, const ZoneEdge* after) {
  const double share = std::pow(last.force_N / (before.force_N + last.force_N), 2. / 3);
  double most_mm = last.length_mm;
  if (is_whole(last) && after != nullptr)
    most_mm += after->length_mm / static_cast<double>(after->is_inside.size());
  return std::clamp(share * before.length_mm / (1 - share), 0., most_mm);
}

}  // namespace

std::vector<double> zone_lengths_mm(const std::vector<ZoneEdge>& edges, bool is_loop) {
  const int count = static_cast<int>(edges.size());
  const auto at = [&](int k) -> const ZoneEdge* {
    if (is_loop) k = (k + count) % count;
    return k >= 0 && k < count ? &edges[k] : nullptr;
  };
  std::vector<double> lengths;
  for (int k = 0; k < count; ++k) {
    const ZoneEdge& edge = edges[k];
    double length = edge.length_mm * inside(edge) / static_cast<double>(edge.is_inside.size());
    for (const bool ahead : {true, false}) {
      const ZoneEdge *before = at(ahead ? k - 1 : k + 1), *after = at(ahead ? k + 1 : k - 1);
      const bool comes_from_before = before != nullptr && is_whole(*before) &&
                                     before->force_N > 0 && edge.force_N >= 0 &&
                                     leading(edge, ahead) == inside(edge),
                 ends = !is_whole(edge) || (after != nullptr && leading(*after, ahead) == 0);
      if (inside(edge) > 0 && comes_from_before && ends) length = reach_mm(*before, edge, after);
    }
    lengths.push_back(length);
  }
  return lengths;
}

}  // namespace airybench
