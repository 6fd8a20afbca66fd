// Bodies that are added to a mesh, which then has several pieces.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace airybench::testing {

inline void add_edge(Mesh& mesh, int a, int b, const std::string& label) {
  const BoundaryLabel parsed = *parse_boundary_label(label);
  mesh.boundary.push_back({{a, b}, parsed.role, boundary_group(mesh, parsed.name)});
}

// Of the triangles that have none yet.
inline void name_body(Mesh& mesh, const std::string& body) {
  mesh.triangle_body.resize(mesh.triangles.size(), static_cast<int>(mesh.body_names.size()));
  mesh.body_names.push_back(body);
}

// Labels of the sides below, right, above and left.
using Sides = std::array<std::string, 4>;

// A block of nx × ny cells, its inner vertices moved a little.
inline void add_block(Mesh& mesh, const std::string& body, const Eigen::Vector2d& low,
                      const Eigen::Vector2d& high, int nx, int ny, const Sides& sides) {
  const int first = static_cast<int>(mesh.vertices.size());
  const auto vertex = [&](int i, int j) { return first + i * (ny + 1) + j; };
  for (int i = 0; i <= nx; ++i)
    for (int j = 0; j <= ny; ++j) {
      const bool inside = i > 0 && j > 0 && i < nx && j < ny;
      const Eigen::Vector2d cell((high.x() - low.x()) / nx, (high.y() - low.y()) / ny);
      const Eigen::Vector2d moved =
          inside ? Eigen::Vector2d(0.2 * std::sin(3. * i + j), 0.2 * std::cos(i + 2. * j))
                 : Eigen::Vector2d(0, 0);
      mesh.vertices.push_back(low + cell.cwiseProduct(Eigen::Vector2d(i, j) + moved));
    }
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j) {
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  for (int i = 0; i < nx; ++i) {
    add_edge(mesh, vertex(i, 0), vertex(i + 1, 0), sides[0]);
    add_edge(mesh, vertex(i + 1, ny), vertex(i, ny), sides[2]);
  }
  for (int j = 0; j < ny; ++j) {
    add_edge(mesh, vertex(nx, j), vertex(nx, j + 1), sides[1]);
    add_edge(mesh, vertex(0, j + 1), vertex(0, j), sides[3]);
  }
  name_body(mesh, body);
}

// Both ends of a sector of a ring: where they are, and their labels.
struct SectorEnds {
  std::array<double, 2> angles;
  std::array<std::string, 2> labels;
};
// The sector of a ring between these radii (in order) as `around` columns of cells.
inline void add_ring_sector(Mesh& mesh, const std::string& body,
                            const std::vector<double>& radii_mm, int around,
                            const std::string& inside, const std::string& outside,
                            const SectorEnds& ends) {
  const int first = static_cast<int>(mesh.vertices.size()),
            across = static_cast<int>(radii_mm.size()) - 1;
  const auto vertex = [&](int i, int j) { return first + i * (across + 1) + j; };
  const auto exact = [](double component) { return std::abs(component) < 1e-15 ? 0 : component; };
  for (int i = 0; i <= around; ++i) {
    const double angle = std::lerp(ends.angles[0], ends.angles[1], double(i) / around);
    for (const double r : radii_mm)
      mesh.vertices.emplace_back(r * exact(std::cos(angle)), r * exact(std::sin(angle)));
  }
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      mesh.triangles.push_back({vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1)});
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i + 1, j)});
    }
    add_edge(mesh, vertex(i + 1, 0), vertex(i, 0), inside);
    add_edge(mesh, vertex(i, across), vertex(i + 1, across), outside);
  }
  for (int j = 0; j < across; ++j) {
    add_edge(mesh, vertex(0, j), vertex(0, j + 1), ends.labels[0]);
    add_edge(mesh, vertex(around, j + 1), vertex(around, j), ends.labels[1]);
  }
  name_body(mesh, body);
}

}  // namespace airybench::testing
