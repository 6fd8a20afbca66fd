// Bodies that contact alone holds: equilibrium, agreement of methods, and what is not held.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "assembly/problem/pose.hpp"
#include "assembly/total_displacement.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/pieces.hpp"
#include "tests/support/solved_scene.hpp"
#include "verify/verifier.hpp"

namespace airybench::free_bodies_test {
namespace {

using Eigen::Vector2d;
using testing::add_block;
using Solved = testing::SolvedScene;

LinearValue<Vector2d> everywhere(const Vector2d& value) { return {{value, value}}; }

// A disc of so many sectors, narrower below and above, and rings around a fan; there its rim is
// contact.
void add_disc(Mesh& mesh, const std::string& body, const Vector2d& centre, double radius_mm,
              int around, int rings) {
  const int middle = static_cast<int>(mesh.vertices.size());
  const auto angle = [&](double i) {
    const double even = 2 * std::numbers::pi * i / around;
    return even + 0.4 * std::sin(2 * even);
  };
  const auto vertex = [&](int i, int j) { return middle + 1 + (i % around) * rings + j; };
  mesh.vertices.push_back(centre);
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < rings; ++j) {
      const double r = radius_mm * (j + 1) / rings;
      mesh.vertices.push_back(centre + r * Vector2d(std::cos(angle(i)), std::sin(angle(i))));
    }
  for (int i = 0; i < around; ++i) {
    mesh.triangles.push_back({middle, vertex(i, 0), vertex(i + 1, 0)});
    for (int j = 0; j + 1 < rings; ++j) {
      mesh.triangles.push_back({vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1)});
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i + 1, j)});
    }
    const double height = std::sin(angle(i + 0.5));
    testing::add_edge(mesh, vertex(i, rings - 1), vertex(i + 1, rings - 1),
                      height < -0.95  ? "contact:" + body + "_below"
                      : height > 0.95 ? "contact:" + body + "_above"
                                      : "force");
  }
  testing::name_body(mesh, body);
}

constexpr double radius = 6, down = -0.2;

Mesh roller_between_plates() {
  Mesh mesh;
  mesh.name = "roller";
  add_block(mesh, "floor", {-8, -5}, {8, 0}, 13, 4,
            {"displacement:floor", "force", "contact:floor", "force"});
  add_disc(mesh, "roller", {0, radius}, radius, 48, 7);
  add_block(mesh, "plate", {-8, 2 * radius}, {8, 2 * radius + 4}, 16, 4,
            {"contact:plate", "force", "displacement:plate", "force"});
  return mesh;
}

Scene pressed_roller(double friction, const Vector2d& plate_mm) {
  Scene scene;
  scene.crown_radius_mm.reset();
  scene.materials = {{"floor", {70000, 0.33}}, {"roller", {210000, 0.3}}, {"plate", {150000, 0.3}}};
  scene.contacts = {
      {.between = {{{"contact:roller_below"}, {"contact:floor"}}}, .friction = friction},
      {.between = {{{"contact:roller_above"}, {"contact:plate"}}}, .friction = friction}};
  for (const char* side : {"contact:roller_below", "contact:roller_above"})
    scene.boundary[side].contact.face =
        CircularWall{{0, radius}, radius, CircularWall::Bodies::inside};
  scene.boundary["displacement:floor"].displacement_mm = everywhere({0, 0});
  scene.boundary["displacement:plate"].displacement_mm = everywhere(plate_mm);
  return scene;
}

// The lowest block is held, the others lie on one another.
Mesh pile(int rows_in_middle = 4) {
  Mesh mesh;
  mesh.name = "pile";
  add_block(mesh, "low", {0, -6}, {20, 0}, 11, 4,
            {"displacement:floor", "force", "contact:low", "force"});
  add_block(mesh, "middle", {2, 0}, {16, 5}, 9, rows_in_middle,
            {"contact:middle_below", "force", "contact:middle_above", "force"});
  add_block(mesh, "high", {4, 5}, {11, 9}, 6, 4, {"contact:high", "force", "force:top", "force"});
  return mesh;
}

constexpr double pressure = 50, weight = 0.8;

