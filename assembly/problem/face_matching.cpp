#include "assembly/problem/face_matching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

#include <unsupported/Eigen/BVH>

#include "assembly/elements/edge_forces.hpp"
#include "assembly/problem/contact_pairs.hpp"
#include "assembly/problem/face_curve.hpp"
#include "mesh/transform_error.hpp"

namespace airybench {
namespace {

using Point = Eigen::Vector2d;
constexpr double min_facing = 0.5;  // of −n·m: faces up to 60° from parallel

// The edges of one or more groups, with a normal at every vertex.
struct MatchingFace {
  std::vector<int> rows;                     // of Mesh::boundary
  std::map<int, std::optional<Wall>> curve;  // per row
  std::map<int, Eigen::Vector2d> normal;     // per vertex: the mean of two edges', or the curve's
  std::set<int> fixed;                       // vertices that must stay: ends and corners
};

MatchingFace face_of(const Mesh& mesh, const std::vector<std::string>& labels, const Scene& scene) {
  MatchingFace face;
  std::map<int, std::vector<Point>> at;
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    const BoundaryEdge& edge = mesh.boundary[row];
    const std::string label = boundary_label(mesh, edge);
    if (std::ranges::count(labels, label) == 0) continue;
    face.rows.push_back(row);
    face.curve[row] = curve_of(mesh, row, scene);
    const Point &a = mesh.vertices[edge.vertices[0]], &b = mesh.vertices[edge.vertices[1]];
    const Point n = edge_frame(a, b).normal;
    for (const int v : edge.vertices)
      at[v].push_back(face.curve[row] ? normal_of_curve(*face.curve[row], mesh.vertices[v], n) : n);
  }
  for (const auto& [v, normals] : at) {
    face.normal[v] = (normals.front() + normals.back()).normalized();
    if (normals.size() < 2 || normals.front().dot(normals.back()) < min_cosine_of_face)
      face.fixed.insert(v);
  }
  return face;
}

// Where a vertex meets the other face.
struct Hit {
  int row;          // of the other face
  double s;         // along it
  double distance;  // along the normal
  Point normal;
};

// One pair of faces while their mesh is changed.
class Matcher {
 public:
  Matcher(Mesh& mesh, std::array<MatchingFace, 2> faces, double reach_mm)
      : mesh_(mesh), face_(std::move(faces)), reach_mm_(reach_mm) {
    for (const MatchingFace& face : face_)
      for (const auto& [v, n] : face.normal) triangles_at_[v];
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) put_at_vertices(t);
  }

  FaceMatching match() {
    for (const MatchingFace& face : face_)
      changes_.has_curves |= std::ranges::any_of(face.curve, [](const auto& of_row) {
        return of_row.second && !std::holds_alternative<FlatWall>(*of_row.second);
      });
    std::map<int, int> twin = snap();
    insert(twin);
    return {std::move(twin), {face_[0].normal, face_[1].normal}, changes_, split_rows_};
  }
  // A place that two vertices of the other face meet: a step or a fold of that face.
  const std::optional<Point>& met_twice() const { return met_twice_; }

