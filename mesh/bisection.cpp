#include "mesh/bisection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace airybench {
namespace {

// A mesh that is being bisected, with the neighbours of its triangles.
class Bisection {
 public:
  explicit Bisection(Mesh mesh)
      : mesh_(std::move(mesh)),
        across_(mesh_.triangles.size()),
        origin_(mesh_.triangles.size()),
        cuts_(mesh_.triangles.size(), 0),
        min_mm_(shortest_divisible_edge(mesh_)) {
    std::iota(origin_.begin(), origin_.end(), 0);
    const MeshEdges edges = number_edges(mesh_);
    std::vector<int> first(static_cast<std::size_t>(edges.count()), none);
    for (int row = 0; row < static_cast<int>(mesh_.boundary.size()); ++row)
      first[edges.of_boundary[row]] = beyond(row);
    for (int t = 0; t < triangles(); ++t)
      for (int k = 0; k < 3; ++k) {
        int& other = first[edges.of_triangle[t][k]];
        across_[t][k] = other;
        if (other >= 0) across_[other][side_towards(other, mesh_.triangles[t][k])] = t;
        if (other == none) other = t;
      }
  }

  const Mesh& mesh() const { return mesh_; }
  Mesh take() { return std::move(mesh_); }
  std::int64_t visits() const { return visits_; }
  TrianglePart part(int t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return {origin_[t], cuts_[t], {mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]}};
  }
  int triangles() const { return static_cast<int>(mesh_.triangles.size()); }
  double longest_edge(int t) const { return std::sqrt(length_squared(t, longest_side(t))); }

  // Cuts curved sides of t until it and its parts fit them. Nothing lies across them, so nothing
  // else changes.
  void fit(int t) {
    for (int k = 0; k < 3; ++k) {
      if (across_[t][k] >= 0) continue;
      const BoundaryEdge& edge = mesh_.boundary[beyond(across_[t][k])];
      const Eigen::Vector2d& c = mesh_.vertices[mesh_.triangles[t][(k + 2) % 3]];
      if (edge.curve.is_straight() || fits(edge.curve, c) || !can_be_cut(edge, c)) continue;
      cut_edge(t, k);
      return;
    }
  }

  // Cuts t from the middle of its longest edge, and before it what must be cut so that the edge is
  // its neighbour's longest one too. The longest edges along the path grow, so it never returns to
  // one of its triangles.
  void cut(int t) {
    path_.assign(1, t);
    while (!path_.empty()) {
      ++visits_;
      const int here = path_.back(), k = longest_side(here), other = across_[here][k];
      if (other < 0) {
        cut_edge(here, k);
      } else {
        const int l = longest_side(other);
        if (across_[other][l] != here) {
          path_.push_back(other);
          continue;
        }
        cut_edge(here, k);
      }
      path_.pop_back();
    }
  }

 private:
  // Of a neighbour's number: no triangle, but the boundary edge −2 − number.
  static constexpr int none = -1;
  static int beyond(int row) { return -2 - row; }

