// Bodies with holes: closed forms on a ring, and bounds where there is none.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "assembly/elements/edge_forces.hpp"
#include "assembly/elements/elasticity.hpp"
#include "assembly/problem/pose.hpp"
#include "mesh/refinement.hpp"
#include "tests/support/exact_fields.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/solved.hpp"
#include "verify/discretisation_error.hpp"
#include "verify/displacement_recovery.hpp"
#include "verify/reference.hpp"
#include "verify/verifier.hpp"

namespace airybench::holes_test {
namespace {

using V2 = Eigen::Vector2d;
using V3 = Eigen::Vector3d;
using testing::ExactField;

constexpr double young = 2000, poisson = 0.3, shear = young / (2 * (1 + poisson));
constexpr double inner = 2, outer = 6;  // mm
const Eigen::Matrix3d steel = compliance({young, poisson}, Plane::strain);

V3 from_polar(double rr, double tt, double rt, double at) {
  const double c = std::cos(at), s = std::sin(at);
  return {rr * c * c + tt * s * s - 2 * rt * c * s, rr * s * s + tt * c * c + 2 * rt * c * s,
          (rr - tt) * c * s + rt * (c * c - s * s)};
}

double angle(const V2& x) { return std::atan2(x.y(), x.x()); }

// A pressure of 10 MPa in the hole, the rim free (Lamé).
ExactField pressed() {
  const double k = 10 / (outer * outer / (inner * inner) - 1), b = k * outer * outer;
  return {"pressure in the hole", V2::Zero(),
          [=](const V2& x) -> V3 {
            const double part = b / x.squaredNorm();
            return from_polar(k - part, k + part, 0, angle(x));
          },
          [=](const V2& x) -> V2 {
            return ((1 - 2 * poisson) * k + b / x.squaredNorm()) / (2 * shear) * x;
          }};
}

// A couple on the hole, φ = −C θ.
ExactField twisted() {
  constexpr double couple = 40;
  return {"couple on the hole", V2::Zero(),
          [](const V2& x) -> V3 { return from_polar(0, 0, couple / x.squaredNorm(), angle(x)); },
          [](const V2& x) -> V2 {
            return couple / (2 * shear) * (1 / (inner * inner) - 1 / x.squaredNorm()) *
                   V2(-x.y(), x.x());
          }};
}

// A force of 100 N along x on the hole, as if at its centre (Kelvin).
ExactField pulled() {
  constexpr double k = 100 / (4 * std::numbers::pi * (1 - poisson));
  return {"force on the hole", V2::Zero(),
          [](const V2& x) -> V3 {
            const double r = x.norm(), c = x.x() / r, s = x.y() / r, a = 1 - 2 * poisson;
            return -k / r *
                   V3(a * c + 2 * c * c * c, -a * c + 2 * c * s * s, a * s + 2 * c * c * s);
          },
          [](const V2& x) -> V2 {
            const double r = x.norm(), c = x.x() / r, s = x.y() / r;
            return k / (2 * shear) * V2(-(3 - 4 * poisson) * std::log(r) + c * c, c * s);
          }};
}

// A tension of 50 MPa along x far away, the hole free (Kirsch 1898).
constexpr double tension = 50;
ExactField stretched() {
  return {"tension far away", V2::Zero(),
          [](const V2& x) -> V3 {
            const double at = angle(x), q = inner * inner / x.squaredNorm();
            const double cosine = std::cos(2 * at), sine = std::sin(2 * at);
            return tension / 2 *
                   from_polar(1 - q + (1 - 4 * q + 3 * q * q) * cosine,
                              1 + q - (1 + 3 * q * q) * cosine, -(1 + 2 * q - 3 * q * q) * sine,
                              at);
          },
          [](const V2& x) -> V2 {
            constexpr double kappa = 3 - 4 * poisson;
            const double at = angle(x), p = inner / x.norm(), q = 2 * p * p * p;
            return tension * inner / (8 * shear) *
                   V2((kappa + 1) * std::cos(at) / p +
                          2 * p * ((1 + kappa) * std::cos(at) + std::cos(3 * at)) -
                          q * std::cos(3 * at),
                      (kappa - 3) * std::sin(at) / p +
                          2 * p * ((1 - kappa) * std::sin(at) + std::sin(3 * at)) -
                          q * std::sin(3 * at));
          }};
}

// Roles of a ring's two curves.
Mesh ring(int around, BoundaryRole hole, BoundaryRole rim) {
  Mesh mesh = testing::small_ring(around, around / 4, inner, outer);
  for (BoundaryEdge& edge : mesh.boundary)
    edge.role = mesh.boundary_groups[edge.group] == "hole" ? hole : rim;
  mesh.is_polygon = true;  // the closed forms are prescribed on it
  return mesh;
}

struct Solved {
  ContactSystem system;
  Solution hybrid, p2;

