// Transformations of a mesh, applied in the order of the members below; those not given change
// nothing.
//
//   polygon  edges are the body, none a chord of a curve that it may look like or is known to be
//   refine   k times: each triangle into four by its edges' middles, each boundary edge into two.
//            V, E, T become V + E, 2E + 3T, 4T; shapes, roles and bodies are kept.
//   grade    the edges at the vertex v nearest to a point are halved until none is longer than
//            (the longest of them before) / ratio, by longest-edge bisection (bisection.hpp);
//            that length must be at least 64 roundings of the largest coordinate
//   slivers  in `count` triangles, every T/count-th of those that are fit for it, a vertex is put
//   at
//            p = m + t (c − m), m the middle of the longest edge L, c the vertex across, h its
//            height over L, t = L / (aspect · h): the new triangle on L has L / height = aspect.
//            Fit are triangles with t ≤ 1/2.
//   scale    x → s x
//   stretch  (x, y) → (s_x x, s_y y)
//   move     x → x + d. Coordinates are rounded to about 1e-16 |d|, so an edge of length h changes
//            by 1e-16 |d|/h of itself: the moved body is another one in that digit. All methods see
//            the same moved body.
//   keep_…_edges  boundary roles, in the order contact, displacement, force: the middle n edges of
//            a role keep it, counted along its chains (boundary_chains) one after another. The
//            others become force edges, those of the force boundary displacement edges; the name of
//            their group stays.
#pragma once

#include <optional>

#include "mesh/mesh.hpp"
#include "mesh/transform_error.hpp"

namespace airybench {

struct Grading {
  Eigen::Vector2d at_mm = {0, 0};
  double ratio = 1;  // ≥ 1
};

struct Slivers {
  double aspect = 10;  // longest edge / height, > 2
  int count = 1;       // ≥ 1
};

struct MeshTransform {
  bool polygon = false;
  int refine = 0;  // 0 to max_refinements
  std::optional<Grading> grade;
  std::optional<Slivers> slivers;
  double scale = 1;                            // > 0
  Eigen::Vector2d stretch = {1, 1};            // both > 0
  Eigen::Vector2d move_mm = {0, 0};            // finite
  std::optional<int> keep_contact_edges;       // ≥ 0
  std::optional<int> keep_displacement_edges;  // ≥ 1: something must hold the body
  std::optional<int> keep_force_edges;         // ≥ 0
};
inline constexpr int max_refinements = 6;
inline constexpr std::size_t max_triangles = 1'000'000;  // that `refine` makes

// Throws TransformError when a value is impossible on any mesh.
void check_values(const MeshTransform& transform);

// Takes and returns a valid mesh; the name stays. Throws TransformError when a value is impossible
// in itself or on this mesh, or makes a triangle flat to rounding.
Mesh transformed(Mesh mesh, const MeshTransform& transform);

}  // namespace airybench