 private:
  const Point& x(int v) const { return mesh_.vertices[v]; }
  std::array<int, 2> ends(int row) const { return mesh_.boundary[row].vertices; }
  double length(int row) const { return (x(ends(row)[1]) - x(ends(row)[0])).norm(); }
  Point place(int row, double s) const { return (1 - s) * x(ends(row)[0]) + s * x(ends(row)[1]); }
  // Of the edge's curve, where a normal meets it.
  double parameter(const Hit& hit) const {
    const EdgeCurve& curve = mesh_.boundary[hit.row].curve;
    return curve.is_straight() ? hit.s : curve.parameter_on_line(place(hit.row, hit.s), hit.normal);
  }
  Point edge_normal(int row) const { return edge_frame(x(ends(row)[0]), x(ends(row)[1])).normal; }
  // From a vertex of the first face along its normal to an edge of the second.
  std::optional<Hit> on_second(int v, int row) const {
    const Point n = face_[0].normal.at(v);
    const auto [from, to] = ends(row);
    const Point along = x(to) - x(from), d = x(v) - x(from);
    const double across = cross(along, n);
    if (edge_normal(row).dot(n) > -min_facing || across == 0) return {};
    return within_reach({row, clamped(cross(d, n) / across), cross(d, along) / across, n});
  }
  // From a vertex of the second face against the normal at the place met on an edge of the first:
  // with x(s) and n(s) linear along it, cross(v − x(s), n(s)) = 0 is quadratic in s.
  std::optional<Hit> on_first(int v, int row) const {
    const auto [from, to] = ends(row);
    const Point d = x(v) - x(from), along = x(to) - x(from), n = face_[0].normal.at(from),
                turn = face_[0].normal.at(to) - n;
    if (edge_normal(row).dot(face_[1].normal.at(v)) > -min_facing) return {};
    const double a = -cross(along, turn), b = cross(d, turn) - cross(along, n), c = cross(d, n);
    const double root = b * b - 4 * a * c;
    if (root < 0) return {};
    // The root that stays where a is zero.
    const double at = clamped(-2 * c / (b + std::copysign(std::sqrt(root), b)));
    const Point normal = (n + at * turn).normalized();
    return within_reach({row, at, (x(v) - place(row, at)).dot(normal), normal});
  }
  std::optional<Hit> on_other(int side, int v, int row) const {
    return side == 0 ? on_second(v, row) : on_first(v, row);
  }
  std::optional<Hit> within_reach(const Hit& hit) const {
    if (hit.s >= 0 && hit.s <= 1 && std::abs(hit.distance) <= reach_mm_) return hit;
    return {};
  }

  // The nearest hit among edges of one face, for Eigen's BVMinimize.
  struct Nearest {
    using Scalar = double;
    const Matcher& matcher;
    int side, v;
    std::optional<Hit> best = {};
    double minimumOnVolume(const Eigen::AlignedBox2d& box) const {
      return box.exteriorDistance(matcher.x(v));
    }
    double minimumOnObject(int row) {
      const std::optional<Hit> hit = matcher.on_other(side, v, row);
      if (!hit) return std::numeric_limits<double>::infinity();
      if (!best || std::abs(hit->distance) < std::abs(best->distance)) best = hit;
      return std::abs(hit->distance);
    }
  };
  using Tree = Eigen::KdBVH<double, 2, int>;  // rows of a face, as they stand
  Tree tree_of(int side) const {
    std::vector<Eigen::AlignedBox2d> boxes;
    for (const int row : face_[side].rows) {
      const auto [a, b] = ends(row);
      boxes.push_back(Eigen::AlignedBox2d(x(a)).extend(x(b)));
    }
    const std::vector<int>& rows = face_[side].rows;
    return {rows.begin(), rows.end(), boxes.begin(), boxes.end()};
  }
  // Where a vertex of a face meets the other face, whose tree it is.
  std::optional<Hit> on_other(int side, int v, const Tree& other) const {
    Nearest nearest{*this, side, v};
    Eigen::BVMinimize(other, nearest);
    return nearest.best;
  }
  // The same at the edges of one vertex of the other face.
  std::optional<Hit> beside(int side, int v, const std::vector<int>& rows) const {
    Nearest nearest{*this, side, v};
    for (const int row : rows) nearest.minimumOnObject(row);
    return nearest.best;
  }
  // Rounding beyond an end counts as the end.
  static constexpr double rounding = 1e-9;
  static double clamped(double s) {
    if (std::abs(s) < rounding) return 0;
    return std::abs(s - 1) < rounding ? 1 : s;
  }

  using RowsAt = std::map<int, std::vector<int>>;  // per vertex
  RowsAt rows_at(int side) const {
    RowsAt rows;
    for (const int row : face_[side].rows)
      for (const int v : ends(row)) rows[v].push_back(row);
    return rows;
  }
  double shortest(const std::vector<int>& rows) const {
    return length(*std::ranges::min_element(rows, {}, [&](int row) { return length(row); }));
  }

