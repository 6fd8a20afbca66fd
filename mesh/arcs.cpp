#include "mesh/arcs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "mesh/circle.hpp"
#include "mesh/coordinate_rounding.hpp"

namespace airybench {
namespace {

using Point = Eigen::Vector2d;

bool may_be_arc(const EdgeCurve& curve) { return curve.is_straight() || curve.degree() == 2; }

// Consecutive edges of one group, all straight or all parabolas, from vertex to vertex; closed if
// the last is the first.
class Chords {
 public:
  Chords(Mesh& mesh, std::vector<int> rows, double mm_per_unit)
      : mesh_(mesh),
        rows_(std::move(rows)),
        are_parabolas_(!mesh.boundary[rows_.front()].curve.is_straight()),
        fewest_edges_(are_parabolas_ ? 2 : 4),
        largest_turn_((are_parabolas_ ? std::numbers::pi / 4 : std::numbers::pi / 6) * 1.03),
        tolerance_mm_(tolerance(mm_per_unit)) {}

  int recognise() {
    // A closed side may start within an arc; then it is walked from the end of one.
    if (const auto [first, last] = next_arc(0); is_closed() && last < edges() && first < last)
      std::rotate(rows_.begin(), rows_.begin() + last, rows_.end());
    int found = 0;
    for (int from = 0; from < edges();) {
      const auto [first, last] = next_arc(from);
      if (first < last) bend(first, last);
      found += last - first;
      from = std::max(last, from + 1);
    }
    return found;
  }

 private:
  int edges() const { return static_cast<int>(rows_.size()); }
  const Point& x(int k) const {
    const bool is_last = k == edges();
    return mesh_.vertices[mesh_.boundary[rows_[is_last ? k - 1 : k]].vertices[is_last ? 1 : 0]];
  }
  bool is_closed() const { return x(0) == x(edges()); }

  double tolerance(double mm_per_unit) const {
    std::vector<Point> points;
    for (int k = 0; k <= edges(); ++k) points.push_back(x(k));
    return rounding_of_points(points, mm_per_unit);
  }

  // The circle that the vertices from first to last lie on.
  std::optional<Circle> circle_of(int first, int last) const {
    constexpr double min_sagitta = 20;  // of the tolerance, or it is straight
    const int n = last - first, third = x(first) == x(last) ? n / 3 : n / 2;
    const auto circle = circle_through(x(first), x(first + third), x(first + 2 * third));
    if (!circle) return {};
    const double sense = cross_area(x(first), x(first + third), x(first + 2 * third)) > 0 ? 1 : -1;
    const double longest = 2 * circle->radius_mm * std::sin(largest_turn_ / 2);
    for (int k = first; k < last; ++k) {
      const Point &from = x(k), &to = x(k + 1);
      const auto is_off = [&](const Point& p) {
        return std::abs((p - circle->centre_mm).norm() - circle->radius_mm) > tolerance_mm_;
      };
      if (is_off(to) || (are_parabolas_ && is_off(mesh_.boundary[rows_[k]].curve.points_mm[1])) ||
          (to - from).norm() > longest || sense * cross_area(circle->centre_mm, from, to) <= 0)
        return {};
    }
    const double whole = (x(first + third) - x(first)).norm();
    if (whole * whole / (8 * circle->radius_mm) < min_sagitta * tolerance_mm_) return {};
    return circle;
  }
  // From and to a vertex; none: both are the end.
  std::pair<int, int> next_arc(int from) const {
    for (int first = from; first + fewest_edges_ <= edges(); ++first)
      if (circle_of(first, first + fewest_edges_)) return {first, end_of_arc(first)};
    return {edges(), edges()};
  }
  int end_of_arc(int first) const {
    int known = first + fewest_edges_, step = fewest_edges_;
    for (; known + step <= edges() && circle_of(first, known + step); step *= 2) known += step;
    for (; step > 0; step /= 2)
      if (known + step <= edges() && circle_of(first, known + step)) known += step;
    return known;
  }

  void bend(int first, int last) {
    const Circle circle = *circle_of(first, last);
    for (int k = first; k < last; ++k) {
      const Point from = x(k) - circle.centre_mm, to = x(k + 1) - circle.centre_mm;
      const double start = std::atan2(from.y(), from.x()),
                   turn = std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
      std::vector<Point> points;
      for (int i = 0; i <= EdgeCurve::max_degree; ++i) {
        const double s = static_cast<double>(i) / EdgeCurve::max_degree, angle = start + s * turn,
                     radius = (1 - s) * from.norm() + s * to.norm();
        points.emplace_back(circle.centre_mm + radius * Point(std::cos(angle), std::sin(angle)));
      }
      points.front() = x(k);
      points.back() = x(k + 1);
      mesh_.boundary[rows_[k]].curve = EdgeCurve{points};
    }
  }

  Mesh& mesh_;
  std::vector<int> rows_;
  bool are_parabolas_;
  int fewest_edges_;
  double largest_turn_;  // of an edge
  double tolerance_mm_;
};

}  // namespace

int recognise_arcs(Mesh& mesh, double mm_per_unit) {
  int found = 0;
  for (const BoundaryRole role :
       {BoundaryRole::displacement, BoundaryRole::force, BoundaryRole::contact})
    for (std::vector<int>& chain : boundary_chains(mesh, role)) {
      const auto differ = [&](int a, int b) {
        const BoundaryEdge &before = mesh.boundary[a], &after = mesh.boundary[b];
        return before.group != after.group || !may_be_arc(before.curve) ||
               before.curve.degree() != after.curve.degree();
      };
      if (mesh.boundary[chain.front()].vertices[0] == mesh.boundary[chain.back()].vertices[1])
        if (const auto at = std::ranges::adjacent_find(chain, differ); at != chain.end())
          std::rotate(chain.begin(), at + 1, chain.end());
      for (auto first = chain.begin(); first != chain.end();) {
        const auto at = std::adjacent_find(first, chain.end(), differ);
        const auto last = at == chain.end() ? at : at + 1;
        if (may_be_arc(mesh.boundary[*first].curve))
          found += Chords(mesh, {first, last}, mm_per_unit).recognise();
        first = last;
      }
    }
  return found;
}

}  // namespace airybench
