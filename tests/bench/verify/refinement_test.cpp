// Refined answers against the reference, which shares nothing with them but the mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "bench/plan/scene_file.hpp"
#include "bench/verify/reference.hpp"
#include "bench/verify/verifier.hpp"
#include "mesh/msh_format.hpp"
#include "solvers/methods.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posed.hpp"

namespace airybench::refinement_test {
namespace {

struct Posed {
  DualSystem system;
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
  DualSystem system = assemble(testing::posed(scene, testing::catalogue_mesh(mesh)));
  Reference reference = compute_reference(system);
  return {std::move(system), std::move(reference)};
}

constexpr std::array<const char*, 3> refined = {"3STEPD:REFINED", "BLIND:SCHUR:REFINED",
                                                "3STEPCG:DTIC4,refine=yes"};

TEST(Refinement, ReachesRoundingOnMesh0) {
  const Posed p = posed("Mesh0", {});
  for (const char* method : refined) EXPECT_LE(p.error_of(method), 1e-14) << method;
}

#ifndef AIRYBENCH_SANITIZED
TEST(Refinement, ReachesRoundingOnMesh3) {
  const Posed p = posed("Mesh3", {});
  for (const char* method : refined) EXPECT_LE(p.error_of(method), 1e-13) << method;
}
#endif

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
}  // namespace airybench::refinement_test