  struct Near {
    double distance;
    int first, second;
  };
  // Moves vertices that nearly match; nearest first.
  std::map<int, int> snap() {
    const std::array<RowsAt, 2> at = {rows_at(0), rows_at(1)};
    const Tree first = tree_of(0);
    std::vector<Near> near;
    for (const auto& [v, rows] : at[1])
      if (const std::optional<Hit> hit = on_other(1, v, first)) {
        const int end = ends(hit->row)[hit->s < 0.5 ? 0 : 1];
        const double distance = std::min(hit->s, 1 - hit->s) * length(hit->row);
        if (distance <= snapping * std::min(shortest(rows), shortest(at[0].at(end))))
          near.push_back({distance, end, v});
      }
    std::ranges::sort(near, {}, &Near::distance);
    std::map<int, int> twin;
    std::set<int> taken;
    for (const Near& both : near) {
      if (twin.contains(both.first) || taken.contains(both.second)) continue;
      if (!is_together(both, shortest(at[0].at(both.first))) && !move(both, at)) continue;
      twin[both.first] = both.second;
      taken.insert(both.second);
    }
    return twin;
  }
  static bool is_together(const Near& both, double edge_mm) {
    return both.distance <= 1e-9 * edge_mm;
  }
  bool move(const Near& both, const std::array<RowsAt, 2>& at) {
    if (!face_[1].fixed.contains(both.second))
      if (const std::optional<Hit> hit = beside(0, both.first, at[1].at(both.second)))
        return move_along(1, both.second, *hit, at[1].at(both.second));
    if (!face_[0].fixed.contains(both.first))
      if (const std::optional<Hit> hit = beside(1, both.second, at[0].at(both.first)))
        return move_along(0, both.first, *hit, at[0].at(both.first));
    return false;
  }
  // With the normal that its face has there.
  bool move_along(int side, int v, const Hit& hit, const std::vector<int>& rows_at_v) {
    const Point n = normal_at(side, hit.row, hit.s);
    if (!move_to(v, point_on(mesh_, mesh_.boundary[hit.row], parameter(hit)))) return false;
    for (const int row : rows_at_v) fit_curve(row, v);
    face_[side].normal[v] = n;
    return true;
  }
  // To an end v of its edge that has moved along it.
  void fit_curve(int row, int v) {
    EdgeCurve& curve = mesh_.boundary[row].curve;
    if (curve.is_straight()) return;
    const auto [a, b] = ends(row);
    const double t = curve.parameter_on_line(x(v), Point(-curve.chord().y(), curve.chord().x()));
    curve = v == a ? curve.between(t, 1) : curve.between(0, t);
    curve.move_ends(x(a), x(b));
  }
  // Unless a triangle there would lose more than half its area.
  bool move_to(int v, const Point& to) {
    const Point before = x(v);
    std::vector<double> areas;
    const auto visit = [&](auto what) {
      for (const std::size_t t : triangles_at_.at(v)) {
        const auto& [a, b, c] = mesh_.triangles[t];
        what(cross_area(x(a), x(b), x(c)));
      }
    };
    visit([&](double area) { areas.push_back(area); });
    mesh_.vertices[v] = to;
    bool fits = true;
    std::size_t k = 0;
    visit([&](double area) { fits &= area > areas[k++] / 2; });
    if (!fits) mesh_.vertices[v] = before;
    changes_.moved += fits;
    return fits;
  }

