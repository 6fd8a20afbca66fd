// Blocks in constant stress against a flat wall: every method has the closed form to rounding.
//
// In the block's own axes (x across the wall, at x = L; y along it) the stress is (−p, s, τ) and,
// with ε = C σ,
//   u_x = ε_xx (x − L),   u_y = 2 ε_xy (x − L) + ε_yy y + δ
// Stick: δ = 0, ε_yy = 0, |τ| ≤ μ p. Slip: |τ| = μ p, u_y on the wall opposed to it.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <numbers>

#include "assembly/control_points.hpp"
#include "assembly/problem/scene.hpp"
#include "bench/plan/stages.hpp"
#include "tests/support/exact_fields.hpp"
#include "tests/support/method_names.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/solved.hpp"
#include "verify/verifier.hpp"

namespace airybench::constant_stress_test {
namespace {

constexpr double length = 10, pressure = 80, mu = 0.3;  // mm, MPa
const Material material{5000, 0.35};

struct Block {
  const char* what;
  double shear;     // τ, MPa
  double slip;      // δ, mm
  bool free_sides;  // s = 0; else ε_yy = 0
  double turn;      // degrees
  Plane plane;
};

std::vector<Block> blocks() {
  std::vector<Block> all;
  for (const Plane plane : {Plane::strain, Plane::stress})
    for (const double turn : {0., 33., 90., 211.})
      for (const Block& block :
           {Block{"stick", 0.5 * mu * pressure, 0, false, turn, plane},
            Block{"limit", mu * pressure, 0, false, turn, plane},
            Block{"slip", mu * pressure, -0.4, false, turn, plane},
            Block{"slip back", -mu * pressure, 0.4, false, turn, plane},
            Block{"slip of a block that widens", mu * pressure, -0.4, true, turn, plane}})
        all.push_back(block);
  return all;
}

struct Exact {
  Eigen::Matrix2d turn;
  Eigen::Vector3d own_stress, strain;  // in the block's axes
  double slip;

