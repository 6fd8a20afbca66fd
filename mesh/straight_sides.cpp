#include "mesh/straight_sides.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <span>
#include <sstream>

#include "mesh/coordinate_rounding.hpp"

namespace airybench {
namespace {

using Line = Eigen::Hyperplane<double, 2>;

// Consecutive boundary edges of one role.
class Chain {
 public:
  Chain(Mesh& mesh, std::vector<int> rows) : mesh_(&mesh), rows_(std::move(rows)) {}

  // 0: no edges bend by more than `least`, or where digits are few; none: they are not rounded.
  std::optional<double> rounding_mm(double least, double mm_per_unit) {
    CoordinateRounding positive, negative;
    for (std::size_t k = is_closed() ? 0 : 1; k < rows_.size(); ++k)
      if (bend(k == 0 ? rows_.back() : rows_[k - 1], rows_[k]) > least)
        for (const double x : start_of(rows_[k]) / mm_per_unit)
          (x < 0 ? negative : positive).add(x);
    const std::optional<double> one = positive.unit(), other = negative.unit();
    if (!one || !other) return {};
    return mm_per_unit * std::max(*one, *other);
  }

  void straighten(double least, double most, MovedVertices& moved) {
    const auto is_corner = [&](int before, int row) {
      return is_curved(before) || is_curved(row) || bend(before, row) > most;
    };
    if (is_closed())
      if (const auto at = std::ranges::adjacent_find(rows_, is_corner); at != rows_.end())
        std::rotate(rows_.begin(), at + 1, rows_.end());
    for (std::size_t first = 0, k = 1; k <= rows_.size(); ++k) {
      if (k < rows_.size() && !is_corner(rows_[k - 1], rows_[k])) continue;
      straighten(std::span(rows_).subspan(first, k - first), least, most, moved);
      first = k;
    }
  }

 private:
  Eigen::Vector2d& start_of(int row) { return mesh_->vertices[mesh_->boundary[row].vertices[0]]; }
  Eigen::Vector2d& end_of(int row) { return mesh_->vertices[mesh_->boundary[row].vertices[1]]; }
  bool is_curved(int row) const { return !mesh_->boundary[row].curve.is_straight(); }
  bool is_closed() { return &start_of(rows_.front()) == &end_of(rows_.back()); }

  // The distance of the vertex between two edges from the line through their other ends.
  double bend(int before, int row) {
    if (start_of(before) == end_of(row)) return std::numeric_limits<double>::infinity();
    return Line::Through(start_of(before), end_of(row)).absDistance(start_of(row));
  }

  void straighten(std::span<const int> side, double least, double most, MovedVertices& moved) {
    const Eigen::Vector2d &from = start_of(side.front()), &to = end_of(side.back());
    if (from == to) return;
    const Line line = Line::Through(from, to);
    const auto distance = [&](int row) { return line.absDistance(start_of(row)); };
    const std::span<const int> inner = side.subspan(1);  // they start where vertices may move
    if (std::ranges::any_of(inner, [&](int row) { return distance(row) > most; })) return;
    for (const int row : inner) {
      if (distance(row) <= least) continue;
      ++moved.count;
      moved.furthest_mm = std::max(moved.furthest_mm, distance(row));
      start_of(row) = line.projection(start_of(row));
    }
  }

  Mesh* mesh_;
  std::vector<int> rows_;
};

}  // namespace

std::string MovedVertices::words() const {
  std::ostringstream text;
  text << "vertices moved onto straight sides: " << count << ", by up to " << std::setprecision(2)
       << furthest_mm << " mm, the rounding of its coordinates";
  return text.str();
}

MovedVertices straighten_sides(Mesh& mesh, double mm_per_unit) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& vertex : mesh.vertices) box.extend(vertex);
  // Double precision bends no edges by more than `least`.
  const double least = 1e-13 * box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff(),
               too_coarse = 1e-3 * box.sizes().minCoeff();
  const std::vector<Eigen::Vector2d> before = mesh.vertices;
  MovedVertices moved;
  for (const BoundaryRole role : {BoundaryRole::displacement, BoundaryRole::force})
    for (std::vector<int>& rows : boundary_chains(mesh, role)) {
      Chain chain(mesh, std::move(rows));
      const auto rounding = chain.rounding_mm(least, mm_per_unit);
      if (rounding && *rounding > 0 && *rounding <= too_coarse)
        chain.straighten(least, 1.5 * *rounding, moved);  // √2/2 of the vertex, √2/2 of the line
    }
  if (moved.count == 0) return {};
  try {
    validate(mesh);
  } catch (const MeshError&) {  // triangles flatter than the rounding
    mesh.vertices = before;
    return {};
  }
  return moved;
}

}  // namespace airybench
