#include "tests/support/small_meshes.hpp"

#include <cmath>

namespace airybench::testing {

Mesh small_tooth(int nx, int ny) {
  Mesh mesh;
  mesh.name = "small tooth";
  mesh.body_names = {"body"};
  const auto vertex = [&](int i, int j) { return i * (ny + 1) + j; };
  for (int i = 0; i <= nx; ++i) {
    for (int j = 0; j <= ny; ++j) {
      const bool inner = i > 0 && i < nx && j > 0 && j < ny;
      const double shift = inner ? 0.15 * std::sin(37.0 * vertex(i, j)) : 0;
      const double x = 10.0 * (i + shift) / nx;
      const double half_height = 5 - 0.2 * x;
      mesh.vertices.emplace_back(x, half_height * (2.0 * (j - shift) / ny - 1));
    }
  }
  for (int i = 0; i < nx; ++i) {
    for (int j = 0; j < ny; ++j) {
      const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                d = vertex(i, j + 1);
      if ((i + j) % 2 == 0) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      }
    }
  }
  mesh.triangle_body.assign(mesh.triangles.size(), 0);
  for (int i = 0; i < nx; ++i) {
    mesh.boundary.push_back({{vertex(i, 0), vertex(i + 1, 0)}, BoundaryRole::force});
    mesh.boundary.push_back({{vertex(i + 1, ny), vertex(i, ny)}, BoundaryRole::force});
  }
  for (int j = 0; j < ny; ++j) {
    mesh.boundary.push_back({{vertex(nx, j), vertex(nx, j + 1)}, BoundaryRole::contact});
    mesh.boundary.push_back({{vertex(0, j + 1), vertex(0, j)}, BoundaryRole::displacement});
  }
  validate(mesh);
  return mesh;
}

}  // namespace airybench::testing
