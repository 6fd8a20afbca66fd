#include "verify/reference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "assembly/problem/pose.hpp"
#include "bench/plan/scene_file.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "solvers/methods.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posed.hpp"
#include "verify/verifier.hpp"

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
  return compute_reference(contact_system(testing::posed(Scene{}, mesh)));
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

TEST(Reference, SaysHowMuchAFlattenedMeshCosts) {
  const auto estimate = [](double height) {
    Mesh mesh = testing::catalogue_mesh("Mesh0");
    for (Eigen::Vector2d& v : mesh.vertices) v.y() *= height;
    return reference_of(mesh).error_estimate;
  };
  const double usual = estimate(1), flat = estimate(0.01);
  const bool is_x87 = std::numeric_limits<Wide>::digits == 64;  // two doubles lose nothing yet
  EXPECT_GT(flat, is_x87 ? 100 * usual : 0);
  EXPECT_LE(flat, 1e-10);  // sweeps alone stall at 5e-10
}

TEST(Reference, WithoutAFiniteSolutionThereIsNone) {
  Problem problem = pose(Scene{}, testing::catalogue_mesh("Mesh0"));
  problem.loads.gap_mm = [](const Eigen::Vector2d&, int) { return std::nan(""); };
  EXPECT_THROW(
      compute_reference(contact_system(std::make_shared<const Problem>(std::move(problem)))),
      Breakdown);
}

// Refined answers against the reference, which shares nothing with them but the mesh.
struct Posed {
  AirySystem system;
  Reference reference;
  // Unrefined, what rounding leaves is near the target, on either side by the processor's kernels.
  double error_of(const std::string& method, bool may_be_inaccurate = false) const {
    RunControl control;
    control.tolerance = 1e-12;
    const Solution solution = run(select_methods(method).front(), system, control);
    EXPECT_TRUE(solution.status == Status::ok ||
                (may_be_inaccurate && solution.status == Status::inaccurate))
        << method << ": " << name_of(solution.status) << ": " << solution.message;
    const Verification found = verify(system, solution, &reference);
    return std::max(found.error_stress.value_or(1), found.error_force.value_or(1));
  }
};

Posed posed(const char* mesh, const Scene& scene) {
  AirySystem system = airy_system(testing::posed(scene, testing::catalogue_mesh(mesh)));
  Reference reference = compute_reference(system);
  return {std::move(system), std::move(reference)};
}

constexpr std::array<const char*, 3> refined = {"3STEPD:REFINED", "BLIND:SCHUR:REFINED",
                                                "3STEPCG:DTIC4,refine=yes"};

TEST(Refinement, ReachesRoundingOnMesh0) {
  const Posed p = posed("Mesh0", {});
  for (const char* method : refined) EXPECT_LE(p.error_of(method), 1e-14) << method;
}

TEST(Refinement, GivesBackTheDigitsThatConditioningTook) {
  for (const char* scene : {"slivers_1e3", "grading_1e4"}) {
    const auto file = testing::stability_scenes_folder() / (std::string(scene) + ".json");
    const Posed p = posed("Mesh0", read_scene(file));
    for (const std::string method : {"3STEPD", "BLIND:SCHUR"})
      EXPECT_LE(p.error_of(method + ":REFINED"), 1e-4 * p.error_of(method, true))
          << method << ", " << scene;
  }
}

}  // namespace
}  // namespace airybench::reference_test