Scene loaded_pile(double friction) {
  Scene scene;
  scene.crown_radius_mm.reset();
  scene.contacts = {
      {.between = {{{"contact:middle_below"}, {"contact:low"}}}, .friction = friction},
      {.between = {{{"contact:high"}, {"contact:middle_above"}}}, .friction = friction}};
  scene.displacement_mm = {0, 0};
  scene.boundary["force:top"].pressure_MPa = LinearValue<double>{{pressure, pressure}};
  scene.body_force_N_per_mm3 = {0, -weight};
  return scene;
}

// The sum of forces on the contact edges of a group, N.
Vector2d resultant(const Solved& solved, const std::string& label) {
  const Problem& problem = solved.problem();
  const ContactPoints& contact = solved.system.contact;
  Vector2d sum = Vector2d::Zero();
  for (int p = 0; p < contact.count; ++p) {
    const int row = contact.boundary[p];
    if (boundary_label(problem.mesh, problem.mesh.boundary[row]) != label) continue;
    const EdgeFrame frame =
        problem.frame_of_moment(row, contact.per_edge - 1, p % contact.per_edge);
    sum += solved.solution.F_C(contact.components * p) * frame.normal;
    if (contact.components == 2) sum += solved.solution.F_C(2 * p + 1) * frame.tangent;
  }
  return sum;
}

void expect_methods_agree(const Scene& scene, const Mesh& mesh) {
  const Solved hybrid(scene, mesh, "HYBRID");
  const Reference reference = compute_reference(hybrid.system);
  for (const char* name :
       {"HYBRID", "HYBRID:CHOLMOD", "HYBRID:MUMPS", "3STEPD", "3STEPD:REFINED", "3STEPD:CHOLMOD",
        "3STEPCG3", "SSKY", "BLIND", "BLIND:SCHUR", "BLIND:SCHUR:REFINED", "BLIND:SKY"}) {
    const Solved other(scene, mesh, name);
    const WorstMeasure worst = worst_measure(verify(other.system, other.solution, &reference));
    EXPECT_LT(worst.value, 1e-6) << name << ": " << worst.name;
  }
  double pressed = 0;  // by stresses of degree 3
  for (const int degree : {2, 3}) {
    const Solved higher(scene, mesh, hybrid_of_degree(degree));
    const Reference own = compute_reference(higher.system);
    const Verification seen = verify(higher.system, higher.solution, &own);
    EXPECT_LT(worst_measure(seen).value, 1e-8)
        << "degree " << degree << ": " << worst_measure(seen).name;
    pressed = *seen.normal_resultant_N;
  }
  for (const char* name : {"P2", "P3", "P4"}) {
    const Solved own(scene, mesh, name);
    const Verification seen = verify_displacement(own.system, own.solution);
    EXPECT_LT(worst_measure(seen).value, 1e-8) << name << ": " << worst_measure(seen).name;
    EXPECT_NEAR(*seen.normal_resultant_N / pressed, 1, 0.03) << name;
  }
}

TEST(FreeBodies, AllMethodsAgreeOnARoller) {
  for (const double friction : {0., 0.3})
    expect_methods_agree(pressed_roller(friction, {0, down}), roller_between_plates());
}

TEST(FreeBodies, AllMethodsAgreeOnAPile) {
  for (const double friction : {0., 0.3}) expect_methods_agree(loaded_pile(friction), pile());
}

// All its vertices are on contact faces.
TEST(FreeBodies, AllMethodsAgreeOnAStripOneElementHigh) {
  for (const double friction : {0., 0.3}) expect_methods_agree(loaded_pile(friction), pile(1));
}

