// Bodies that contact alone holds, or does not, under body forces and on walls.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "solvers/loading/load_steps.hpp"
#include "solvers/methods.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/posed.hpp"

namespace airybench::testing {

inline LinearValue<Eigen::Vector2d> everywhere(const Eigen::Vector2d& value) {
  return {{value, value}};
}

inline Solution solved_scene(const Scene& scene, const Mesh& mesh, const char* name) {
  const Method method = select_methods(name).front();
  const std::unique_ptr<ContactSystem> system = assemble(method, posed(scene, mesh));
  return solve_load_case(method.solve, *system, {});
}

// The same line from every method.
// By a message that has these parts.
inline void expect_breakdown(const Scene& scene, const Mesh& mesh,
                             const std::vector<std::string>& named,
                             const std::vector<const char*>& methods = {
                                 "HYBRID", "HYBRID:k=2", "HYBRID:k=3", "3STEPD", "P2", "P3"}) {
  for (const char* name : methods) {
    const Solution solution = solved_scene(scene, mesh, name);
    EXPECT_EQ(solution.status, Status::breakdown) << name;
    expect_named(solution.message, named);
  }
}

inline void expect_ok(const Scene& scene, const Mesh& mesh,
                      const std::vector<const char*>& methods) {
  for (const char* name : methods) {
    const Solution solution = solved_scene(scene, mesh, name);
    EXPECT_EQ(solution.status, Status::ok) << name << ": " << solution.message;
  }
}

inline Scene weighing(double N_per_mm3) {
  Scene scene;
  scene.crown_radius_mm.reset();
  scene.displacement_mm = {0, 0};
  scene.body_force_N_per_mm3 = {0, -N_per_mm3};
  return scene;
}

// About the origin.
inline Mesh turned(Mesh mesh, double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  for (Eigen::Vector2d& x : mesh.vertices)
    x = {std::cos(angle) * x.x() - std::sin(angle) * x.y(),
         std::sin(angle) * x.x() + std::cos(angle) * x.y()};
  return mesh;
}

inline FlatWall turned_floor(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {{0, 0}, {-std::sin(angle), std::cos(angle)}};
}

}  // namespace airybench::testing