  explicit Exact(const Block& block)
      : turn(Eigen::Rotation2Dd(block.turn * std::numbers::pi / 180).toRotationMatrix()),
        slip(block.slip) {
    const Eigen::Matrix3d c = compliance(material, block.plane);
    const double s = block.free_sides ? 0 : c(1, 0) * pressure / c(1, 1);
    own_stress << -pressure, s, block.shear;
    strain = c * own_stress;
  }
  Eigen::Vector3d stress() const {
    Eigen::Matrix2d own;
    own << own_stress(0), own_stress(2), own_stress(2), own_stress(1);
    const Eigen::Matrix2d turned = turn * own * turn.transpose();
    return {turned(0, 0), turned(1, 1), turned(0, 1)};
  }
  Eigen::Vector2d displacement(const Eigen::Vector2d& x) const {
    const Eigen::Vector2d own = turn.transpose() * x;
    return turn * Eigen::Vector2d(strain(0) * (own.x() - length),
                                  strain(2) * (own.x() - length) + strain(1) * own.y() + slip);
  }
  testing::ExactField field() const {
    return {"constant stress",
            {0, 0},
            [own = *this](const Eigen::Vector2d&) { return own.stress(); },
            [own = *this](const Eigen::Vector2d& x) { return own.displacement(x); }};
  }
};

Scene scene_of(const Block& block, const Exact& exact) {
  Scene scene;
  scene.material = material;
  scene.plane = block.plane;
  scene.friction = mu;
  scene.crown_radius_mm.reset();
  const std::array<Eigen::Vector2d, 2> root = {exact.turn * Eigen::Vector2d(0, 0),
                                               exact.turn * Eigen::Vector2d(0, length)};
  scene.boundary["displacement:root"].displacement_mm = {
      {exact.displacement(root[0]), exact.displacement(root[1])}, root};
  for (const auto& [label, side] : {std::pair("force:top", 1), std::pair("force:bottom", -1)}) {
    const Eigen::Vector2d t =
        traction(exact.stress(), Eigen::Vector2d(exact.turn * Eigen::Vector2d(0, side)));
    scene.boundary[label].traction_MPa = {{t, t}};
  }
  return scene;
}

RunControl control_of(const Method& method) {
  return testing::with_tolerance(method.is_tightened() ? 1e-8 * method.first_tolerance : 1e-10);
}

class ConstantStress : public ::testing::TestWithParam<Method> {
 protected:
  // Iterative methods keep to their own tolerance.
  const double rounding = GetParam().is_iterative() ? 1e-6 : 1e-10;
};

// Of stresses and, if the method has them, displacements; relative.
void expect_exact(const Problem& problem, const testing::ExactField& exact,
                  const Solution& solution, double rounding) {
  EXPECT_LT(testing::stress_deviation(problem, solution.stress, exact), rounding);
  if (const auto* const displacements = solution.as<Displacements>()) {
    EXPECT_LT(testing::displacement_deviation(problem, displacements->w, exact), 0.3 * rounding);
  }
}

TEST_P(ConstantStress, IsExactWhateverTheWallDoes) {
  const Method& method = GetParam();
  for (const Block& block : blocks()) {
    SCOPED_TRACE(::testing::Message() << block.what << " turned by " << block.turn);
    const Exact exact(block);
    const auto problem =
        testing::posed(scene_of(block, exact), testing::small_block(4, 4, block.turn));
    const Solution solution = run(method, *assemble(method, problem), control_of(method));
    ASSERT_EQ(solution.status, Status::ok) << solution.message;
    expect_exact(*problem, exact.field(), solution, rounding);
    Eigen::Vector2d contact = Eigen::Vector2d::Zero();
    for (Eigen::Index i = 0; i < solution.F_C.size(); i += 2) contact += solution.F_C.segment<2>(i);
    EXPECT_LT((contact / length - exact.own_stress(Eigen::Vector2i(0, 2))).cwiseAbs().maxCoeff(),
              rounding * pressure);
  }
}

// The body narrows towards the wall, where it has four edges of 1.5 mm; iterations go as far as
// rounding lets them.
TEST_P(ConstantStress, IsExactOnAToothPointByPoint) {
  const Method& method = GetParam();
  for (const Block& block : {Block{"stick", 0.4 * mu * pressure, 0, false, 0, Plane::stress},
                             Block{"stick back", -0.8 * mu * pressure, 0, false, 0, Plane::stress},
                             Block{"slip", mu * pressure, -0.5, false, 0, Plane::stress},
                             Block{"slip back", -mu * pressure, 0.3, false, 0, Plane::stress}}) {
    SCOPED_TRACE(block.what);
    const Exact exact(block);
    const auto problem = std::make_shared<const Problem>(
        make_problem(testing::small_tooth(5, 4), {compliance(material, Plane::stress)},
                     testing::loads_of(exact.field()), mu));
    const std::unique_ptr<ContactSystem> system = assemble(method, problem);
    const Solution solution = run(method, *system, testing::with_tolerance(1e-13));
    ASSERT_EQ(solution.status, Status::ok) << solution.message;
    expect_exact(*problem, exact.field(), solution, method.is_iterative() ? 1e-9 : 1e-10);
    const ControlPoints control = control_points(*problem, method.degree + 1);
    for (Eigen::Index p = 0; p < solution.F_C.size() / 2; ++p) {
      double weight_mm = 0.75;          // of half an edge
      if (method.in_displacements()) {  // ∫ B: the same part of an edge for each of its nodes
        const bool is_edge = control.node[p] >= static_cast<int>(problem->mesh.vertices.size());
        const bool is_inner =
            !is_edge && std::abs(problem->mesh.vertices[control.node[p]].y()) < 2.9;
        weight_mm = (is_inner ? 3 : 1.5) / (method.degree + 2);
      }
      EXPECT_NEAR(solution.F_C(2 * p), -pressure * weight_mm, 1e-7) << p;
      EXPECT_NEAR(solution.F_C(2 * p + 1), block.shear * weight_mm, 1e-7) << p;
    }
  }
}

// Rollers at the root and the bottom: pressed by d and, on top, by q. Two rollers meet in a corner,
// and the bottom one meets the wall. With friction q is such that nothing slides, ε_yy = 0.
TEST_P(ConstantStress, IsExactBetweenTwoRollersAndAWall) {
  const Method& method = GetParam();
  constexpr double d = 0.03;
  for (const double friction : {0., mu})
    for (const double turn : {0., 33., 211.}) {
      SCOPED_TRACE(turn);
      const Eigen::Matrix3d c = compliance(material, Plane::strain);
      Exact exact({"", 0, 0, false, turn, Plane::strain});
      // ε_xx = −d/L = c_00 σ_xx − c_01 q
      // and 0 = ε_yy = c_01 σ_xx − c_11 q where nothing slides.
      const double stuck = c(0, 1) * d / length / (c(0, 1) * c(0, 1) - c(0, 0) * c(1, 1));
      const double q = friction > 0 ? stuck : 20;
      const double sigma = (-d / length + c(0, 1) * q) / c(0, 0);
      exact.own_stress << sigma, -q, 0;
      exact.strain = c * exact.own_stress;
      Mesh mesh = testing::small_block(4, 4, turn);
      for (BoundaryEdge& edge : mesh.boundary)
        if (boundary_label(mesh, edge) == "force:bottom") edge.role = BoundaryRole::displacement;
      Scene scene;
      scene.material = material;
      scene.friction = friction;
      scene.crown_radius_mm.reset();
      scene.displacement_mm = exact.turn * Eigen::Vector2d(d, 0);
      scene.boundary["displacement:root"].support = BoundaryValues::Support::normal;
      scene.boundary["displacement:bottom"].support = BoundaryValues::Support::normal;
      scene.boundary["force:top"].pressure_MPa = LinearValue<double>{{q, q}};
      const auto problem = testing::posed(scene, mesh);
      const std::unique_ptr<ContactSystem> system = assemble(method, problem);
      if (const auto* airy = dynamic_cast<const AirySystem*>(system.get())) {
        EXPECT_EQ(solved_sizes(problem).n_f, airy->n_f());
      }
      const Solution solution = run(method, *system, control_of(method));
      ASSERT_EQ(solution.status, Status::ok) << solution.message;
      expect_exact(*problem, exact.field(), solution, rounding);
      EXPECT_NEAR(solution.F_C.sum(), sigma * length, rounding * std::abs(sigma) * length);
      EXPECT_LT(verify(*system, solution, nullptr).equilibrium_residual, rounding);
    }
}

// A trapezium between three rollers and a wall without friction, pressed alike from all sides:
// u = −e (x − x_0), x_0 on the wall. Rollers meet the wall and each other at angles of all kinds.
TEST_P(ConstantStress, IsExactBetweenObliqueRollers) {
  const Method& method = GetParam();
  constexpr double e = 1e-3;
  const Eigen::Matrix3d c = compliance(material, Plane::strain);
  const double p = e / (c(0, 0) + c(0, 1));
  const Mesh mesh = testing::with_role(testing::small_tooth(5, 4), BoundaryRole::force,
                                       BoundaryRole::displacement);
  const testing::ExactField exact = {
      "pressed from all sides",
      {0, 0},
      [=](const Eigen::Vector2d&) { return Eigen::Vector3d(-p, -p, 0); },
      [](const Eigen::Vector2d& x) -> Eigen::Vector2d {
        return -e * (x - Eigen::Vector2d(length, 0));
      }};
  Loads loads;
  loads.displacement_mm = testing::loads_of(exact).displacement_mm;
  for (const BoundaryEdge& edge : mesh.boundary)
    loads.rollers.push_back(edge.role == BoundaryRole::displacement);
  const auto problem = std::make_shared<const Problem>(make_problem(mesh, {c}, loads, 0));
  const Solution solution = run(method, *assemble(method, problem), control_of(method));
  ASSERT_EQ(solution.status, Status::ok) << solution.message;
  expect_exact(*problem, exact, solution, rounding);
  if (!method.in_displacements()) {  // P2's forces at the corners act along the rollers
    EXPECT_NEAR(solution.F_C.sum(), -p * 6, 6 * rounding * p);  // the tip is 6 mm high
  }
}

std::vector<Method> all_kinds() {
  std::vector<Method> all = testing::kinds_of_methods();
  for (const Method& method : select_methods("3STEPCG3,SDTIC6,SSKY,P2,P3,P4,ALM"))
    all.push_back(method);
  return all;
}
INSTANTIATE_TEST_SUITE_P(Kinds, ConstantStress, ::testing::ValuesIn(all_kinds()),
                         testing::readable);

}  // namespace
}  // namespace airybench::constant_stress_test
