#include "meshgen/vertex_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/quality.hpp"
#include "tests/support/complaint.hpp"

namespace airybench::vertex_search_test {
namespace {

// A stand-in for Gmsh: so many vertices, and one triangle with this smallest angle.
Mesh fake_mesh(int vertices, double angle_deg) {
  Mesh mesh;
  mesh.vertices.assign(static_cast<std::size_t>(vertices), {0, 0});
  mesh.vertices[1] = {1, 0};
  const double height = std::tan(angle_deg * M_PI / 180) / 2;
  mesh.vertices[2] = {0.5, height};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

int inverse_square(double factor) { return 10 + static_cast<int>(1000 / (factor * factor)); }

TEST(VertexSearch, HitsATargetOnEitherSideOfTheNaturalSize) {
  for (const int target : {1010, 11, 37, 500, 1011, 4321, 90210}) {
    const auto mesher = [](const InteriorRecipe& recipe) {
      return fake_mesh(inverse_square(recipe.size_factor), 40);
    };
    EXPECT_EQ(search_vertex_count(mesher, target).vertices.size(),
              static_cast<std::size_t>(target));
  }
}

TEST(VertexSearch, StopsAtTheFirstGoodHit) {
  int kinds_after_the_hit = 0;
  const auto mesher = [&](const InteriorRecipe& recipe) {
    if (recipe.algorithm != MeshAlgorithm::frontal_delaunay || recipe.grading_exponent != 1)
      ++kinds_after_the_hit;
    return fake_mesh(inverse_square(recipe.size_factor), good_angle_deg + 0.01);
  };
  search_vertex_count(mesher, 200);
  EXPECT_EQ(kinds_after_the_hit, 0);
}

TEST(VertexSearch, TakesTheBestAngleOfAllHitsWhenNoneIsGood) {
  const auto mesher = [](const InteriorRecipe& recipe) {
    const bool best =
        recipe.algorithm == MeshAlgorithm::delaunay && recipe.grading_exponent == 1.25;
    return fake_mesh(inverse_square(recipe.size_factor), best ? 25 : 20);
  };
  EXPECT_NEAR(mesh_quality(search_vertex_count(mesher, 200)).smallest_angle_deg, 25, 1e-9);
}

TEST(VertexSearch, TurnsToAnotherKindWhenOneNeverHits) {
  const auto mesher = [](const InteriorRecipe& recipe) {
    const int count = inverse_square(recipe.size_factor);
    const bool even_only = recipe.algorithm == MeshAlgorithm::frontal_delaunay;
    return fake_mesh(even_only ? count / 2 * 2 : count, 40);
  };
  EXPECT_EQ(search_vertex_count(mesher, 201).vertices.size(), 201u);
}

TEST(VertexSearch, LooksAroundAJumpAcrossTheTarget) {
  // The count falls from 300 to 100 at f = 1.7, but is 200 in a narrow band above 1.7.
  const auto mesher = [](const InteriorRecipe& recipe) {
    const double f = recipe.size_factor / 1.7;
    return fake_mesh(f < 1 ? 300 : (f > 1.00295 && f < 1.00305 ? 200 : 100), 40);
  };
  EXPECT_EQ(search_vertex_count(mesher, 200).vertices.size(), 200u);
}

TEST(VertexSearch, SaysTheNearestCountWhenNothingHits) {
  const auto mesher = [](const InteriorRecipe& recipe) {
    return fake_mesh(inverse_square(recipe.size_factor) / 2 * 2, 40);
  };
  const std::string what =
      testing::complaint_of<MeshError>([&] { search_vertex_count(mesher, 201); });
  EXPECT_TRUE(what == "no mesh with 201 vertices on this boundary; the nearest found has 200" ||
              what == "no mesh with 201 vertices on this boundary; the nearest found has 202")
      << what;
}

TEST(VertexSearch, EndsWhenTheCountDoesNotDependOnTheFactor) {
  int calls = 0;
  const auto mesher = [&](const InteriorRecipe&) {
    ++calls;
    return fake_mesh(50, 40);
  };
  EXPECT_THROW(search_vertex_count(mesher, 60), MeshError);
  EXPECT_THROW(search_vertex_count(mesher, 40), MeshError);
  EXPECT_LT(calls, 1000);
}

}  // namespace
}  // namespace airybench::vertex_search_test