TEST(FreeBodies, WherePinsAreDoesNotMatter) {
  for (const double friction : {0., 0.3}) {
    const auto problem = testing::posed(loaded_pile(friction), pile());
    const Mesh& mesh = problem->mesh;
    const auto piece = [&](int row) {
      return problem->free.piece_of_vertex[mesh.boundary[row].vertices[0]];
    };
    Problem elsewhere = *problem;
    for (Pin& pin : elsewhere.free.pins) {
      const int own = piece(pin.row), rows = static_cast<int>(mesh.boundary.size());
      do pin.row = (pin.row + 1) % rows;
      while (piece(pin.row) != own || mesh.boundary[pin.row].role != BoundaryRole::force);
    }
    for (const char* name : {"HYBRID", "HYBRID:k=2", "P2", "BLIND:SCHUR:REFINED"}) {
      const Method method = select_methods(name).front();
      const auto solved = [&](const Problem& of) {
        return solve_load_case(method.solve, *assemble(method, std::make_shared<const Problem>(of)),
                               {});
      };
      const Solution here = solved(*problem), there = solved(elsewhere);
      EXPECT_EQ(there.status, Status::ok) << name << ": " << there.message;
      EXPECT_LT(testing::stress_error(*problem, there, here), 1e-8) << name;
      EXPECT_GT((there.free_motion_mm - here.free_motion_mm).norm(), 1e-6) << name;
    }
  }
}

// The reference finds the motion by itself, and has no unbalanced force.
TEST(FreeBodies, TheReferenceFindsTheMotion) {
  const auto problem = testing::posed(pressed_roller(0.3, {0.08, down}), roller_between_plates());
  ContactSystem system = contact_system(problem);
  const Reference reference = compute_reference(system);
  EXPECT_LT(reference.error_estimate, 1e-12);
  system.set_load_case(
      std::make_shared<const Problem>(with_free_motion(*problem, reference.free_motion_mm)));
  Solution answer;
  answer.F_C = reference.F_C;
  answer.stress = reference.stress;
  EXPECT_LT(worst_measure(verify(system, answer, &reference)).value, 1e-10);
}

TEST(FreeBodies, MethodsWithoutDRefuseThem) {
  for (const char* name : {"ALM:AUTO", "ALM:r=20,rho=20", "HYBRID:CG"}) {
    const Method method = select_methods(name).front();
    const Solution solution =
        run(method, *assemble(method, testing::posed(loaded_pile(0.3), pile())), {});
    EXPECT_EQ(solution.status, Status::breakdown) << name;
    EXPECT_NE(solution.message.find("is held by contact alone"), std::string::npos)
        << name << ": " << solution.message;
  }
}

TEST(FreeBodies, EachFaceCarriesWhatLiesAboveIt) {
  for (const double friction : {0., 0.3})
    for (const char* name : {"HYBRID", "HYBRID:k=3", "BLIND:SCHUR"}) {
      const Solved solved(loaded_pile(friction), pile(), name);
      const double on_high = 7 * pressure + 7 * 4 * weight, on_middle = on_high + 14 * 5 * weight;
      const double accuracy = name == std::string("BLIND:SCHUR") ? 1e-6 : 1e-9;
      EXPECT_LT((resultant(solved, "contact:high") - Vector2d(0, on_high)).norm(),
                accuracy * on_high);
      EXPECT_LT((resultant(solved, "contact:middle_below") - Vector2d(0, on_middle)).norm(),
                accuracy * on_high);
    }
}

// It is pressed in the middle of both, and rolls by half of what the plate moves.
TEST(FreeBodies, ARollerRollsBetweenItsPlates) {
  for (const char* name : {"HYBRID:k=2", "P3"}) {
    const Solved pressed(pressed_roller(0.3, {0, down}), roller_between_plates(), name),
        rolled(pressed_roller(0.3, {0.04, down}), roller_between_plates(), name);
    const auto centre = [](const Solved& solved) {
      const Problem& problem = solved.problem();
      const Mesh& mesh = problem.mesh;
      const auto v = std::ranges::find(mesh.vertices, Vector2d(0, radius)) - mesh.vertices.begin();
      const auto w = displacement_of_answer(solved.system, solved.solution);
      return Vector2d(with_rigid_motion(problem, w.value()).col(v));
    };
    EXPECT_NEAR(centre(pressed).x(), 0, 2e-3) << name;
    EXPECT_NEAR(centre(rolled).x() - centre(pressed).x(), 0.02, 1e-3) << name;
    EXPECT_NEAR(centre(rolled).y(), centre(pressed).y(), 2e-3) << name;
    EXPECT_LT(centre(rolled).y(), -0.08) << name;
  }
}

