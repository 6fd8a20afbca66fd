#include "bench/verify/reference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <random>

#include "assembly/scene.hpp"
#include "mesh/msh_format.hpp"
#include "solvers/base/solution.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posed.hpp"

namespace airybench::reference_test {
namespace {

// The same mesh with its vertices and triangles in random order, and every triangle begun at a
// random vertex: all roundings of assembly and factorisation change, the problem does not.
Mesh renumbered(const Mesh& mesh, unsigned seed) {
  std::mt19937 generator(seed);
  std::vector<int> place(mesh.vertices.size());
  std::iota(place.begin(), place.end(), 0);
  std::shuffle(place.begin(), place.end(), generator);
  Mesh other = mesh;
  for (std::size_t v = 0; v < place.size(); ++v) other.vertices[place[v]] = mesh.vertices[v];
  for (auto& triangle : other.triangles) {
    std::rotate(triangle.begin(), triangle.begin() + generator() % 3, triangle.end());
    for (int& v : triangle) v = place[v];
  }
  std::shuffle(other.triangles.begin(), other.triangles.end(), generator);
  for (BoundaryEdge& edge : other.boundary)
    for (int& v : edge.vertices) v = place[v];
  return other;
}

Reference reference_of(const Mesh& mesh) {
  return compute_reference(assemble(testing::posed(Scene{}, mesh), Blocks::contact_points));
}

TEST(Reference, DoesNotDependOnTheNumbering) {
  for (const char* name : {"Mesh0", "Mesh4"}) {
    const Mesh mesh = testing::catalogue_mesh(name);
    const Reference one = reference_of(mesh), other = reference_of(renumbered(mesh, 5));
    EXPECT_LT((one.F_C - other.F_C).norm(), 1e-14 * one.F_C.norm()) << name;
    EXPECT_LT((one.condensed.D - other.condensed.D).norm(), 1e-11 * one.condensed.D.norm()) << name;
    EXPECT_LE(one.natural_map_residual, 1e-14) << name;
    EXPECT_LE(one.error_estimate, 1e-14) << name;
  }
}

TEST(Reference, KnowsTheDisplacementsOfItsForces) {
  const Mesh mesh = testing::catalogue_mesh("Mesh0");
  const DualSystem system = assemble(testing::posed(Scene{}, mesh), Blocks::contact_points);
  const Reference reference = compute_reference(system);
  const CondensedSystem& condensed = reference.condensed;
  const Eigen::VectorXd residual =
      natural_map(system.contact, condensed.D.diagonal(), reference.F_C,
                  condensed.D * reference.F_C - condensed.G);
  EXPECT_LE(residual.norm(), 1e-14 * reference.F_C.norm());
}

TEST(Reference, SaysHowMuchAFlattenedMeshCosts) {
  const auto estimate = [](double height) {
    Mesh mesh = testing::catalogue_mesh("Mesh0");
    for (Eigen::Vector2d& v : mesh.vertices) v.y() *= height;
    return reference_of(mesh).error_estimate;
  };
  const double usual = estimate(1), flat = estimate(0.01);
  EXPECT_GT(flat, 100 * usual);
  EXPECT_LE(flat, 1e-10);  // sweeps alone stall at 5e-10
}

TEST(Reference, WithoutAFiniteSolutionThereIsNone) {
  Problem problem = pose(Scene{}, testing::catalogue_mesh("Mesh0"));
  problem.loads.gap_mm = [](const Eigen::Vector2d&, int) { return std::nan(""); };
  EXPECT_THROW(compute_reference(assemble(std::make_shared<const Problem>(std::move(problem)),
                                          Blocks::contact_points)),
               Breakdown);
}

}  // namespace
}  // namespace airybench::reference_test
