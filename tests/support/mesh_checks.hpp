// What meshes must keep and what is said of wrong ones.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "mesh/mesh.hpp"
#include "tests/support/complaint.hpp"

namespace airybench::testing {

inline std::string complaint(const Mesh& mesh) {
  return complaint_of<MeshError>([&] { validate(mesh); });
}

// One body of all triangles, held wherever there is no other one.
inline void hold_all_around(Mesh& mesh) {
  mesh.triangle_body.assign(mesh.triangles.size(), 0);
  std::set<std::array<int, 2>> sides;
  for (const auto& triangle : mesh.triangles)
    for (int k = 0; k < 3; ++k) sides.insert({triangle[k], triangle[(k + 1) % 3]});
  for (const auto& [a, b] : sides)
    if (!sides.contains({b, a})) mesh.boundary.push_back({{a, b}, BoundaryRole::displacement});
}

inline std::map<std::string, double> area_of_bodies(const Mesh& mesh) {
  std::map<std::string, double> area;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    area[mesh.body_names[mesh.triangle_body[t]]] +=
        cross_area(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]) / 2;
  }
  return area;
}

inline std::map<std::string, double> length_of_boundaries(const Mesh& mesh) {
  std::map<std::string, double> length;
  for (const BoundaryEdge& edge : mesh.boundary)
    length[boundary_label(mesh, edge)] +=
        (mesh.vertices[edge.vertices[1]] - mesh.vertices[edge.vertices[0]]).norm();
  return length;
}

// The largest sine between displacement edges that follow one another, unless it is a corner's.
inline double largest_bend(const Mesh& mesh) {
  double largest = 0;
  for (const BoundaryEdge& edge : mesh.boundary)
    for (const BoundaryEdge& next : mesh.boundary) {
      if (edge.role != BoundaryRole::displacement || next.role != BoundaryRole::displacement ||
          edge.vertices[1] != next.vertices[0])
        continue;
      const auto along = [&](const BoundaryEdge& of) -> Eigen::Vector2d {
        return (mesh.vertices[of.vertices[1]] - mesh.vertices[of.vertices[0]]).normalized();
      };
      const Eigen::Vector2d a = along(edge), b = along(next);
      if (const double sine = std::abs(a.x() * b.y() - a.y() * b.x()); sine < 0.3)
        largest = std::max(largest, sine);
    }
  return largest;
}

// As it was before: the same bodies with the same roles and groups on their boundary.
inline void expect_same_body(const Mesh& fine, const Mesh& coarse) {
  EXPECT_NO_THROW(validate(fine));
  EXPECT_EQ(fine.name, coarse.name);
  EXPECT_EQ(fine.body_names, coarse.body_names);
  EXPECT_EQ(hole_count(fine), hole_count(coarse));
  const auto expect_same = [](const auto& of_fine, const auto& of_coarse) {
    ASSERT_EQ(of_fine.size(), of_coarse.size());
    for (const auto& [name, value] : of_coarse)
      EXPECT_NEAR(of_fine.at(name), value, 1e-12 * value) << name;
  };
  expect_same(area_of_bodies(fine), area_of_bodies(coarse));
  expect_same(length_of_boundaries(fine), length_of_boundaries(coarse));
}

}  // namespace airybench::testing
