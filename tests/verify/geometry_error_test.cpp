// The total error of round bodies against closed forms: chords count.
#include "verify/geometry_error.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "assembly/elements/elasticity.hpp"
#include "mesh/arcs.hpp"
#include "mesh/refinement.hpp"
#include "tests/support/small_meshes.hpp"
#include "tests/verify/solved_body.hpp"
#include "tests/verify/true_error.hpp"

namespace airybench::geometry_error_test {
namespace {

using testing::small_ring;
using Point = Eigen::Vector2d;
using testing::ExactStress, testing::true_error;

constexpr double inner = 1, outer = 3;  // mm

Mesh round_ring(int around, int refinements = 0) {
  Mesh mesh = small_ring(around, 3, inner, outer);
  EXPECT_EQ(recognise_arcs(mesh), 2 * around);
  for (int k = 0; k < refinements; ++k) mesh = uniformly_refined(mesh);
  return mesh;
}

// Pressed by 10 MPa on one circle, held on the other (Lamé): σ_rr, σ_tt = A ∓ B/r², and u = 0 where
// B = −(1 − 2ν) A r².
struct PressedRing {
  double poisson = 0.3;
  bool is_hole_held = false;

  Scene scene() const {
    Scene scene;
    scene.material.poisson = poisson;
    scene.displacement_mm = {0, 0};
    scene.boundary[is_hole_held ? "force:rim" : "force:hole"].pressure_MPa =
        LinearValue<double>{{10, 10}};
    return scene;
  }
  Mesh on(Mesh mesh) const {
    if (is_hole_held)
      for (BoundaryEdge& edge : mesh.boundary)
        edge.role =
            edge.role == BoundaryRole::force ? BoundaryRole::displacement : BoundaryRole::force;
    return mesh;
  }
  ExactStress stress() const {
    const double held = is_hole_held ? inner : outer, pressed = is_hole_held ? outer : inner,
                 ratio = (1 - 2 * poisson) * held * held,
                 A = -10 / (1 + ratio / (pressed * pressed)), B = -ratio * A;
    return [=](const Point& x) {
      return testing::from_polar(A - B / x.squaredNorm(), A + B / x.squaredNorm(), 0, x);
    };
  }
};

struct Judged {
  double truth, total, without_geometry;
  bool guaranteed;
};
Judged judged(const Mesh& mesh, int degree, const PressedRing& ring = {}) {
  const testing::Solved solved(ring.scene(), ring.on(mesh), degree);
  const ConstitutiveError error = solved.error();
  EXPECT_EQ(error.flaw, "");
  const double share = 1 - error.geometry_Nmm / error.squared_Nmm();
  return {true_error(*solved.system.problem, solved.hybrid.stress, ring.stress()), error.relative,
          error.relative * std::sqrt(share), error.guaranteed};
}

// Of degree 1 with chords, of others with curves; that e alone says too little is below.
TEST(GeometryError, MakesTheTotalErrorOfRoundBodiesTheirsAndFallsAsChordsGetShorter) {
  for (const bool is_hole_held : {false, true})
    for (const double poisson : {0.3, 0.4999})
      for (int degree = 1; degree <= highest_stress_degree; ++degree) {
        SCOPED_TRACE(::testing::Message() << degree << " " << poisson << " " << is_hole_held);
        const PressedRing ring = {poisson, is_hole_held};
        const Judged coarse = judged(round_ring(20), degree, ring),
                     fine = judged(round_ring(20, 1), degree, ring);
        for (const Judged& own : {coarse, fine}) {
          EXPECT_GT(own.total, own.truth);
          EXPECT_LT(own.total, (poisson < 0.4 ? 3 : 5) * own.truth);
          EXPECT_FALSE(own.guaranteed);
        }
        if (is_hole_held || poisson > 0.4) continue;
        EXPECT_LT(fine.total, coarse.total / 2.3);  // order 1.5: 2.8
        EXPECT_LT(fine.truth, coarse.truth / 2.3);
      }
}

// A mesh that does not know its curves stays a polygon however fine it becomes, and says so.
TEST(GeometryError, OfPolygonsDoesNotVanish) {
  Mesh mesh = small_ring(20, 3, inner, outer);
  const Judged coarse = judged(mesh, 2);
  for (int k = 0; k < 3; ++k) mesh = uniformly_refined(mesh);
  const Judged fine = judged(mesh, 2);
  EXPECT_GT(fine.total, fine.truth);
  EXPECT_GT(fine.total, coarse.total / 2);
  EXPECT_LT(fine.without_geometry, fine.truth / 2);
}

// Two rings of different materials, bonded at a radius of 2 mm (Lamé): their common line is a
// polygon, whose stresses are compared with those of the triangle's own ring.
struct BondedRings {
  static constexpr int around = 20;
  static constexpr double middle = 2, inner_MPa = 20000, outer_MPa = 200000, poisson = 0.3;

