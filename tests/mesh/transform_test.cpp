#include "mesh/transform.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/layers.hpp"
#include "mesh/quality.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/places.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::mesh_transform_test {
namespace {

using testing::catalogue_mesh, testing::expect_same_body, testing::length_of_boundaries,
    testing::small_tooth;

// Longest edge over the height there.
double aspect(const Mesh& mesh, const std::array<int, 3>& triangle) {
  double longest = 0;
  for (int k = 0; k < 3; ++k)
    longest = std::max(longest,
                       (mesh.vertices[triangle[(k + 1) % 3]] - mesh.vertices[triangle[k]]).norm());
  const auto& [a, b, c] = triangle;
  return longest * longest / cross_area(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
}

double smallest_angle(const Mesh& mesh) { return mesh_quality(mesh).smallest_angle_deg; }

double longest_edge_at(const Mesh& mesh, const Eigen::Vector2d& x) {
  const auto nearest = std::ranges::min_element(
      mesh.vertices, {}, [&](const Eigen::Vector2d& v) { return (v - x).squaredNorm(); });
  const int v = static_cast<int>(nearest - mesh.vertices.begin());
  double longest = 0;
  for (const auto& triangle : mesh.triangles)
    if (std::ranges::count(triangle, v) > 0)
      for (const int w : triangle)
        longest = std::max(longest, (mesh.vertices[w] - *nearest).norm());
  return longest;
}

Mesh two_bodies() {
  Mesh mesh = small_tooth(5, 4);
  mesh.body_names = {"root", "tip"};
  for (std::size_t t = 20; t < mesh.triangles.size(); ++t) mesh.triangle_body[t] = 1;
  return mesh;
}

TEST(MeshTransform, RefinementCountsByEulerAndKeepsShapes) {
  for (const Mesh& coarse : {two_bodies(), catalogue_mesh("Mesh4")}) {
    const std::size_t V = coarse.vertices.size(), T = coarse.triangles.size(), E = V + T - 1;
    MeshTransform transform;
    transform.refine = 1;
    const Mesh once = transformed(coarse, transform);
    EXPECT_EQ(once.vertices.size(), V + E);
    EXPECT_EQ(once.triangles.size(), 4 * T);
    EXPECT_EQ(number_edges(once).vertices.size(), 2 * E + 3 * T);
    EXPECT_EQ(once.boundary.size(), 2 * coarse.boundary.size());
    expect_same_body(once, coarse);
    EXPECT_NEAR(smallest_angle(once), smallest_angle(coarse), 1e-9);
    transform.refine = 2;
    const Mesh twice = transformed(coarse, transform);
    EXPECT_EQ(twice.triangles.size(), 16 * T);
    EXPECT_EQ(mesh_sizes(twice).n_c, 4 * mesh_sizes(coarse).n_c);
    expect_same_body(twice, coarse);
  }
}

TEST(MeshTransform, AHoleStays) {
  for (const Mesh& coarse : {testing::small_plate(1), testing::small_ring(12, 3, 2, 6)}) {
    MeshTransform transform;
    transform.refine = 1;
    transform.grade = {{4, 4}, 50};
    transform.slivers = Slivers{30, 5};
    const Mesh fine = transformed(coarse, transform);
    EXPECT_EQ(hole_count(fine), 1);
    expect_same_body(fine, coarse);
    EXPECT_EQ(mesh_sizes(fine).n_phi,
              3 * static_cast<int>(fine.vertices.size()) + number_edges(fine).count());
    transform.stretch = {3, 0.2};
    transform.keep_force_edges = 2;
    EXPECT_EQ(mesh_sizes(transformed(coarse, transform)).force_edges, 2);
  }
}

TEST(MeshTransform, GradingReachesItsRatioAndKeepsAngles) {
  for (const Eigen::Vector2d& at : {Eigen::Vector2d(10, 0), Eigen::Vector2d(4, 1)})
    for (const double ratio : {3., 1e4, 1e9}) {
      const Mesh coarse = two_bodies();
      MeshTransform transform;
      transform.grade = {at, ratio};
      const Mesh graded = transformed(coarse, transform);
      expect_same_body(graded, coarse);
      const Eigen::Vector2d v = *std::ranges::min_element(
          coarse.vertices, {}, [&](const Eigen::Vector2d& x) { return (x - at).squaredNorm(); });
      const double reached = longest_edge_at(coarse, v) / longest_edge_at(graded, v);
      EXPECT_GE(reached, ratio);
      EXPECT_LE(reached, 8 * ratio);
      EXPECT_GE(smallest_angle(graded), smallest_angle(coarse) / 2);
      // A few triangles for every halving.
      EXPECT_LE(graded.triangles.size(), coarse.triangles.size() + 60 * (1 + std::log2(ratio)));
    }
}

TEST(MeshTransform, SliversHaveTheirAspectRatio) {
  for (const double wanted : {10., 1e3, 1e5}) {
    const Mesh coarse = catalogue_mesh("Mesh0");
    MeshTransform transform;
    transform.slivers = {wanted, 5};
    const Mesh mesh = transformed(coarse, transform);
    expect_same_body(mesh, coarse);
    EXPECT_EQ(mesh.vertices.size(), coarse.vertices.size() + 5);
    EXPECT_EQ(mesh.triangles.size(), coarse.triangles.size() + 10);
    int slivers = 0;
    for (const auto& triangle : mesh.triangles)
      slivers += std::abs(aspect(mesh, triangle) / wanted - 1) < 1e-9;
    EXPECT_EQ(slivers, 5) << wanted;
  }
}

TEST(MeshTransform, GeometryIsMovedInOrder) {
  const Mesh before = small_tooth(4, 4);
  MeshTransform transform;
  transform.scale = 2;
  transform.stretch = {3, 0.5};
  transform.move_mm = {100, -7};
  const Mesh after = transformed(before, transform);
  for (std::size_t v = 0; v < before.vertices.size(); ++v) {
    const Eigen::Vector2d& x = before.vertices[v];
    EXPECT_EQ(after.vertices[v], Eigen::Vector2d(6 * x.x() + 100, x.y() - 7));
  }
  EXPECT_NEAR(extent_of(after).area_mm2, 6 * extent_of(before).area_mm2, 1e-10);
}

TEST(MeshTransform, FarAwayTheShapeIsRoundedNoMoreThanCoordinatesAre) {
  const Mesh before = catalogue_mesh("Mesh3");
  for (const double lengths : {1e3, 1e6}) {
    MeshTransform transform;
    transform.move_mm = {10 * lengths, 5 * lengths};
    const Mesh after = transformed(before, transform);
    for (std::size_t v = 0; v < before.vertices.size(); ++v)
      EXPECT_LE((after.vertices[v] - transform.move_mm - before.vertices[v]).norm(),
                2.3e-16 * transform.move_mm.norm());
  }
}

struct Kept {
  std::optional<int> contact, displacement, force;  // asked for
  int contact_edges, displacement_edges, force_edges;
};

TEST(MeshTransform, TheMiddleEdgesKeepTheirRole) {
  for (const Kept& kept :
       {Kept{{}, {}, {}, 5, 5, 8}, Kept{1, {}, {}, 1, 5, 12}, Kept{{}, 3, {}, 5, 3, 10},
        Kept{{}, {}, 0, 5, 13, 0}, Kept{0, {}, 0, 0, 18, 0}}) {
    MeshTransform transform;
    transform.keep_contact_edges = kept.contact;
    transform.keep_displacement_edges = kept.displacement;
    transform.keep_force_edges = kept.force;
    const Mesh mesh = transformed(small_tooth(4, 5), transform);
    EXPECT_NO_THROW(validate(mesh));
    const MeshSizes sizes = mesh_sizes(mesh);
    EXPECT_EQ(sizes.contact_edges, kept.contact_edges);
    EXPECT_EQ(sizes.displacement_edges, kept.displacement_edges) << kept.contact_edges;
    EXPECT_EQ(sizes.force_edges, kept.force_edges) << kept.contact_edges;
    for (const BoundaryEdge& edge : mesh.boundary)
      if (kept.contact == 1 && edge.role == BoundaryRole::contact) {
        EXPECT_NEAR((mesh.vertices[edge.vertices[0]] + mesh.vertices[edge.vertices[1]]).y(), 0,
                    1e-12);
      }
  }
  MeshTransform transform;
  transform.keep_contact_edges = 2;  // of a rack, face by face
  EXPECT_EQ(mesh_sizes(transformed(catalogue_mesh("Mesh4"), transform)).contact_edges, 2);
}

TEST(MeshTransform, NamedBoundaryGroupsAreKept) {
  Mesh tooth = testing::small_tooth(4, 4);
  for (BoundaryEdge& edge : tooth.boundary) {
    if (edge.role == BoundaryRole::contact) edge.group = boundary_group(tooth, "tip");
    if (edge.role == BoundaryRole::force && tooth.vertices[edge.vertices[0]].y() > 0)
      edge.group = boundary_group(tooth, "upper flank");
  }
  EXPECT_EQ(length_of_boundaries(tooth).size(), 4U);
  MeshTransform transform;
  transform.refine = 1;
  transform.grade = {{10, 3}, 50};
  transform.slivers = {10, 2};
  expect_same_body(transformed(tooth, transform), tooth);

  transform = {};
  transform.keep_contact_edges = 2;
  const auto kept = length_of_boundaries(transformed(tooth, transform));
  EXPECT_EQ(kept.at("contact:tip"), kept.at("force:tip"));  // two of four edges each
}

TEST(MeshTransform, ImpossibleValuesAreNamed) {
  using V2 = Eigen::Vector2d;
  using Change = void (*)(MeshTransform&);
  for (const auto& [change, named] : std::vector<std::pair<Change, std::string>>{
           {[](MeshTransform& t) { t.refine = 7; }, "refine: 7"},
           {[](MeshTransform& t) { t.refine = -1; }, "refine: -1"},
           {[](MeshTransform& t) {
              t.grade = Grading{V2(10, 0), 0.5};
            },
            "grade: ratio: 0.5"},
           {[](MeshTransform& t) {
              t.slivers = Slivers{2, 1};
            },
            "slivers: aspect: 2 "},
           {[](MeshTransform& t) {
              t.slivers = Slivers{10, 0};
            },
            "slivers: count: 0"},
           {[](MeshTransform& t) {
              t.slivers = Slivers{10, 33};
            },
            "slivers: count: 33 (allowed: 1 to 32"},
           {[](MeshTransform& t) { t.scale = 0; }, "scale: 0"},
           {[](MeshTransform& t) { t.stretch = V2(1, -1); }, "stretch: [1, -1]"},
           {[](MeshTransform& t) { t.move_mm.x() = std::nan(""); }, "move_mm: [nan, 0]"},
           {[](MeshTransform& t) { t.keep_contact_edges = 5; },
            "keep_contact_edges: 5 (the mesh small tooth has 4)"},
           {[](MeshTransform& t) { t.keep_displacement_edges = 0; }, "keep_displacement_edges: 0"},
           {[](MeshTransform& t) { t.keep_force_edges = -1; }, "keep_force_edges: -1"},
           // What flattens a triangle.
           {[](MeshTransform& t) { t.stretch = V2(1, 1e-14); },
            "stretch: [1, 1e-14] cannot be: small tooth: triangle 1 at ["},
           {[](MeshTransform& t) {
              t.slivers = Slivers{1e14, 1};
            },
            "slivers: aspect: 1e+14 cannot be: small tooth: triangle 17 at ["},
           {[](MeshTransform& t) { t.move_mm.x() = 1e17; },
            "move_mm: [1e+17, 0] cannot be: small tooth: triangle 1"},
           {[](MeshTransform& t) { t.scale = 1e200; },
            "scale: 1e+200 cannot be: small tooth: triangle 1 at ["},
       }) {
    MeshTransform transform;
    change(transform);
    testing::expect_named(
        testing::complaint_of<TransformError>([&] { transformed(small_tooth(4, 4), transform); }),
        {named});
  }
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
      {{{0, 0}, 2, {}}, "normal: [0, 0]"},
      {{{1, 0}, -1, {}}, "count: -1"},
      {{{1, 0}, 1, {3, 3}}, "interfaces_mm: 3 "},
      {{{1, 0}, 1, {std::nan("")}}, "interfaces_mm: nan"},
      {{{1, 0}, 1, {5, 20}}, "interfaces_mm: 3 layers, but layer 3 has no triangle"},
      {{{1, 0}, 100, {}}, "count: 100 layers, but layer 1 has no triangle"},
  };
  for (const auto& [layers, named] : cases)
    testing::expect_named(testing::complaint_of<TransformError>(
                              [&given = layers] { layered(small_tooth(8, 4), given); }),
                          {named});
}

}  // namespace
}  // namespace airybench::mesh_transform_test