  explicit Solved(Problem problem)
      : system(contact_system(std::make_shared<const Problem>(std::move(problem)))),
        hybrid(testing::solved_by("HYBRID", system)),
        p2(testing::solved_by("P2", system)) {
    EXPECT_EQ(hybrid.status, Status::ok) << hybrid.message;
    EXPECT_EQ(p2.status, Status::ok) << p2.message;
    const Reference reference = compute_reference(system);
    EXPECT_LT(reference.error_estimate, 1e-14);
    EXPECT_LT(worst_measure(verify(system, hybrid, &reference)).value, 1e-10);
    EXPECT_LT(worst_measure(verify_displacement(system, p2)).value, 1e-9);
  }
  const Problem& problem() const { return *system.problem; }
  ConstitutiveError error() const {
    return constitutive_error(system, hybrid.stress, hybrid.F_C, testing::displacement(p2));
  }
  ConstitutiveError recovered_error() const {
    return constitutive_error(system, hybrid.stress, hybrid.F_C,
                              recovered_displacement(system, hybrid));
  }
};

// √∫ (σ − exact):C:(σ − exact): on every third a rule of seven points, exact for degree 5.
double distance(const Problem& problem, const StressField& stress, const ExactField& exact) {
  constexpr double a = 0.470142064105115, b = 0.101286507323456;
  constexpr std::array<std::array<double, 4>, 7> points = {{{1. / 3, 1. / 3, 1. / 3, 0.225},
                                                            {a, a, 1 - 2 * a, 0.132394152788506},
                                                            {a, 1 - 2 * a, a, 0.132394152788506},
                                                            {1 - 2 * a, a, a, 0.132394152788506},
                                                            {b, b, 1 - 2 * b, 0.125939180544827},
                                                            {b, 1 - 2 * b, b, 0.125939180544827},
                                                            {1 - 2 * b, b, b, 0.125939180544827}}};
  double squared = 0;
  for (int t = 0; t < static_cast<int>(stress.size()); ++t) {
    const TriangleVertices v = problem.vertices_of(t);
    for (int third = 0; third < 3; ++third) {
      Eigen::Matrix<double, 2, 3> corner;
      corner << v.col(third), v.col((third + 1) % 3), v.rowwise().mean();
      for (const auto& [l, m, n, weight] : points) {
        const V3 lambda(l, m, n),
            d = stress[t].middleCols<3>(3 * third) * lambda - exact.stress(corner * lambda);
        squared += weight * problem.area_mm2(t) / 3 * d.dot(problem.compliance_of(t) * d);
      }
    }
  }
  return std::sqrt(squared);
}

// The data of the exact field on all of a ring's boundary, which is polygons. Tractions are their
// L² projections on linear ones, edge by edge: what is left out does no work on rigid motions.
Loads loads_on(const Mesh& mesh, const ExactField& exact) {
  Loads loads = testing::loads_of(exact);
  loads.traction_MPa = [mesh, f = loads.traction_MPa](const V2& x, const V2& normal, int row) {
    const auto [start, end] = mesh.boundary[row].vertices;
    const V2 a = mesh.vertices[start], b = mesh.vertices[end];
    V2 of_a = V2::Zero(), of_b = V2::Zero();  // ∫ N f / L
    for (const auto& [s, weight] : {std::pair(0.5 - std::sqrt(0.15), 5. / 18),
                                    {0.5, 8. / 18},
                                    {0.5 + std::sqrt(0.15), 5. / 18}}) {
      const V2 at = f(a + s * (b - a), normal, row);
      of_a += weight * (1 - s) * at;
      of_b += weight * s * at;
    }
    const double s = (x - a).dot(b - a) / (b - a).squaredNorm();
    return V2((1 - s) * (4 * of_a - 2 * of_b) + s * (4 * of_b - 2 * of_a));
  };
  return loads;
}

TEST(Ring, StressesConvergeToClosedFormsInsideTheirBound) {
  using enum BoundaryRole;
  for (const ExactField& exact : {pressed(), twisted(), pulled(), stretched()})
    for (const auto& [hole, rim] :
         {std::pair(force, displacement), {displacement, force}, {displacement, displacement}}) {
      double before = 0;
      for (const int around : {16, 32}) {
        SCOPED_TRACE(::testing::Message() << exact.name << " by role " << static_cast<int>(hole)
                                          << " on it, " << around << " edges");
        const Mesh mesh = ring(around, hole, rim);
        const Solved s(make_problem(mesh, {steel}, loads_on(mesh, exact), 0));
        const double off = distance(s.problem(), s.hybrid.stress, exact),
                     norm = std::sqrt(stress_norm_squared(s.problem(), s.hybrid.stress));
        for (const ConstitutiveError& error : {s.error(), s.recovered_error()}) {
          EXPECT_TRUE(error.guaranteed) << error.flaw;
          EXPECT_LT(off, error.relative * norm);
        }
        EXPECT_LT(off, around == 16 ? 0.12 * norm : before / 3);
        before = off;
      }
    }
}

// The mean of σ_xx at a vertex, over the thirds around it.
double mean_tension(const Problem& problem, const StressField& stress, const V2& x) {
  double sum = 0;
  int count = 0;
  for (std::size_t t = 0; t < stress.size(); ++t)
    for (int k = 0; k < 3; ++k)
      if ((problem.mesh.vertices[problem.mesh.triangles[t][k]] - x).norm() < 1e-9) {
        sum += stress[t](0, 3 * k) + stress[t](0, 3 * ((k + 2) % 3) + 1);
        count += 2;
      }
  return sum / count;
}

// A free polygon has corners, which Kirsch's circle has not: they cost less than what is left here.
TEST(Ring, TheStressConcentrationOfAFreeHoleTendsToThree) {
  const ExactField exact = stretched();
  double off_before = 0, missing_before = 0;
  for (const int around : {16, 32, 64}) {
    SCOPED_TRACE(around);
    Loads loads = testing::loads_of(exact);
    loads.traction_MPa = {};
    const Solved s(make_problem(ring(around, BoundaryRole::force, BoundaryRole::displacement),
                                {steel}, std::move(loads), 0));
    const double off = distance(s.problem(), s.hybrid.stress, exact),
                 norm = std::sqrt(stress_norm_squared(s.problem(), s.hybrid.stress)),
                 missing = 3 - mean_tension(s.problem(), s.hybrid.stress, {0, inner}) / tension;
    EXPECT_LT(off, s.error().relative * norm);
    if (around > 16) {
      EXPECT_LT(off, off_before / 2.8);
      EXPECT_LT(std::abs(missing), std::abs(missing_before) / 4);
    }
    off_before = off;
    missing_before = missing;
  }
  EXPECT_NEAR(missing_before, 0, 0.01);
}

Scene plate_scene(double friction) {
  Scene scene;
  scene.friction = friction;
  scene.crown_radius_mm.reset();
  scene.displacement_mm = {0.02, 0.012};
  return scene;
}

// In contact at its right side, or at that side of its hole which faces right.
Mesh plate(bool in_hole) {
  Mesh mesh = testing::small_plate(2);
  if (in_hole)
    for (BoundaryEdge& edge : mesh.boundary) {
      const V2 &a = mesh.vertices[edge.vertices[0]], &b = mesh.vertices[edge.vertices[1]];
      if (edge.role == BoundaryRole::contact) edge.role = BoundaryRole::force;
      if (a.x() == 4 && b.x() == 4) edge.role = BoundaryRole::contact;
    }
  return mesh;
}

// Pressed against a wall and pulled along it.
TEST(Plate, BothSolutionsCloseInOnOneEnergyInContact) {
  for (const auto& [in_hole, friction] :
       {std::pair(false, 0.0), {false, 0.2}, {true, 0.0}, {true, 0.2}}) {
    SCOPED_TRACE(::testing::Message()
                 << "friction " << friction << (in_hole ? ", in the hole" : ""));
    Mesh mesh = plate(in_hole);
    double gap_before = 0, lower_before = 0, upper_before = 0, error_before = 1;
    for (int refined = 0; refined < 3; ++refined, mesh = uniformly_refined(mesh)) {
      const Solved s(pose(plate_scene(friction), mesh));
      const ConstitutiveError error = s.error();
      EXPECT_EQ(error.flaw, "");
      EXPECT_EQ(error.guaranteed, friction == 0);
      EXPECT_LT(error.relative, error_before / (in_hole ? 1.2 : 1.3));  // its corners are singular
      error_before = error.relative;
      if (friction == 0) {
        const double gap = error.upper_bound_Nmm - error.lower_bound_Nmm;
        EXPECT_GT(gap, 0);
        if (refined > 0) {  // the finer spaces hold the coarser ones
          EXPECT_GT(error.lower_bound_Nmm, lower_before);
          EXPECT_LT(error.upper_bound_Nmm, upper_before);
          EXPECT_LT(gap, gap_before / (in_hole ? 1.5 : 1.7));
        }
        gap_before = gap;
        lower_before = error.lower_bound_Nmm;
        upper_before = error.upper_bound_Nmm;
      } else {
        const Verification v = verify(s.system, s.hybrid, nullptr);
        EXPECT_EQ(*v.n_stick > 0, !in_hole);
        EXPECT_GT(*v.n_slip, 0);
      }
    }
  }
}

// Σ of the edges' forces, and their couple about the origin, on a group of the boundary.
struct Resultant {
  V2 force = V2::Zero();
  double couple = 0;
};
Resultant resultant(const Solved& s, const std::string& group) {
  const Problem& problem = s.problem();
  Resultant sum;
  testing::visit_boundary(problem, [&](int row, int t, int k) {
    const int own = problem.mesh.boundary[row].group;
    if (own < 0 || problem.mesh.boundary_groups[own] != group) return;
    const TriangleVertices v = problem.vertices_of(t);
    const Eigen::Matrix2d F = element_edge_forces(v, s.hybrid.stress[t], k);
    const V2 a = v.col(k), b = v.col((k + 1) % 3);
    for (const auto& [at, f] : {std::pair<V2, V2>((2 * a + b) / 3, F.col(0)),
                                std::pair<V2, V2>((a + 2 * b) / 3, F.col(1))}) {
      sum.force += f;
      sum.couple += at.x() * f.y() - at.y() * f.x();
    }
  });
  return sum;
}

// Held in the hole, pulled and turned at the rim, under its own weight.
TEST(Ring, AHoleThatHoldsTheBodyCarriesItsLoads) {
  const Mesh mesh = ring(24, BoundaryRole::displacement, BoundaryRole::force);
  Loads loads;
  loads.traction_MPa = [](const V2& x, const V2&, int) { return V2(x.y() > 0 ? 30 : 0, x.x()); };
  loads.body_force_N_per_mm3 = {0, -3};
  const Solved s(make_problem(mesh, {steel}, std::move(loads), 0));
  const Resultant hole = resultant(s, "hole"), rim = resultant(s, "rim");
  const V2 weight = extent_of(mesh).area_mm2 * s.problem().loads.body_force_N_per_mm3;
  EXPECT_GT(rim.force.norm(), 100);
  EXPECT_LT((hole.force + rim.force + weight).norm(), 1e-10 * rim.force.norm());
  EXPECT_GT(std::abs(rim.couple), 100);
  EXPECT_NEAR(hole.couple + rim.couple, 0, 1e-9 * std::abs(rim.couple));
  EXPECT_TRUE(s.error().guaranteed);
  EXPECT_LT(s.error().relative, 0.1);
}

// A pin without play: the rim is moved against it, and half of the hole opens.
TEST(Ring, AHoleInContactCarriesWhatMovesTheRim) {
  double before = 0, error_before = 0;
  for (const int around : {16, 32, 64}) {
    SCOPED_TRACE(around);
    Scene scene = plate_scene(0);
    scene.displacement_mm = {0.02, 0};
    const Solved s(pose(scene, ring(around, BoundaryRole::contact, BoundaryRole::displacement)));
    const Verification v = verify(s.system, s.hybrid, nullptr);
    EXPECT_GT(*v.n_open, around / 2);
    EXPECT_GT(*v.n_slip, around / 2);
    const Resultant hole = resultant(s, "hole"), rim = resultant(s, "rim");
    EXPECT_LT(hole.force.x(), -1);
    EXPECT_LT((hole.force + rim.force).norm(), 1e-10 * rim.force.norm());
    EXPECT_NEAR(hole.force.y(), 0, 1e-3 * std::abs(hole.force.x()));
    const ConstitutiveError error = s.recovered_error();
    EXPECT_TRUE(error.guaranteed) << error.flaw;
    if (around > 16) {
      EXPECT_NEAR(hole.force.x(), before, 0.01 * std::abs(before));
      EXPECT_LT(error.relative, error_before / 1.3);
    }
    before = hole.force.x();
    error_before = error.relative;
  }
}

}  // namespace
}  // namespace airybench::holes_test
