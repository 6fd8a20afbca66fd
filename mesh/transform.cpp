#include "mesh/transform.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "mesh/bisection.hpp"
#include "mesh/refinement.hpp"

namespace airybench {
namespace {

bool is_positive(double value) { return value > 0 && std::isfinite(value); }

// A transformation that has made a mesh invalid is refused by its key and value.
void check_after(const Mesh& mesh, const std::string& key, const auto& value) {
  try {
    validate(mesh);
  } catch (const MeshError& error) {
    refuse(key, value, std::string("cannot be: ") + error.what());
  }
}

int nearest_vertex(const Mesh& mesh, const Eigen::Vector2d& x) {
  const auto nearest = std::ranges::min_element(
      mesh.vertices, {}, [&](const Eigen::Vector2d& v) { return (v - x).squaredNorm(); });
  return static_cast<int>(nearest - mesh.vertices.begin());
}

double longest_edge_at(const Mesh& mesh, int v) {
  double longest = 0;
  for (const auto& triangle : mesh.triangles)
    if (std::ranges::count(triangle, v) > 0)
      for (const int w : triangle)
        longest = std::max(longest, (mesh.vertices[w] - mesh.vertices[v]).norm());
  return longest;
}

// Bisection ends only as long as a middle is another point than the ends.
void check_can_be_told_apart(const Mesh& mesh, double longest_mm, double ratio) {
  const double most = longest_mm / shortest_divisible_edge(mesh);
  if (!(ratio <= most)) {
    std::ostringstream allowed;
    allowed << "(allowed: up to " << most << ", where the points of the mesh " << mesh.name
            << " can still be told apart)";
    refuse("grade: ratio", ratio, allowed.str());
  }
}

void check_triangles(const Mesh& mesh, int refinements) {
  const std::size_t fine = mesh.triangles.size() << (2 * refinements);
  if (fine > max_triangles)
    refuse("refine", refinements,
           "(the mesh " + mesh.name + " would have " + std::to_string(fine) +
               " triangles; allowed: up to " + std::to_string(max_triangles) + ")");
}

// Where the sliver's vertex goes in a triangle.
struct SliverPlace {
  int side;  // the longest one
  double t;  // of the way from its middle to the vertex across
  Eigen::Vector2d point;
};

SliverPlace sliver_place(const Mesh& mesh, int triangle, double aspect) {
  const auto corner = [&](int k) { return mesh.vertices[mesh.triangles[triangle][k % 3]]; };
  const int side = std::max({0, 1, 2}, [&](int i, int j) {
    return (corner(i + 1) - corner(i)).squaredNorm() < (corner(j + 1) - corner(j)).squaredNorm();
  });
  const Eigen::Vector2d a = corner(side), b = corner(side + 1), c = corner(side + 2);
  const double height = cross_area(a, b, c) / (b - a).norm();
  const double t = (b - a).norm() / (aspect * height);
  return {side, t, (a + b) / 2 + t * (c - (a + b) / 2)};
}

void add_slivers(Mesh& mesh, const Slivers& slivers) {
  std::vector<int> fit;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    if (sliver_place(mesh, t, slivers.aspect).t <= 0.5) fit.push_back(t);
  const auto available = static_cast<std::int64_t>(fit.size());
  if (slivers.count > available)
    refuse("slivers: count", slivers.count,
           "(allowed: 1 to " + std::to_string(available) +
               ", the triangles that such a sliver fits into)");
  for (std::int64_t k = 0; k < slivers.count; ++k) {
    const int triangle = fit[(2 * k + 1) * available / (2 * slivers.count)];
    const SliverPlace place = sliver_place(mesh, triangle, slivers.aspect);
    split_at_point(mesh, triangle, place.side, place.point);
  }
}

// Gives all but the middle `kept` edges of a role another one.
void keep_middle(Mesh& mesh, BoundaryRole role, std::optional<int> kept, BoundaryRole other) {
  if (!kept) return;
  std::vector<int> rows;
  for (const auto& chain : boundary_chains(mesh, role))
    rows.insert(rows.end(), chain.begin(), chain.end());
  const int count = static_cast<int>(rows.size());
  const std::string name(boundary_role_names[static_cast<std::size_t>(role)]);
  if (*kept > count)
    refuse("keep_" + name + "_edges", *kept,
           "(the mesh " + mesh.name + " has " + std::to_string(count) + ")");
  const int first = (count - *kept) / 2;
  for (int i = 0; i < count; ++i)
    if (i < first || i >= first + *kept) mesh.boundary[rows[i]].role = other;
}

}  // namespace

void check_values(const MeshTransform& transform) {
  if (transform.refine < 0 || transform.refine > max_refinements)
    refuse("refine", transform.refine,
           "(allowed: a whole number from 0 to " + std::to_string(max_refinements) + ")");
  if (transform.grade) {
    if (!transform.grade->at_mm.allFinite())
      refuse("grade: at_mm", shown(transform.grade->at_mm), "(allowed: finite numbers)");
    if (!(transform.grade->ratio >= 1) || !std::isfinite(transform.grade->ratio))
      refuse("grade: ratio", transform.grade->ratio, "(allowed: >= 1)");
  }
  if (transform.slivers) {
    if (!(transform.slivers->aspect > 2) || !std::isfinite(transform.slivers->aspect))
      refuse("slivers: aspect", transform.slivers->aspect, "(allowed: > 2)");
    if (transform.slivers->count < 1)
      refuse("slivers: count", transform.slivers->count, "(allowed: >= 1)");
  }
  if (!is_positive(transform.scale)) refuse("scale", transform.scale, "(allowed: > 0)");
  if (!is_positive(transform.stretch.x()) || !is_positive(transform.stretch.y()))
    refuse("stretch", shown(transform.stretch), "(allowed: two numbers > 0)");
  if (!transform.move_mm.allFinite())
    refuse("move_mm", shown(transform.move_mm), "(allowed: finite numbers)");
  const auto check_kept = [](const char* key, std::optional<int> kept, int least) {
    if (kept && *kept < least)
      refuse(key, *kept, "(allowed: a whole number >= " + std::to_string(least) + ")");
  };
  check_kept("keep_contact_edges", transform.keep_contact_edges, 0);
  check_kept("keep_displacement_edges", transform.keep_displacement_edges, 1);
  check_kept("keep_force_edges", transform.keep_force_edges, 0);
}

Mesh transformed(Mesh mesh, const MeshTransform& transform) {
  check_values(transform);
  if (transform.polygon) {
    mesh.is_polygon = true;
    for (BoundaryEdge& edge : mesh.boundary) edge.curve = {};
  }
  if (transform.refine > 0) check_triangles(mesh, transform.refine);
  for (int k = 0; k < transform.refine; ++k) mesh = uniformly_refined(mesh);
  if (transform.grade && transform.grade->ratio > 1) {
    const int v = nearest_vertex(mesh, transform.grade->at_mm);
    const double longest_mm = longest_edge_at(mesh, v);
    check_can_be_told_apart(mesh, longest_mm, transform.grade->ratio);
    mesh = bisected_at_vertex(mesh, v, longest_mm / transform.grade->ratio);
    check_after(mesh, "grade: ratio", transform.grade->ratio);
  }
  if (transform.slivers) {
    add_slivers(mesh, *transform.slivers);
    check_after(mesh, "slivers: aspect", transform.slivers->aspect);
  }
  const auto move_all = [&mesh](const auto& moved) {
    for (Eigen::Vector2d& x : mesh.vertices) x = moved(x);
    for (BoundaryEdge& edge : mesh.boundary)
      for (Eigen::Vector2d& x : edge.curve.points_mm) x = moved(x);
  };
  if (transform.scale != 1) {
    move_all([&](const Eigen::Vector2d& x) -> Eigen::Vector2d { return transform.scale * x; });
    check_after(mesh, "scale", transform.scale);
  }
  if (transform.stretch != Eigen::Vector2d(1, 1)) {
    move_all([&](const Eigen::Vector2d& x) -> Eigen::Vector2d {
      return x.cwiseProduct(transform.stretch);
    });
    check_after(mesh, "stretch", shown(transform.stretch));
  }
  if (!transform.move_mm.isZero(0)) {
    move_all([&](const Eigen::Vector2d& x) -> Eigen::Vector2d { return x + transform.move_mm; });
    check_after(mesh, "move_mm", shown(transform.move_mm));
  }
  using enum BoundaryRole;
  keep_middle(mesh, contact, transform.keep_contact_edges, force);
  keep_middle(mesh, displacement, transform.keep_displacement_edges, force);
  keep_middle(mesh, force, transform.keep_force_edges, displacement);
  if (transform.keep_contact_edges == 0) check_after(mesh, "keep_contact_edges", 0);
  return mesh;
}

}  // namespace airybench