  double length_squared(int t, int k) const {
    const auto& triangle = mesh_.triangles[t];
    return (mesh_.vertices[triangle[(k + 1) % 3]] - mesh_.vertices[triangle[k]]).squaredNorm();
  }
  int longest_side(int t) const {
    const auto rank = [&](int k) {
      const auto [low, high] = std::minmax(mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3]);
      return std::tuple(length_squared(t, k), low, high);
    };
    int longest = 0;
    auto highest = rank(0);
    for (const int k : {1, 2})
      if (const auto own = rank(k); own > highest) {
        longest = k;
        highest = own;
      }
    return longest;
  }
  // The side of t that ends at vertex v.
  int side_towards(int t, int v) const {
    int k = 0;
    while (mesh_.triangles[t][(k + 1) % 3] != v) ++k;
    return k;
  }

  // Cuts side k of t, and the triangle across it, the one of lower number first.
  void cut_edge(int t, int k) {
    const int a = mesh_.triangles[t][k], b = mesh_.triangles[t][(k + 1) % 3];
    const int middle = static_cast<int>(mesh_.vertices.size());
    const int other = across_[t][k];
    if (other < 0) {
      const int row = beyond(other), second_row = static_cast<int>(mesh_.boundary.size());
      BoundaryEdge& edge = mesh_.boundary[row];
      if (!can_be_cut(edge, mesh_.vertices[mesh_.triangles[t][(k + 2) % 3]])) edge.curve = {};
      mesh_.vertices.push_back(point_on(mesh_, edge, 0.5));
      mesh_.boundary.push_back(cut_at(edge, middle, 0.5));
      const int born = halve(t, k, middle);
      across_[t][0] = beyond(row);
      across_[born][0] = beyond(second_row);
      fit(t);
      fit(born);
      return;
    }
    mesh_.vertices.emplace_back((mesh_.vertices[a] + mesh_.vertices[b]) / 2);
    const int l = side_towards(other, a);
    const int lower = std::min(t, other), upper = std::max(t, other);
    const int of_lower = halve(lower, lower == t ? k : l, middle),
              of_upper = halve(upper, upper == t ? k : l, middle);
    // Walked the other way round by its neighbour, the edge's first half is its second.
    across_[lower][0] = of_upper;
    across_[of_upper][0] = lower;
    across_[upper][0] = of_lower;
    across_[of_lower][0] = upper;
    for (const int part : {lower, upper, of_lower, of_upper}) fit(part);
  }

  // Whether the middle of an edge's curve makes two triangles with the vertex across.
  bool can_be_cut(const BoundaryEdge& edge, const Eigen::Vector2d& c) const {
    constexpr double least = 0.1;  // of the halves on the chord
    if (edge.curve.is_straight()) return true;
    const Eigen::Vector2d &a = mesh_.vertices[edge.vertices[0]],
                          &b = mesh_.vertices[edge.vertices[1]];
    const Eigen::Vector2d m = edge.curve.at(0.5);
    const double half = cross_area(a, b, c) / 2;
    return cross_area(a, m, c) > least * half && cross_area(m, b, c) > least * half &&
           (b - a).norm() > min_mm_;
  }

  // abc with side k = ab becomes a m c, and m b c behind all others, whose number is returned. Side
  // 0 of each is its half of ab, and what is across it is left to set.
  int halve(int t, int k, int middle) {
    const auto corners = mesh_.triangles[t];
    const auto beside = across_[t];
    const int a = corners[k], b = corners[(k + 1) % 3], c = corners[(k + 2) % 3];
    const int born = triangles(), beyond_bc = beside[(k + 1) % 3], beyond_ca = beside[(k + 2) % 3];
    mesh_.triangles[t] = {a, middle, c};
    across_[t] = {none, born, beyond_ca};
    mesh_.triangles.push_back({middle, b, c});
    mesh_.triangle_body.push_back(mesh_.triangle_body[t]);
    cuts_.push_back(++cuts_[t]);
    origin_.push_back(origin_[t]);
    across_.push_back({none, beyond_bc, t});
    if (beyond_bc >= 0) across_[beyond_bc][side_towards(beyond_bc, b)] = born;
    return born;
  }

  Mesh mesh_;
  std::vector<std::array<int, 3>> across_;  // per triangle and side: the neighbour, or beyond(row)
  std::vector<int> origin_, cuts_;          // per triangle: of its TrianglePart
  double min_mm_;
  std::vector<int> path_;
  std::int64_t visits_ = 0;
};

}  // namespace

double shortest_divisible_edge(const Mesh& mesh) {
  double largest = 0;
  for (const Eigen::Vector2d& x : mesh.vertices)
    largest = std::max(largest, x.cwiseAbs().maxCoeff());
  return 64 * std::numeric_limits<double>::epsilon() * largest;
}

BisectedMesh bisected(const Mesh& mesh, const std::function<bool(const TrianglePart&)>& is_due) {
  const double min_mm = shortest_divisible_edge(mesh);
  Bisection bisection(mesh);
  BisectedMesh result;
  for (int t = 0; t < bisection.triangles(); ++t) {  // and those that are born on the way
    bool due = is_due(bisection.part(t));
    while (due && bisection.longest_edge(t) > min_mm) {
      bisection.cut(t);
      due = is_due(bisection.part(t));
    }
    result.too_small += due;
  }
  result.visits = bisection.visits();
  result.mesh = bisection.take();
  return result;
}

BisectedMesh bisected(const Mesh& mesh, const std::vector<int>& cuts) {
  return bisected(mesh, [&](const TrianglePart& part) { return part.cuts < cuts[part.triangle]; });
}

Mesh with_fitting_curves(Mesh mesh) {
  const auto is_curved = [](const BoundaryEdge& edge) { return !edge.curve.is_straight(); };
  if (std::ranges::none_of(mesh.boundary, is_curved)) return mesh;
  Bisection bisection(std::move(mesh));
  for (int t = 0; t < bisection.triangles(); ++t) bisection.fit(t);
  return bisection.take();
}

Mesh bisected_at_vertex(const Mesh& mesh, int v, double length_mm) {
  Bisection bisection(mesh);
  const auto too_long = [&](int t) {
    const auto& triangle = bisection.mesh().triangles[t];
    const auto& x = bisection.mesh().vertices;
    return std::ranges::count(triangle, v) > 0 && std::ranges::any_of(triangle, [&](int w) {
             return (x[w] - x[v]).squaredNorm() > length_mm * length_mm;
           });
  };
  std::vector<int> here;
  for (int t = 0; t < bisection.triangles(); ++t)
    if (too_long(t)) here.push_back(t);
  while (!here.empty()) {
    const int t = here.back();
    if (!too_long(t)) {
      here.pop_back();
      continue;
    }
    const int before = bisection.triangles();
    bisection.cut(t);
    for (int born = before; born < bisection.triangles(); ++born)
      if (too_long(born)) here.push_back(born);
  }
  return bisection.take();
}

}  // namespace airybench
