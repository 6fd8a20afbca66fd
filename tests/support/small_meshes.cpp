#include "tests/support/small_meshes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace airybench::testing {
namespace {

// The cells of a grid of columns × rows that are there, two triangles each. Their vertices are
// place(column, row, shift), with a shift other than zero for inner ones. Roles as for the
// generated meshes: displacement in the first column, contact behind the last, force elsewhere.
template <typename IsCell, typename Place>
Mesh mesh_of_cells(const char* name, int columns, int rows, IsCell is_cell, Place place) {
  Mesh mesh;
  mesh.name = name;
  mesh.body_names = {"body"};
  const auto is_there = [&](int i, int j) {
    return i >= 0 && i < columns && j >= 0 && j < rows && is_cell(i, j);
  };
  std::vector<int> number(static_cast<std::size_t>((columns + 1) * (rows + 1)), -1);
  const auto vertex = [&](int i, int j) -> int& { return number[i * (rows + 1) + j]; };
  for (int i = 0; i <= columns; ++i) {
    for (int j = 0; j <= rows; ++j) {
      const int cells =
          is_there(i - 1, j - 1) + is_there(i - 1, j) + is_there(i, j - 1) + is_there(i, j);
      if (cells == 0) continue;
      vertex(i, j) = static_cast<int>(mesh.vertices.size());
      mesh.vertices.push_back(place(i, j, cells == 4 ? 0.15 * std::sin(37.0 * vertex(i, j)) : 0));
    }
  }
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      if (!is_there(i, j)) continue;
      const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                d = vertex(i, j + 1);
      if ((i + j) % 2 == 0) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      }
      if (!is_there(i, j - 1)) mesh.boundary.push_back({{a, b}, BoundaryRole::force});
      if (!is_there(i, j + 1)) mesh.boundary.push_back({{c, d}, BoundaryRole::force});
    }
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = columns; i >= 0; --i) {
      if (is_there(i - 1, j) && !is_there(i, j))
        mesh.boundary.push_back({{vertex(i, j), vertex(i, j + 1)},
                                 i == columns ? BoundaryRole::contact : BoundaryRole::force});
      if (!is_there(i - 1, j) && is_there(i, j))
        mesh.boundary.push_back({{vertex(i, j + 1), vertex(i, j)},
                                 i == 0 ? BoundaryRole::displacement : BoundaryRole::force});
    }
  }
  mesh.triangle_body.assign(mesh.triangles.size(), 0);
  validate(mesh);
  return mesh;
}

double half_height(double x) { return 5 - 0.2 * x; }

}  // namespace

Mesh small_tooth(int nx, int ny) {
  const auto place = [&](int i, int j, double shift) {
    const double x = 10.0 * (i + shift) / nx;
    return Eigen::Vector2d(x, half_height(x) * (2.0 * (j - shift) / ny - 1));
  };
  const auto every_cell = [](int, int) { return true; };
  return mesh_of_cells("small tooth", nx, ny, every_cell, place);
}

Mesh small_block(int nx, int ny, double turn_degrees) {
  const auto place = [&](int i, int j, double shift) {
    return Eigen::Vector2d(10.0 * (i + shift) / nx, 10.0 * (j - shift) / ny);
  };
  const auto every_cell = [](int, int) { return true; };
  Mesh mesh = mesh_of_cells("small block", nx, ny, every_cell, place);
  for (BoundaryEdge& edge : mesh.boundary) {
    const bool is_top = mesh.vertices[edge.vertices[0]].y() == 10;
    if (edge.role == BoundaryRole::displacement) edge.group = boundary_group(mesh, "root");
    if (edge.role == BoundaryRole::force)
      edge.group = boundary_group(mesh, is_top ? "top" : "bottom");
  }
  const Eigen::Matrix2d turn =
      Eigen::Rotation2Dd(turn_degrees * std::numbers::pi / 180).toRotationMatrix();
  for (Eigen::Vector2d& x : mesh.vertices) x = turn * x;
  return mesh;
}

Mesh small_plate(int n) {
  const auto is_cell = [&](int i, int j) { return i < n || i >= 2 * n || j < n || j >= 2 * n; };
  const auto place = [&](int i, int j, double shift) {
    return Eigen::Vector2d(4 * (i + shift) / n, 4 * (j - shift) / n);
  };
  Mesh mesh = mesh_of_cells("small plate", 3 * n, 3 * n, is_cell, place);
  const auto is_inside = [&](int v) {
    return (mesh.vertices[v].array() > 0).all() && (mesh.vertices[v].array() < 12).all();
  };
  for (BoundaryEdge& edge : mesh.boundary)
    if (is_inside(edge.vertices[0])) edge.group = boundary_group(mesh, "hole");
  return mesh;
}

