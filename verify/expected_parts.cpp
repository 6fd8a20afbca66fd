#include "verify/expected_parts.hpp"

#include <algorithm>
#include <cmath>

namespace airybench {
namespace {

using Corners = std::array<Eigen::Vector2d, 3>;

constexpr double power_of_chords = 2.5;

Corners corners_of(const Mesh& mesh, int t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
}
double area_of(const Corners& x) { return cross_area(x[0], x[1], x[2]) / 2; }
Eigen::Vector2d centroid_of(const Corners& x) { return (x[0] + x[1] + x[2]) / 3; }

std::array<Corners, 2> halves(const Corners& x) {
  std::array<double, 3> length{};
  for (std::size_t k = 0; k < 3; ++k) length[k] = (x[(k + 1) % 3] - x[k]).squaredNorm();
  const auto k = static_cast<std::size_t>(std::ranges::max_element(length) - length.begin());
  const Eigen::Vector2d &a = x[k], &b = x[(k + 1) % 3], &c = x[(k + 2) % 3];
  const Eigen::Vector2d middle = (a + b) / 2;
  return {Corners{a, middle, c}, Corners{middle, b, c}};
}

struct Ring {
  double squared = 0, powers = 0, distance = 0, area = 0;  // Σ e_T², A^(k+2), A |x_T − v|, A
  void add(double part, double A, int power, double to_vertex) {
    squared += part;
    powers += std::pow(A, power);
    distance += A * to_vertex;
    area += A;
  }
  double kappa() const { return squared / powers; }
  double mean_distance() const { return distance / area; }
};

std::vector<bool> inside_contact(const Mesh& mesh) {
  std::vector<bool> inside(mesh.vertices.size(), false);
  for (const bool of_contact : {true, false})
    for (const BoundaryEdge& edge : mesh.boundary)
      if ((edge.role == BoundaryRole::contact) == of_contact)
        for (const int v : edge.vertices) inside[v] = of_contact;
  return inside;
}

// κ of the triangles at a vertex, and s (0: smooth stress).
struct AtVertex {
  double kappa = 0, exponent = 0;
};
std::vector<AtVertex> look_at_vertices(const Mesh& mesh, const MeshEdges& edges,
                                       const std::vector<double>& parts, int power) {
  const double of_singular = 2 * power - 2 * 0.7;
  const double falls = of_singular * 2.5 / 4.6;  // κ falls as this power of r or faster: singular
  std::vector<Ring> at(mesh.vertices.size()), behind(mesh.vertices.size());
  std::vector<std::array<int, 2>> of_edge(static_cast<std::size_t>(edges.count()), {-1, -1});
  const int triangles = static_cast<int>(mesh.triangles.size());
  for (int t = 0; t < triangles; ++t)
    for (const int edge : edges.of_triangle[t]) of_edge[edge][of_edge[edge][0] >= 0] = t;
  const auto add = [&](Ring& ring, int t, int v) {
    const Corners x = corners_of(mesh, t);
    ring.add(std::max(0.0, parts[t]), area_of(x), power,
             (centroid_of(x) - mesh.vertices[v]).norm());
  };
  for (int t = 0; t < triangles; ++t)
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.triangles[t][(k + 2) % 3];
      add(at[v], t, v);
      const auto& [one, other] = of_edge[edges.of_triangle[t][k]];
      if (const int beyond = one == t ? other : one; beyond >= 0) add(behind[v], beyond, v);
    }
  const std::vector<bool> in_contact = inside_contact(mesh);
  std::vector<AtVertex> seen(mesh.vertices.size());
  for (std::size_t v = 0; v < seen.size(); ++v) {
    seen[v].kappa = at[v].kappa();
    if (in_contact[v] || behind[v].area == 0) continue;
    const double apart = behind[v].mean_distance() / at[v].mean_distance();
    if (seen[v].kappa > behind[v].kappa() * std::pow(apart, falls)) seen[v].exponent = of_singular;
  }
  return seen;
}

}  // namespace

ExpectedParts::ExpectedParts(const Mesh& mesh, const MeshEdges& edges,
                             const std::vector<double>& parts, int degree,
                             const std::vector<double>& of_chords)
    : mesh_(mesh), power_(degree + 2) {
  std::vector<double> others = parts;
  for (std::size_t t = 0; t < of_chords.size(); ++t) others[t] -= of_chords[t];
  const std::vector<AtVertex> seen = look_at_vertices(mesh, edges, others, power_);
  triangles_.reserve(parts.size());
  for (int t = 0; t < static_cast<int>(parts.size()); ++t) {
    const Corners x = corners_of(mesh, t);
    const int v = *std::ranges::max_element(mesh.triangles[t], {},
                                            [&](int corner) { return seen[corner].kappa; });
    const double chords = of_chords.empty() ? 0 : of_chords[t];
    triangles_.push_back({std::max(0.0, others[t]) / std::pow(area_of(x), power_),
                          chords / std::pow(area_of(x), power_of_chords), area_of(x),
                          seen[v].exponent, mesh.vertices[v],
                          (centroid_of(x) - mesh.vertices[v]).norm()});
  }
}

double ExpectedParts::of_smooth(const Triangle& triangle, double area) const {
  return triangle.kappa * std::pow(area, power_) +
         triangle.of_chords * std::pow(area, power_of_chords);
}

double ExpectedParts::of(const Triangle& triangle, const Corners& corners) const {
  const double area = area_of(corners), smooth = of_smooth(triangle, area);
  if (triangle.exponent == 0) return smooth;
  const double nearer = (centroid_of(corners) - triangle.vertex).norm() / triangle.distance_mm;
  return smooth *
         std::pow(std::max(nearer, std::sqrt(area / triangle.area_mm2)), -triangle.exponent);
}

double ExpectedParts::of(const TrianglePart& part) const {
  return of(triangles_[part.triangle], part.corners);
}

ExpectedParts::Finer ExpectedParts::cut_until(
    const std::function<bool(const Finer&)>& is_enough) const {
  struct Parts {  // equal parts of one triangle
    double part, count;
    int triangle;
    double area_mm2;
    Corners corners;  // of one part; if smooth, of the whole triangle
  };
  std::vector<Parts> heap;  // largest first
  Finer finer;
  for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
    const Corners x = corners_of(mesh_, t);
    heap.push_back({of(triangles_[t], x), 1, t, area_of(x), x});
    finer.squared += heap.back().part;
  }
  finer.triangles = static_cast<double>(heap.size());
  std::ranges::make_heap(heap, {}, &Parts::part);
  const auto push = [&](Parts parts) {
    finer.squared += parts.count * parts.part;
    heap.push_back(std::move(parts));
    std::ranges::push_heap(heap, {}, &Parts::part);
  };
  while (finer.largest = heap.front().part, finer.largest > 0 && !is_enough(finer)) {
    std::ranges::pop_heap(heap, {}, &Parts::part);
    const Parts cut = std::move(heap.back());
    heap.pop_back();
    finer.squared -= cut.count * cut.part;
    finer.triangles += cut.count;
    if (triangles_[cut.triangle].exponent == 0) {
      const double half = cut.area_mm2 / 2;
      push({of_smooth(triangles_[cut.triangle], half), 2 * cut.count, cut.triangle, half,
            cut.corners});
      continue;
    }
    for (const Corners& half : halves(cut.corners))
      push({of(triangles_[cut.triangle], half), 1, cut.triangle, area_of(half), half});
  }
  return finer;
}

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
