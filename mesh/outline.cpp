#include "mesh/outline.hpp"

#include <Eigen/Geometry>

#include "mesh/mesh.hpp"

namespace airybench {
namespace {

using Found = std::optional<std::array<int, 2>>;

int side_of(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& x) {
  const auto area = cross_area<long double>(a, b, x);
  return (area > 0) - (area < 0);
}

class Outline {
 public:
  explicit Outline(const std::vector<Eigen::Vector2d>& polygon)
      : polygon_(polygon), boxes_(4 * polygon.size()) {
    build(whole());
  }
  Found meets_itself() const { return within(whole()); }

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

  int size() const { return static_cast<int>(polygon_.size()); }
  Node whole() const { return {0, 0, size()}; }
  const Eigen::Vector2d& corner(int i) const { return polygon_[i % size()]; }

  const Eigen::AlignedBox2d& build(const Node& node) {
    Eigen::AlignedBox2d& box = boxes_[node.k];
    if (node.is_edge())
      box.extend(corner(node.begin)).extend(corner(node.begin + 1));
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
    if (j == i + 1) return fold_back(i, j, j + 1);
    if (i == 0 && j == size() - 1) return fold_back(j, 0, 1);
    const Eigen::Vector2d &a = corner(i), &b = corner(i + 1), &c = corner(j), &d = corner(j + 1);
    const int of_c = side_of(a, b, c), of_d = side_of(a, b, d);
    const int of_a = side_of(c, d, a), of_b = side_of(c, d, b);
    const bool in_line = of_a == 0 && of_b == 0 && of_c == 0 && of_d == 0;
    return in_line || (of_a != of_b && of_c != of_d);
  }
  bool fold_back(int before, int at, int after) const {
    const Eigen::Vector2d &x = corner(at), &p = corner(before), &q = corner(after);
    return side_of(x, p, q) == 0 && (p - x).dot(q - x) > 0;
  }

  const std::vector<Eigen::Vector2d>& polygon_;
  std::vector<Eigen::AlignedBox2d> boxes_;
};

}  // namespace

Found where_it_meets_itself(const std::vector<Eigen::Vector2d>& polygon) {
  return Outline(polygon).meets_itself();
}

}  // namespace airybench