  struct Node {
    double s, t;  // on the chord and on the curve
    int vertex;   // of the other face, that it faces
    Point n;      // of the face that it is put into
  };
  void insert(std::map<int, int>& twin) {
    std::map<int, std::vector<Node>> into[2];  // per row
    std::set<int> matched;
    for (const auto& [a, b] : twin) matched.insert(b);
    const std::array<Tree, 2> trees = {tree_of(0), tree_of(1)};
    const auto is_matched = [&](int side, int v) {
      return side == 0 ? twin.contains(v) : matched.contains(v);
    };
    for (const int side : {0, 1})
      for (const auto& [v, n] : face_[side].normal) {
        if (is_matched(side, v)) continue;
        const std::optional<Hit> hit = on_other(side, v, trees[1 - side]);
        if (!hit) continue;
        if (is_inside(hit->s))
          into[1 - side][hit->row].push_back(
              {hit->s, parameter(*hit), v, normal_at(1 - side, hit->row, hit->s)});
        else if (const int end = ends(hit->row)[hit->s > 0 ? 1 : 0]; is_matched(1 - side, end))
          met_twice_ = x(end);
      }
    for (const int side : {0, 1})
      for (auto& [row, nodes] : into[side]) {
        std::ranges::sort(nodes, {}, &Node::s);
        for (std::size_t i = 1; i < nodes.size(); ++i)
          if (nodes[i].s - nodes[i - 1].s < rounding) met_twice_ = place(row, nodes[i].s);
        for (const auto& [of_this, of_other] : split(row, nodes)) {
          if (side == 0)
            twin[of_this] = of_other;
          else
            twin[of_other] = of_this;
        }
        for (const Node& node : nodes) {
          const int born = first_born_++;
          face_[side].normal[born] = node.n;
        }
      }
  }
  static bool is_inside(double s) { return s > 0 && s < 1; }
  Point normal_at(int side, int row, double s) const {
    const auto [from, to] = ends(row);
    const MatchingFace& face = face_[side];
    const Point mean = ((1 - s) * face.normal.at(from) + s * face.normal.at(to)).normalized();
    const std::optional<Wall>& curve = face.curve.at(row);
    return curve ? normal_of_curve(*curve, place(row, s), mean) : mean;
  }
  void put_at_vertices(std::size_t t) {
    for (const int v : mesh_.triangles[t])
      if (const auto at = triangles_at_.find(v); at != triangles_at_.end()) at->second.push_back(t);
  }
  // The triangle on the boundary edge ab, and its third vertex.
  std::pair<std::size_t, int> triangle_on(int a, int b) const {
    for (const std::size_t t : triangles_at_.at(a))
      for (int k = 0; k < 3; ++k)
        if (const auto& v = mesh_.triangles[t]; v[k] == a && v[(k + 1) % 3] == b)
          return {t, v[(k + 2) % 3]};
    throw std::logic_error("a boundary edge without a triangle");
  }
  // A fan from the vertex across; the row keeps its first part. Returns new vertices and what they
  // face.
  std::vector<std::pair<int, int>> split(int row, const std::vector<Node>& nodes) {
    const auto [a, b] = ends(row);
    const auto [t, across] = triangle_on(a, b);
    std::vector<std::pair<int, int>> born;
    const BoundaryEdge whole = mesh_.boundary[row];
    std::vector<BoundaryEdge> parts = {whole};
    first_born_ = static_cast<int>(mesh_.vertices.size());
    double before = 0;  // parameter of the node before
    for (const Node& node : nodes) {
      born.emplace_back(static_cast<int>(mesh_.vertices.size()), node.vertex);
      const double of_rest = (node.t - before) / (1 - before);
      mesh_.vertices.push_back(whole.curve.is_straight() ? point_on(mesh_, whole, node.t)
                                                         : point_on(mesh_, parts.back(), of_rest));
      parts.push_back(cut_at(parts.back(), born.back().first, of_rest));
      before = node.t;
    }
    changes_.inserted += static_cast<int>(born.size());
    split_rows_.push_back(row);
    mesh_.triangles[t] = {a, born.front().first, across};
    mesh_.boundary[row] = parts.front();
    for (std::size_t i = 1; i < parts.size(); ++i) {
      mesh_.triangles.push_back({parts[i].vertices[0], parts[i].vertices[1], across});
      put_at_vertices(mesh_.triangles.size() - 1);
      mesh_.triangle_body.push_back(mesh_.triangle_body[t]);
      mesh_.boundary.push_back(parts[i]);
    }
    return born;
  }

  Mesh& mesh_;
  std::array<MatchingFace, 2> face_;
  double reach_mm_;
  // Per vertex of a face. After a split also triangles that have left it.
  std::map<int, std::vector<std::size_t>> triangles_at_;
  std::vector<int> split_rows_;
  Problem::Matching changes_;
  std::optional<Point> met_twice_;
  int first_born_ = 0;
};

}  // namespace

FaceMatching match_faces(Mesh& mesh, const ContactPair& pair, const Scene& scene) {
  Matcher matcher(mesh,
                  {face_of(mesh, pair.between[0], scene), face_of(mesh, pair.between[1], scene)},
                  extent_of(mesh).diagonal_mm());
  FaceMatching matching = matcher.match();
  if (matcher.met_twice())
    refuse(place_of(pair), "meet twice",
           "at " + shown(*matcher.met_twice()) +
               " (allowed: faces of which one place, at most, lies in front of another: no steps "
               "or folds, and bodies side by side with a gap)");
  return matching;
}

}  // namespace airybench
