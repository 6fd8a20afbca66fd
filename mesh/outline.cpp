#include "mesh/outline.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "mesh/mesh.hpp"
#include "support/wide.hpp"

namespace airybench {
namespace {

using Found = std::optional<std::array<int, 2>>;  // edges, counted through all polygons

int side_of(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& x) {
  const auto area = cross_area<Wide>(a, b, x);
  return (area > 0) - (area < 0);
}

class Outline {
 public:
  explicit Outline(const std::vector<std::vector<Eigen::Vector2d>>& polygons) {
    for (const auto& polygon : polygons) {
      first_.push_back(size());
      corners_.insert(corners_.end(), polygon.begin(), polygon.end());
      for (int i = first_.back(); i < size(); ++i)
        next_.push_back(i + 1 < size() ? i + 1 : first_.back());
    }
    boxes_.resize(4 * corners_.size());
    build(whole());
  }
  Found meets_itself() const { return within(whole()); }
  PolygonEdge edge(int i) const {
    const auto polygon = std::ranges::upper_bound(first_, i) - first_.begin() - 1;
    return {static_cast<int>(polygon), i - first_[polygon]};
  }

 private:
  // Edges [begin, end); the box of node k is boxes_[k], those of its halves 2k + 1 and 2k + 2.
  struct Node {
    std::size_t k;
    int begin, end;
    bool is_edge() const { return end - begin == 1; }
    int middle() const { return begin + (end - begin) / 2; }
    Node first() const { return {2 * k + 1, begin, middle()}; }
    Node second() const { return {2 * k + 2, middle(), end}; }
  };

  int size() const { return static_cast<int>(corners_.size()); }
  Node whole() const { return {0, 0, size()}; }

  const Eigen::AlignedBox2d& build(const Node& node) {
    Eigen::AlignedBox2d& box = boxes_[node.k];
    if (node.is_edge())
      box.extend(corners_[node.begin]).extend(corners_[next_[node.begin]]);
    else
      box.extend(build(node.first())).extend(build(node.second()));
    return box;
  }

  Found within(const Node& node) const {
    if (node.is_edge()) return {};
    if (const Found found = within(node.first())) return found;
    if (const Found found = within(node.second())) return found;
    return between(node.first(), node.second());
  }

  Found between(const Node& a, const Node& b) const {
    if (!boxes_[a.k].intersects(boxes_[b.k])) return {};
    if (a.is_edge() && b.is_edge())
      return meet(a.begin, b.begin) ? Found({a.begin, b.begin}) : Found();
    if (a.end - a.begin < b.end - b.begin) {
      if (const Found found = between(a, b.first())) return found;
      return between(a, b.second());
    }
    if (const Found found = between(a.first(), b)) return found;
    return between(a.second(), b);
  }

  // i < j; their boxes meet.
  bool meet(int i, int j) const {
    if (next_[i] == j) return fold_back(i, j, next_[j]);
    if (next_[j] == i) return fold_back(j, i, next_[i]);
    const Eigen::Vector2d &a = corners_[i], &b = corners_[next_[i]], &c = corners_[j],
                          &d = corners_[next_[j]];
    const int of_c = side_of(a, b, c), of_d = side_of(a, b, d);
    const int of_a = side_of(c, d, a), of_b = side_of(c, d, b);
    const bool in_line = of_a == 0 && of_b == 0 && of_c == 0 && of_d == 0;
    return in_line || (of_a != of_b && of_c != of_d);
  }
  bool fold_back(int before, int at, int after) const {
    const Eigen::Vector2d &x = corners_[at], &p = corners_[before], &q = corners_[after];
    return side_of(x, p, q) == 0 && (p - x).dot(q - x) > 0;
  }

  std::vector<Eigen::Vector2d> corners_;
  std::vector<int> next_;   // corner of the same polygon
  std::vector<int> first_;  // corner of each polygon
  std::vector<Eigen::AlignedBox2d> boxes_;
};

}  // namespace

std::optional<std::array<PolygonEdge, 2>> where_they_meet(
    const std::vector<std::vector<Eigen::Vector2d>>& polygons) {
  const Outline outline(polygons);
  const Found found = outline.meets_itself();
  if (!found) return {};
  return std::array{outline.edge(found->front()), outline.edge(found->back())};
}

}  // namespace airybench
