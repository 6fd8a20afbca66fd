#include "mesh/layers.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/small_meshes.hpp"

namespace airybench::mesh_layers_test {
namespace {

using testing::small_tooth;

std::string complaint(const Layers& layers) {
  try {
    layered(small_tooth(8, 4), layers);
  } catch (const TransformError& error) {
    return error.what();
  }
  return "none";
}

TEST(MeshLayers, ATriangleBelongsToTheLayerOfItsCentroid) {
  for (const Eigen::Vector2d& normal :
       {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, -2), Eigen::Vector2d(3, 4)}) {
    Layers layers;
    layers.normal = normal;
    layers.interfaces_mm = {-1.5, 0.25, 3};
    if (normal.y() == 0) layers.interfaces_mm = {2.5, 5, 7.5};
    const Mesh mesh = layered(small_tooth(8, 4), layers);
    EXPECT_NO_THROW(validate(mesh));
    EXPECT_EQ(mesh.body_names,
              (std::vector<std::string>{"layer 1", "layer 2", "layer 3", "layer 4"}));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      const double d =
          normal.normalized().dot(mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3;
      const int layer = mesh.triangle_body[t];
      if (layer > 0) {
        EXPECT_GE(d, layers.interfaces_mm[layer - 1]);
      }
      if (layer < 3) {
        EXPECT_LT(d, layers.interfaces_mm[layer]);
      }
    }
  }
}

TEST(MeshLayers, ACountMakesThemEquallyThick) {
  Layers by_count, by_interfaces;
  by_count.count = 4;
  by_interfaces.interfaces_mm = {2.5, 5, 7.5};
  EXPECT_EQ(layered(small_tooth(8, 4), by_count).triangle_body,
            layered(small_tooth(8, 4), by_interfaces).triangle_body);
}

TEST(MeshLayers, NoneKeepTheBodies) {
  EXPECT_EQ(layered(small_tooth(8, 4), {}).body_names, std::vector<std::string>{"body"});
}

TEST(MeshLayers, ImpossibleValuesAreNamed) {
  EXPECT_EQ(complaint({{0, 0}, 2, {}}), "normal: [0, 0] (allowed: a direction, not [0, 0])");
  EXPECT_EQ(complaint({{1, 0}, -1, {}}), "count: -1 (allowed: a whole number from 0 to 1000)");
  EXPECT_EQ(complaint({{1, 0}, 1, {3, 3}}),
            "interfaces_mm: 3 (allowed: finite numbers, ascending)");
  EXPECT_EQ(complaint({{1, 0}, 1, {std::nan("")}}),
            "interfaces_mm: nan (allowed: finite numbers, ascending)");
  EXPECT_EQ(complaint({{1, 0}, 1, {5, 20}}),
            "interfaces_mm: 3 layers, but layer 3 has no triangle of the mesh small tooth");
  EXPECT_EQ(complaint({{1, 0}, 100, {}}),
            "count: 100 layers, but layer 1 has no triangle of the mesh small tooth");
}

}  // namespace
}  // namespace airybench::mesh_layers_test