TEST(FreeBodies, BoundsHoldAndClose) {
  double lower = -1e300, upper = 1e300;
  for (int refined = 0; refined < 2; ++refined) {
    Scene scene = loaded_pile(0);
    scene.mesh.refine = refined;
    for (const int degree : {1, 2}) {
      const ConstitutiveError e = Solved(scene, pile(), hybrid_of_degree(degree)).recovered_error();
      EXPECT_EQ(e.flaw, "");
      EXPECT_TRUE(e.guaranteed);
      EXPECT_LT(e.lower_bound_Nmm, e.upper_bound_Nmm);
      lower = std::max(lower, e.lower_bound_Nmm);
      upper = std::min(upper, e.upper_bound_Nmm);
    }
  }
  EXPECT_LT(lower, upper);
  EXPECT_LT(upper - lower, 0.05 * std::abs(upper));
}

// Labels: below, right, above and left.
Mesh lone_block(const testing::Sides& sides) {
  Mesh mesh;
  mesh.name = "block";
  add_block(mesh, "block", {0, 0}, {12, 5}, 10, 4, sides);
  return mesh;
}

// Parallel rollers leave one motion, and the wall takes it.
TEST(FreeBodies, AWallHoldsWhatRollersLeaveFree) {
  const Mesh block = lone_block({"contact", "force", "force:top", "displacement"});
  Scene scene;
  scene.wall = FlatWall{{0, 0}, {0, 1}};
  scene.displacement_mm = {0, 0};
  scene.boundary["displacement"].support = BoundaryValues::Support::normal;
  scene.boundary["force:top"].pressure_MPa = LinearValue<double>{{pressure, pressure}};
  for (const double friction : {0., 0.2}) {
    scene.friction = friction;
    for (const char* name : {"HYBRID", "HYBRID:k=2", "3STEPD", "BLIND:SCHUR"})
      EXPECT_NEAR(resultant(Solved(scene, block, name), "contact").y() / (12 * pressure), 1, 1e-8)
          << name;
    const Solved p2(scene, block, "P2");
    EXPECT_LT(worst_measure(verify_displacement(p2.system, p2.solution)).value, 1e-8);
  }
}

// No displacement is prescribed anywhere: a wall and friction carry pressure and shear.
TEST(FreeBodies, OneMayLieOnAWallAlone) {
  const Mesh block = lone_block({"contact", "force", "force:top", "force"});
  validate(block);
  Scene scene;
  scene.wall = FlatWall{{0, 0}, {0, 1}};
  scene.friction = 0.3;
  const Vector2d load(10, -pressure);
  scene.boundary["force:top"].traction_MPa = everywhere(load);
  const Solved hybrid(scene, block, "HYBRID");
  const Reference reference = compute_reference(hybrid.system);
  for (const char* name : {"HYBRID", "HYBRID:MUMPS", "3STEPD", "3STEPCG3", "SSKY", "BLIND:SCHUR"}) {
    const Solved own(scene, block, name);
    EXPECT_LT((resultant(own, "contact") + 12 * load).norm(), 1e-6 * 12 * pressure) << name;
    EXPECT_LT(worst_measure(verify(own.system, own.solution, &reference)).value, 1e-6) << name;
  }
  EXPECT_EQ(hybrid.recovered_error().flaw, "");
  for (const char* name : {"P2", "P3"}) {
    const Solved own(scene, block, name);
    EXPECT_LT(worst_measure(verify_displacement(own.system, own.solution)).value, 1e-8) << name;
  }
}

