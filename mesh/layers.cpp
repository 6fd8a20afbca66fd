#include "mesh/layers.hpp"

#include <algorithm>
#include <cmath>

namespace airybench {
namespace {

std::vector<double> interfaces_of(const Mesh& mesh, const Layers& layers,
                                  const Eigen::Vector2d& n) {
  if (!layers.interfaces_mm.empty()) return layers.interfaces_mm;
  const auto [low, high] =
      std::ranges::minmax(mesh.vertices, {}, [&](const Eigen::Vector2d& x) { return n.dot(x); });
  std::vector<double> interfaces;
  for (int k = 1; k < layers.count; ++k)
    interfaces.push_back(n.dot(low) + (n.dot(high) - n.dot(low)) * k / layers.count);
  return interfaces;
}

}  // namespace

void check_values(const Layers& layers) {
  if (!layers.normal.allFinite() || layers.normal.isZero(0))
    refuse("normal", shown(layers.normal), "(allowed: a direction, not [0, 0])");
  if (layers.count < 0 || layers.count > max_layers)
    refuse("count", layers.count,
           "(allowed: a whole number from 0 to " + std::to_string(max_layers) + ")");
  if (layers.interfaces_mm.size() >= max_layers)
    refuse("interfaces_mm", layers.interfaces_mm.size(),
           "interfaces (allowed: fewer than " + std::to_string(max_layers) + ")");
  for (std::size_t k = 0; k < layers.interfaces_mm.size(); ++k)
    if (!std::isfinite(layers.interfaces_mm[k]) ||
        (k > 0 && !(layers.interfaces_mm[k] > layers.interfaces_mm[k - 1])))
      refuse("interfaces_mm", layers.interfaces_mm[k], "(allowed: finite numbers, ascending)");
}

Mesh layered(Mesh mesh, const Layers& layers) {
  check_values(layers);
  if (layers.none()) return mesh;
  const Eigen::Vector2d n = layers.normal.stableNormalized();
  const std::vector<double> interfaces = interfaces_of(mesh, layers, n);
  std::vector<int> triangles(interfaces.size() + 1, 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const double d = n.dot(mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3;
    const auto layer = std::ranges::upper_bound(interfaces, d) - interfaces.begin();
    mesh.triangle_body[t] = static_cast<int>(layer);
    ++triangles[static_cast<std::size_t>(layer)];
  }
  mesh.body_names.clear();
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    mesh.body_names.push_back("layer " + std::to_string(k + 1));
    if (triangles[k] == 0)
      refuse(layers.interfaces_mm.empty() ? "count" : "interfaces_mm", triangles.size(),
             "layers, but " + mesh.body_names.back() + " has no triangle of the mesh " + mesh.name);
  }
  return mesh;
}

}  // namespace airybench