  static bool is_inside(const Point& x) {
    const double sector = 2 * std::numbers::pi / around,
                 angle = std::atan2(x.y(), x.x()) + 2 * std::numbers::pi;
    return x.norm() * std::cos(std::fmod(angle, sector) - sector / 2) <
           middle * std::cos(sector / 2);
  }
  static Mesh mesh(int refinements) {
    Mesh mesh = small_ring(around, 4, inner, outer);
    for (int i = 0; i < around; ++i) {  // its third line of vertices
      const double at = 2 * std::numbers::pi * i / around;
      mesh.vertices[5 * i + 2] = middle * Point(std::cos(at), std::sin(at));
    }
    recognise_arcs(mesh);
    for (int k = 0; k < refinements; ++k) mesh = uniformly_refined(mesh);
    mesh.body_names = {"inner", "outer"};
    mesh.triangle_body.clear();
    for (const auto& [a, b, c] : mesh.triangles)
      mesh.triangle_body.push_back(
          is_inside((mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3) ? 0 : 1);
    return mesh;
  }
  static Scene scene(bool are_alike) {
    Scene scene = PressedRing().scene();
    scene.materials["inner"] = {are_alike ? outer_MPa : inner_MPa, poisson};
    scene.materials["outer"] = {outer_MPa, poisson};
    return scene;
  }
  // A and B of both rings: pressure in the hole, σ_rr and u alike at the bond, u = 0 at the rim.
  static ExactStress stress() {
    const double g = 1 - 2 * poisson;
    const double a2 = inner * inner, b2 = middle * middle, c2 = outer * outer;
    Eigen::Matrix4d rows;
    rows << 1, -1 / a2, 0, 0,                                                    //
        1, -1 / b2, -1, 1 / b2,                                                  //
        g / inner_MPa, 1 / b2 / inner_MPa, -g / outer_MPa, -1 / b2 / outer_MPa,  //
        0, 0, g, 1 / c2;
    const Eigen::Vector4d of = rows.partialPivLu().solve(Eigen::Vector4d(-10, 0, 0, 0));
    return [of](const Point& x) {
      const int k = is_inside(x) ? 0 : 2;
      const double r2 = x.squaredNorm();
      return testing::from_polar(of(k) - of(k + 1) / r2, of(k) + of(k + 1) / r2, 0, x);
    };
  }
};

TEST(GeometryError, KnowsOfLinesBetweenMaterialsThatAreTakenForPolygons) {
  for (const int degree : {2, 3})
    for (const int refinements : {0, 1}) {
      SCOPED_TRACE(::testing::Message() << degree << " " << refinements);
      const testing::Solved solved(BondedRings::scene(false), BondedRings::mesh(refinements),
                                   degree);
      const ConstitutiveError error = solved.error();
      const double truth =
          true_error(*solved.system.problem, solved.hybrid.stress, BondedRings::stress());
      EXPECT_GT(error.relative, truth);
      EXPECT_LT(error.relative, 3 * truth);
      if (refinements > 0) {  // all else is known to be less
        const double others = error.squared_Nmm() - error.geometry_Nmm;
        EXPECT_LT(error.relative * std::sqrt(others / error.squared_Nmm()), truth / 2);
      }
      EXPECT_EQ(polygon_groups(*solved.system.problem, degree),
                fmt::format("between inner and outer ({} edges, chords off by up to 0.025 mm)",
                            20 << refinements));
    }
  const testing::Solved alike(BondedRings::scene(true), BondedRings::mesh(0), 2);
  EXPECT_EQ(polygon_groups(*alike.system.problem, 2), "");
  const auto share = [](const testing::Solved& solved) {
    const ConstitutiveError error = solved.error();
    return error.geometry_Nmm / error.squared_Nmm();
  };
  Scene warm = BondedRings::scene(true);  // of one material, of which one ring expands
  warm.materials["inner"].expansion_per_K = 1e-5;
  warm.temperature_K["inner"] = {{100, 100}};
  const testing::Solved solved(warm, BondedRings::mesh(0), 2);
  EXPECT_NE(polygon_groups(*solved.system.problem, 2), "");
  EXPECT_GT(share(solved), 2 * share(alike));
}

TEST(GeometryError, IsZeroOfStraightSides) {
  const testing::Solved solved(Scene(), testing::small_tooth(4, 4), 2);
  EXPECT_EQ(solved.error().geometry_Nmm, 0);
  const GeometryError geometry = geometry_error(*solved.system.problem, solved.hybrid.stress);
  for (const double part : geometry.of_triangle_Nmm) EXPECT_EQ(part, 0);
}

// Under the same pressure all around nothing depends on the direction of the sides.
TEST(GeometryError, IsZeroUnderPressureAllAround) {
  Mesh mesh = testing::with_role(round_ring(20), BoundaryRole::displacement, BoundaryRole::force);
  Scene scene = PressedRing().scene();
  scene.boundary["force:rim"].pressure_MPa = LinearValue<double>{{10, 10}};
  for (BoundaryEdge& edge : mesh.boundary)
    if (boundary_label(mesh, edge) == "force:rim") {
      edge.role = BoundaryRole::displacement;  // something must hold the body: one edge
      edge.group = BoundaryEdge::no_group;
      edge.curve = {};
      break;
    }
  const testing::Solved solved(scene, mesh, 2);
  EXPECT_LT(solved.error().geometry_Nmm, 0.05 * solved.error().squared_Nmm());
}

}  // namespace
}  // namespace airybench::geometry_error_test