// A contact law that is not solved yet says nothing of what holds a body; a load that friction does
// not take is named, however small.
TEST(FreeBodies, OnlyASolvedContactLawTellsThatNothingHolds) {
  const Mesh block = lone_block({"contact", "force", "force:top", "force"});
  Scene scene;
  scene.wall = FlatWall{{0, 0}, {0, 1}};
  scene.friction = 0;
  const auto solved = [&](double along, const ContactOptions& contact) {
    scene.boundary["force:top"].traction_MPa = everywhere({along, -10});
    const Method hybrid = select_methods("HYBRID").front();
    RunControl control;
    control.contact = contact;
    return solve_load_case(hybrid.solve, *assemble(hybrid, testing::posed(scene, block)), control);
  };
  ContactOptions one_sweep;
  one_sweep.solver = ContactSolver::gauss_seidel;
  one_sweep.max_iterations = 1;
  const Solution early = solved(0, one_sweep);
  EXPECT_EQ(early.status, Status::not_converged) << early.message;
  for (const auto& [along, left] : {std::pair(1e-7, "1.2e-06"), {1e-2, "0.12"}}) {
    const Solution pushed = solved(along, {});
    EXPECT_EQ(pushed.status, Status::breakdown);
    testing::expect_named(pushed.message, {"the body block: it slides along (1, 0)",
                                           "with " + std::string(left) + " N of"});
  }
}

std::string why_not(const Scene& scene, const Mesh& mesh, const char* name) {
  const Method method = select_methods(name).front();
  const Solution solution =
      solve_load_case(method.solve, *assemble(method, testing::posed(scene, mesh)), {});
  EXPECT_EQ(solution.status, Status::breakdown) << name;
  EXPECT_EQ(solution.free_motion_mm.size(), 0);
  return solution.message;
}

TEST(FreeBodies, WhatNothingHoldsIsNamedWithItsDirection) {
  for (const char* name : {"HYBRID", "3STEPD", "P2"}) {
    Scene lifted = loaded_pile(0.3);
    lifted.boundary["force:top"].pressure_MPa->values.fill(-pressure);
    testing::expect_named(why_not(lifted, pile(), name),
                          {"the body high: it leaves contact along (0, 1)", "with 328 N of"});
    for (const auto& [friction, left] : {std::pair(0., "210"), {0.3, "98.3"}}) {
      Scene pushed = loaded_pile(friction);
      pushed.boundary["force:top"].pressure_MPa.reset();
      pushed.boundary["force:top"].traction_MPa = everywhere({-30, -pressure});
      testing::expect_named(
          why_not(pushed, pile(), name),
          {"the body high: it slides along (-1, 0)", "with " + std::string(left) + " N of"});
    }
  }
}

TEST(FreeBodies, APathIsWalkedInSteps) {
  Scene scene = pressed_roller(0.3, {0, down});
  for (const double x : {0.06, -0.06}) {
    LoadStep step;
    step.boundary["displacement:plate"].displacement_mm = everywhere({x, down});
    scene.later_steps.push_back(step);
  }
  const auto problem = testing::posed(scene, roller_between_plates());
  for (const char* name : {"HYBRID", "3STEPD", "BLIND:SCHUR", "P2", "P3"}) {
    int steps = 0;
    solve_load_steps(select_methods(name).front(), problem, {},
                     [&](int step, const ContactSystem& system, const Solution& answer) {
                       ASSERT_EQ(answer.status, Status::ok) << name << ": " << answer.message;
                       EXPECT_EQ(answer.free_motion_mm.size(), 3);
                       EXPECT_GE(dissipation_Nmm(system, answer), -1e-9);
                       if (answer.as<Displacements>()) {
                         const Verification seen = verify(system, answer, nullptr);
                         EXPECT_LT(worst_measure(seen).value, 1e-8) << name << " step " << step;
                       } else {
                         const Reference reference = compute_reference(system, answer.F_C);
                         const Verification seen = verify(system, answer, &reference);
                         EXPECT_LT(worst_measure(seen).value, 1e-6) << name << " step " << step;
                       }
                       ++steps;
                     });
    EXPECT_EQ(steps, 3);
  }
}

TEST(FreeBodies, OneThatIsInContactAllAroundIsRefused) {
  const Mesh block = lone_block({"contact", "contact", "contact", "displacement"});
  Scene scene;
  scene.wall = PolylineWall{{{0, 0}, {12, 0}, {12, 5}, {0, 5}}};
  scene.boundary["displacement"].support = BoundaryValues::Support::normal;
  testing::expect_named(testing::complaint_of<SceneError>([&] { pose(scene, block); }),
                        {"mesh block: the body block needs two force edges"});
}

}  // namespace
}  // namespace airybench::free_bodies_test