Mesh small_ring(int around, int across, double inner_mm, double outer_mm) {
  Mesh mesh;
  mesh.name = "small ring";
  mesh.body_names = {"body"};
  for (int i = 0; i < around; ++i)
    for (int j = 0; j <= across; ++j) {
      const double shift = j == 0 || j == across ? 0 : 0.15 * std::sin(37.0 * (i + 5 * j));
      const double at = 2 * std::numbers::pi * (i + shift) / around;
      mesh.vertices.emplace_back(inner_mm * std::pow(outer_mm / inner_mm, (j - shift) / across) *
                                 Eigen::Vector2d(std::cos(at), std::sin(at)));
    }
  const int rim = boundary_group(mesh, "rim"), hole = boundary_group(mesh, "hole");
  const auto vertex = [&](int i, int j) { return i % around * (across + 1) + j; };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const int a = vertex(i, j), b = vertex(i, j + 1), c = vertex(i + 1, j + 1),
                d = vertex(i + 1, j);
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
    mesh.boundary.push_back(
        {{vertex(i, across), vertex(i + 1, across)}, BoundaryRole::displacement, rim});
    mesh.boundary.push_back({{vertex(i + 1, 0), vertex(i, 0)}, BoundaryRole::force, hole});
  }
  mesh.triangle_body.assign(mesh.triangles.size(), 0);
  validate(mesh);
  return mesh;
}

Mesh quarter_ring(int around, int across, double inner_mm, double outer_mm) {
  Mesh mesh;
  mesh.name = "quarter ring";
  mesh.body_names = {"body"};
  const auto vertex = [&](int i, int j) { return i * (across + 1) + j; };
  for (int i = 0; i <= around; ++i)
    for (int j = 0; j <= across; ++j) {
      const double angle = std::numbers::pi / 2 * i / around;
      const double radius = inner_mm * std::pow(outer_mm / inner_mm, 1. * j / across);
      mesh.vertices.emplace_back(i == around ? 0 : radius * std::cos(angle),
                                 i == 0 ? 0 : radius * std::sin(angle));
    }
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const int a = vertex(i, j), b = vertex(i, j + 1), c = vertex(i + 1, j + 1),
                d = vertex(i + 1, j);
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  const auto add = [&](int a, int b, BoundaryRole role, const char* name) {
    mesh.boundary.push_back({{a, b}, role, boundary_group(mesh, name)});
  };
  for (int j = 0; j < across; ++j) {
    add(vertex(0, j), vertex(0, j + 1), BoundaryRole::displacement, "bottom");
    add(vertex(around, j + 1), vertex(around, j), BoundaryRole::displacement, "left");
  }
  for (int i = 0; i < around; ++i) {
    add(vertex(i + 1, 0), vertex(i, 0), BoundaryRole::force, "hole");
    add(vertex(i, across), vertex(i + 1, across), BoundaryRole::force, "rim");
  }
  mesh.triangle_body.assign(mesh.triangles.size(), 0);
  validate(mesh);
  return mesh;
}

Mesh with_role(Mesh mesh, BoundaryRole before, BoundaryRole after) {
  for (BoundaryEdge& edge : mesh.boundary)
    if (edge.role == before) edge.role = after;
  return mesh;
}

Mesh small_rack(int teeth, int nx, int ny) {
  const int block = 2, pitch = ny + 2;  // in cells: below and above every tooth's ny is a gap
  const auto is_cell = [&](int i, int j) {
    return i < block || (j % pitch > 0 && j % pitch <= ny);
  };
  const auto place = [&](int i, int j, double shift) {
    const double x = i < block ? 3.0 * (i - block) : 10.0 * (i - block) / nx;
    const double middle = 12.5 * (j / pitch) + 6.25;
    const double y =
        j % pitch == 0 ? middle - 6.25
                       : middle + half_height(std::max(x, 0.0)) * (2.0 * (j % pitch - 1) / ny - 1);
    return Eigen::Vector2d(x + shift, y - shift);
  };
  return mesh_of_cells("small rack", block + nx, teeth * pitch, is_cell, place);
}

}  // namespace airybench::testing
