// What is called the diagonal of D from below, against D.
#include "solvers/condensation/contact_compliance.hpp"

#include <gtest/gtest.h>

#include "assembly/elements/equilibrium_element.hpp"

#include "tests/support/condensed_problem.hpp"
#include "tests/support/named_scenes.hpp"
#include "tests/support/posed.hpp"

namespace airybench::contact_compliance_test {
namespace {

using testing::posed;

// D_jj over what it is said to be at least, of every row of F_C.
Eigen::ArrayXd times_from_below(const Problem& problem, int degree = 1) {
  const ContactPoints contact = contact_points(problem, degree);
  const HybridizedSystem system = assemble_hybridized(problem, contact);
  const Eigen::VectorXd below = compliance_from_below(problem, system.K, contact);
  return testing::condensed(problem, contact).D.diagonal().array() / below.array();
}

testing::NamedScenes scenes() {
  testing::NamedScenes all = testing::named_scenes({
      {"default", [](Scene&) {}},
      {"frictionless", [](Scene& s) { s.friction = 0; }},
      {"plane stress", [](Scene& s) { s.plane = Plane::stress; }},
      {"nearly incompressible", [](Scene& s) { s.material.poisson = 0.4999; }},
  });
  for (const double stiffness : {1e-8, 1e8})
    for (const Eigen::Vector2d& normal : {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)})
      all.emplace_back("layers of " + std::to_string(stiffness),
                       testing::layered_scene(normal, stiffness));
  return all;
}

TEST(ContactCompliance, IsBelowThatOfD) {
  for (const Mesh& mesh : {testing::small_tooth(8, 6), testing::small_rack(2, 4, 3)})
    for (const auto& [name, scene] : scenes())
      for (int degree = 1; degree <= highest_stress_degree; ++degree) {
        const Eigen::ArrayXd times = times_from_below(*posed(scene, mesh), degree);
        EXPECT_GE(times.minCoeff(), 1 - 1e-6) << mesh.name << ' ' << name << ", k = " << degree;
      }
}

// A natural map is at most so many times too large.
TEST(ContactCompliance, IsNotFarBelowInOneMaterial) {
  for (const Mesh& mesh : {testing::small_tooth(8, 6), testing::small_rack(2, 4, 3)})
    EXPECT_LE(times_from_below(*posed({}, mesh)).maxCoeff(), 4) << mesh.name;
}

}  // namespace
}  // namespace airybench::contact_compliance_test
