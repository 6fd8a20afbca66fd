#include "mesh/layers.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/complaint.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::mesh_layers_test {
namespace {

using testing::small_tooth;

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
      EXPECT_TRUE(layer == 0 || d >= layers.interfaces_mm[layer - 1]) << d << " in " << layer;
      EXPECT_TRUE(layer == 3 || d < layers.interfaces_mm[layer]) << d << " in " << layer;
    }
  }
}

TEST(MeshLayers, ACountMakesThemEquallyThickAndNoneKeepTheBodies) {
  const Mesh tooth = small_tooth(8, 4);
  EXPECT_EQ(layered(tooth, {{1, 0}, 4, {}}).triangle_body,
            layered(tooth, {{1, 0}, 1, {2.5, 5, 7.5}}).triangle_body);
  EXPECT_EQ(layered(tooth, {}).body_names, std::vector<std::string>{"body"});
}

TEST(MeshLayers, ImpossibleValuesAreNamed) {
  const std::vector<std::pair<Layers, std::string>> cases = {
      {{{0, 0}, 2, {}}, "normal: [0, 0] (allowed: a direction, not [0, 0])"},
      {{{1, 0}, -1, {}}, "count: -1 (allowed: a whole number from 0 to 1000)"},
      {{{1, 0}, 1, {3, 3}}, "interfaces_mm: 3 (allowed: finite numbers, ascending)"},
      {{{1, 0}, 1, {std::nan("")}}, "interfaces_mm: nan (allowed: finite numbers, ascending)"},
      {{{1, 0}, 1, {5, 20}},
       "interfaces_mm: 3 layers, but layer 3 has no triangle of the mesh small tooth"},
      {{{1, 0}, 100, {}}, "count: 100 layers, but layer 1 has no triangle of the mesh small tooth"},
  };
  for (const auto& [layers, complaint] : cases)
    EXPECT_EQ(testing::complaint_of<TransformError>([&] { layered(small_tooth(8, 4), layers); }),
              complaint);
}

}  // namespace
}  // namespace airybench::mesh_layers_test
