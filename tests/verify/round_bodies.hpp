// Quarters of rings with curved sides, and closed forms.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "assembly/elements/elasticity.hpp"
#include "assembly/problem/scene.hpp"
#include "mesh/arcs.hpp"
#include "tests/support/small_meshes.hpp"
#include "tests/verify/true_error.hpp"

namespace airybench::testing {

// Tension 1 MPa along x far away, a free hole of radius 1 mm (Kirsch 1898).
inline Eigen::Vector3d stretched(const Eigen::Vector2d& x) {
  const double q = 1 / x.squaredNorm(), two = 2 * std::atan2(x.y(), x.x());
  return from_polar((1 - q + (1 - 4 * q + 3 * q * q) * std::cos(two)) / 2,
                    (1 + q - (1 + 3 * q * q) * std::cos(two)) / 2,
                    -(1 + 2 * q - 3 * q * q) * std::sin(two) / 2, x);
}

// A pressure of 1 MPa in the hole of a ring from 1 to 2 mm, its rim free (Lamé).
inline Eigen::Vector3d pressed(const Eigen::Vector2d& x) {
  const double q = 4 / x.squaredNorm();
  return from_polar((1 - q) / 3, (1 + q) / 3, 0, x);
}

// Its displacement with 1000 MPa.
inline Eigen::Vector2d widened(const Eigen::Vector2d& x, double poisson) {
  const double shear = 1000 / (2 * (1 + poisson));
  return ((1 - 2 * poisson) + 4 / x.squaredNorm()) / (6 * shear) * x;
}

inline Mesh with_rim(Mesh mesh, BoundaryRole role) {
  for (BoundaryEdge& edge : mesh.boundary)
    if (boundary_label(mesh, edge) == "force:rim") edge.role = role;
  return mesh;
}

enum class Rim { loaded, held, rolling };

// With the tractions of the exact stress on both circles, rollers on the straight sides.
inline Problem quarter(int around, int across, double outer_mm, const ExactStress& exact,
                       double poisson, Rim rim = Rim::loaded) {
  Mesh mesh = quarter_ring(around, across, 1, outer_mm);
  EXPECT_EQ(recognise_arcs(mesh), 2 * around);
  Loads loads;
  for (const BoundaryEdge& edge : mesh.boundary)
    loads.rollers.push_back(edge.role == BoundaryRole::displacement ||
                            (rim == Rim::rolling && boundary_label(mesh, edge) == "force:rim"));
  if (rim != Rim::loaded) {
    mesh = with_rim(std::move(mesh), BoundaryRole::displacement);
    loads.displacement_mm = [poisson](const Eigen::Vector2d& x, int) {
      return widened(x, poisson);
    };
  }
  loads.traction_MPa = [exact](const Eigen::Vector2d& x, const Eigen::Vector2d& n, int) {
    return traction(exact(x), n);
  };
  return make_problem(std::move(mesh), {compliance({1000, poisson}, Plane::strain)},
                      std::move(loads), 0);
}

// The largest allowed ratio of estimated error to true error: near incompressibility what makes
// displacements admissible costs more than their error.
inline double most_overestimated(double poisson, Rim rim) {
  if (poisson < 0.4) return 2.5;
  return rim == Rim::loaded ? 3 : rim == Rim::held ? 6 : 13;
}

// expect(exact stress, outer_mm, across, Poisson's ratio, rim), as of quarter().
inline void for_pressed_rings(const auto& expect) {
  for (const auto& [rim, name] :
       {std::pair(Rim::loaded, "loaded"), {Rim::held, "held"}, {Rim::rolling, "rolling"}}) {
    SCOPED_TRACE(::testing::Message() << "rim " << name);
    for (const double poisson : {0.3, 0.4999}) expect(pressed, 2, 2, poisson, rim);
  }
}

// A ring of 1 to 2 mm in a socket that is `too_small` smaller: the pressure is the same everywhere.
struct RingInASocket {
  static constexpr double young = 1000, poisson = 0.3, too_small = 0.002;
  static constexpr double pressure =
      too_small * young * 3 / ((1 + poisson) * 2 * ((1 - 2 * poisson) * 4 + 1));

  static Eigen::Vector3d exact(const Eigen::Vector2d& x) {
    const double q = 1 / x.squaredNorm();
    return from_polar(-pressure * 4 / 3 * (1 - q), -pressure * 4 / 3 * (1 + q), 0, x);
  }
  static Scene scene(double friction) {
    Scene scene;
    scene.material = {young, poisson};
    scene.wall = CircularWall{{0, 0}, 2 - too_small, CircularWall::Bodies::inside};
    scene.displacement_mm = {0, 0};
    scene.friction = friction;
    for (const char* side : {"displacement:bottom", "displacement:left"})
      scene.boundary[side].support = BoundaryValues::Support::normal;
    return scene;
  }
  static Mesh mesh(int around) {
    Mesh mesh = quarter_ring(around, around / 2, 1, 2);
    EXPECT_EQ(recognise_arcs(mesh), 2 * around);
    return with_rim(std::move(mesh), BoundaryRole::contact);
  }
};

// A ring that only its socket holds, under its own weight and a pull in its hole.
struct RingInSocket {
  RingInSocket() {
    using Point = Eigen::Vector2d;
    EXPECT_EQ(recognise_arcs(mesh), 40);
    scene.friction = 0.3;
    scene.crown_radius_mm.reset();
    scene.displacement_mm = {0, 0};
    scene.body_force_N_per_mm3 = {0, -2};
    scene.boundary["force:hole"].traction_MPa = LinearValue<Point>{{Point(1, -3), Point(1, -3)}};
    scene.boundary["contact:rim"].contact.wall =
        CircularWall{{0, 0}, 3, CircularWall::Bodies::inside};
  }
  Mesh mesh = with_role(small_ring(20, 3, 1, 3), BoundaryRole::displacement, BoundaryRole::contact);
  Scene scene;
};

}  // namespace airybench::testing
