#include "tests/support/exact_fields.hpp"

#include "assembly/total_displacement.hpp"

namespace airybench::testing {

std::vector<ExactField> exact_fields(double E, double nu) {
  using V2 = Eigen::Vector2d;
  using V3 = Eigen::Vector3d;
  return {
      {"constant stress, rotated",
       {0, 0},
       [](const V2&) -> V3 { return V3(50, -80, 30); },
       [=](const V2& x) -> V2 {
         const double exx = (50 + nu * 80) / E, eyy = (-80 - nu * 50) / E;
         const double shear = 2 * (1 + nu) * 30 / E, turn = 0.01;
         return V2(exx * x.x() + (shear / 2 - turn) * x.y() + 0.3,
                   (shear / 2 + turn) * x.x() + eyy * x.y() - 0.1);
       }},
      {"bending about z, phi = y^3",
       {0, 0},
       [](const V2& x) -> V3 { return V3(6 * x.y(), 0, 0); },
       [=](const V2& x) -> V2 {
         return V2(6 * x.x() * x.y(), -3 * (x.x() * x.x() + nu * x.y() * x.y())) / E;
       }},
      {"bending the other way, phi = x^3",
       {0, 0},
       [](const V2& x) -> V3 { return V3(0, 6 * x.x(), 0); },
       [=](const V2& x) -> V2 {
         return V2(-3 * (x.y() * x.y() + nu * x.x() * x.x()), 6 * x.x() * x.y()) / E;
       }},
      {"varying shear, phi = x^2 y",
       {0, 0},
       [](const V2& x) -> V3 { return V3(0, 2 * x.y(), -2 * x.x()); },
       [=](const V2& x) -> V2 {
         return V2(-2 * nu * x.x() * x.y(), x.y() * x.y() - (2 + nu) * x.x() * x.x()) / E;
       }},
      {"bar under its own weight",
       {7, 0},
       [](const V2& x) -> V3 { return V3(-7 * x.x(), 0, 0); },
       [=](const V2& x) -> V2 {
         return V2(-3.5 * (x.x() * x.x() + nu * x.y() * x.y()), 7 * nu * x.x() * x.y()) / E;
       }},
  };
}

Loads loads_of(const ExactField& field) {
  Loads loads;
  loads.displacement_mm = [u = field.displacement](const Eigen::Vector2d& x, int) { return u(x); };
  loads.traction_MPa = [stress = field.stress](const Eigen::Vector2d& x,
                                               const Eigen::Vector2d& normal,
                                               int) { return traction(stress(x), normal); };
  loads.body_force_N_per_mm3 = field.body_force;
  return loads;
}

double stress_deviation(const Problem& problem, const StressField& stress,
                        const ExactField& exact) {
  double worst = 0, size = 0;
  for (int t = 0; t < static_cast<int>(stress.size()); ++t) {
    const TriangleVertices v = problem.vertices_of(t);
    const ElementStress corners = stress.corners(static_cast<std::size_t>(t));
    for (int c = 0; c < 9; ++c) {
      const Eigen::Vector2d x = c % 3 == 2 ? Eigen::Vector2d(v.rowwise().mean())
                                           : Eigen::Vector2d(v.col((c / 3 + c % 3) % 3));
      worst = std::max(worst, (corners.col(c) - exact.stress(x)).cwiseAbs().maxCoeff());
      size = std::max(size, exact.stress(x).cwiseAbs().maxCoeff());
    }
  }
  return worst / size;
}

double displacement_deviation(const Problem& problem, const DisplacementField& w,
                              const ExactField& exact) {
  const DisplacementField u = with_rigid_motion(problem, w);
  double worst = 0, size = 0;
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t)
    for (int k = 0; k < 6; ++k) {
      const Eigen::Vector3d here = Eigen::Vector3d::Unit(k % 3),
                            next = Eigen::Vector3d::Unit((k + k / 3) % 3),
                            lambda = (here + next) / 2;
      const Eigen::Vector2d expected = exact.displacement(problem.vertices_of(t) * lambda);
      worst = std::max(worst, (displacement_at(problem, u, t, lambda) - expected).norm());
      size = std::max(size, expected.norm());
    }
  return worst / size;
}

}  // namespace airybench::testing
