// Bodies in contact with each other: against a rigid wall, and each other.
#include <gtest/gtest.h>

#include <cmath>

#include "solvers/loading/load_steps.hpp"
#include "tests/support/pieces.hpp"
#include "tests/support/solved_scene.hpp"
#include "tests/support/two_blocks.hpp"
#include "verify/contact_intervals.hpp"
#include "verify/verifier.hpp"

namespace airybench::two_bodies_test {
namespace {

using Eigen::Vector2d;
using testing::add_block;
using testing::pressed;
using testing::two_blocks;

const std::vector<std::array<int, 2>> pairs_of_meshes = {{7, 10}, {8, 8}, {5, 13}, {11, 6}};

using Solved = testing::SolvedScene;

// Between rollers, without friction: σ_yy = −δ / Σ h (1 − ν²)/E and nothing else.
TEST(TwoBodies, AConstantStressPassesBetweenMeshesThatDoNotMatch) {
  Scene scene = pressed(0, {0, -0.01});
  for (auto& label :
       {"displacement:floor", "displacement:head", "displacement:base", "displacement:block"}) {
    scene.boundary[label].support = BoundaryValues::Support::normal;
    if (!scene.boundary[label].displacement_mm)
      scene.boundary[label].displacement_mm = scene.boundary["displacement:floor"].displacement_mm;
  }
  const double expected = -0.01 / (6 * (1 - 0.33 * 0.33) / 70000 + 5 * (1 - 0.3 * 0.3) / 210000);
  for (const auto& [lower, upper] : {std::array{13, 17}, {5, 24}, {8, 8}, {29, 3}})
    for (const auto& [names, accuracy] :
         {std::pair("HYBRID,HYBRID:CHOLMOD,P2,3STEPD:REFINED,BLIND:SCHUR:REFINED", 1e-10),
          {"P3,P4,HYBRID:k=2", 1e-9},
          {"HYBRID:k=4", 1e-8},
          {"3STEPD,BLIND:SCHUR,SSKY", 1e-6}})  // S of slivers is ill-conditioned
      for (const Method& method : select_methods(names)) {
        const Solved solved(scene, two_blocks(lower, upper, "displacement"), method.name);
        double off = 0;
        for (std::size_t t = 0; t < solved.solution.stress.size(); ++t) {
          const Eigen::Matrix3Xd stress = solved.solution.stress[t];
          off = std::max(
              off, (stress.colwise() - Eigen::Vector3d(0, expected, 0)).cwiseAbs().maxCoeff());
        }
        EXPECT_LT(off, accuracy * std::abs(expected))
            << method.name << " " << lower << " on " << upper;
      }
}

TEST(TwoBodies, AllMethodsAgree) {
  for (const double friction : {0., 0.3, 1.})
    for (const auto& [lower, upper] : pairs_of_meshes) {
      const Mesh mesh = two_blocks(lower, upper);
      const Scene scene = pressed(friction);
      const Solved hybrid(scene, mesh, "HYBRID");
      const Reference reference = compute_reference(hybrid.system);
      for (const auto& [names, allowed] :
           {std::pair("HYBRID,HYBRID:CHOLMOD,HYBRID:MUMPS,HYBRID:PDAS", 1e-10),
            {"3STEPD:REFINED,BLIND:SCHUR:REFINED", 1e-12},
            {"3STEPD,3STEPD:CHOLMOD,SSKY,BLIND,BLIND:SCHUR,BLIND:SKY", 1e-8},
            {"3STEPCG3,SDTIC3,ALM:AUTO", 1e-6}})
        for (const Method& method : select_methods(names)) {
          const Solved other(scene, mesh, method.name);
          const WorstMeasure worst =
              worst_measure(verify(other.system, other.solution, &reference));
          EXPECT_LT(worst.value, allowed) << method.name << " mu " << friction << worst.name;
          EXPECT_EQ(other.solution.F_C.size(), hybrid.solution.F_C.size());
        }
      for (const int degree : {2, 3}) {
        const Solved higher(scene, mesh, hybrid_of_degree(degree));
        const Reference own = compute_reference(higher.system);
        EXPECT_LT(worst_measure(verify(higher.system, higher.solution, &own)).value, 1e-10);
      }
      const Verification of_hybrid = verify(hybrid.system, hybrid.solution, &reference);
      for (const char* name : {"P2", "P3", "P4"}) {
        const Solved own(scene, mesh, name);
        const Verification seen = verify_displacement(own.system, own.solution);
        EXPECT_LT(worst_measure(seen).value, 1e-12) << name << ", mu " << friction;
        EXPECT_NEAR(*seen.normal_resultant_N / *of_hybrid.normal_resultant_N, 1, 0.03) << name;
      }
    }
}

// An answer whose bodies do not press on each other with the same forces is none.
TEST(TwoBodies, ForcesThatAreNotTransmittedAreSeen) {
  Solved solved(pressed(0.3), two_blocks(7, 10), "HYBRID");
  const Reference reference = compute_reference(solved.system);
  EXPECT_LT(worst_measure(verify(solved.system, solved.solution, &reference)).value, 1e-9);
  solved.solution.F_C(0) *= 1.001;
  EXPECT_GT(worst_measure(verify(solved.system, solved.solution, &reference)).value, 1e-5);
}

TEST(TwoBodies, BoundsHoldAndClose) {
  double lower = -1e300, upper = 1e300, error = 1;
  for (int refined = 0; refined < 3; ++refined) {
    Scene scene = pressed(0);
    scene.mesh.refine = refined;
    for (const int degree : {1, 2}) {
      const Solved solved(scene, two_blocks(4, 5), hybrid_of_degree(degree));
      const ConstitutiveError e = solved.recovered_error();
      EXPECT_TRUE(e.guaranteed) << e.flaw;
      EXPECT_LE(e.lower_bound_Nmm, e.upper_bound_Nmm);
      EXPECT_LE(e.lower_bound_Nmm, upper);
      EXPECT_GE(e.upper_bound_Nmm, lower);
      lower = std::max(lower, e.lower_bound_Nmm);
      upper = std::min(upper, e.upper_bound_Nmm);
      if (degree == 1) {
        EXPECT_LT(e.relative, error);
        error = e.relative;
      }
    }
  }
  EXPECT_LT(upper - lower, 0.02 * std::abs(upper));
}

// The gap to the asperity between their points is not known.
TEST(TwoBodies, NoBoundIsGuaranteedWhereAFaceIsKnownAtPointsOnly) {
  Scene scene = pressed(0);
  scene.boundary["contact:block"].contact.face =
      PolylineWall{{{0, 0}, {5.6, 0}, {5.65, -0.01}, {5.7, 0}, {12, 0}}};
  const ConstitutiveError e = Solved(scene, two_blocks(4, 5), "HYBRID").recovered_error();
  EXPECT_EQ(e.flaw, "");
  EXPECT_FALSE(e.guaranteed);
}

// Guaranteed without friction. The finer mesh and higher degree stand for the exact answer.
TEST(TwoBodies, IntervalsOfTheirResultantsHoldWhatAFinerMeshSays) {
  const auto expect_inside = [](const std::optional<Bracket>& interval, double value) {
    ASSERT_TRUE(interval);
    EXPECT_LE(interval->low, value);
    EXPECT_GE(interval->high, value);
  };
  for (const double friction : {0., 0.3}) {
    Scene scene = pressed(friction);
    scene.mesh.refine = 2;
    const Solved fine(scene, two_blocks(7, 10), "HYBRID:k=2");
    const Verification exact = verify(fine.system, fine.solution, nullptr);
    double widest = std::abs(*exact.normal_resultant_N);
    for (const int degree : {1, 2}) {
      SCOPED_TRACE(::testing::Message() << "degree " << degree << ", friction " << friction);
      scene.mesh.refine = 0;
      const Solved coarse(scene, two_blocks(7, 10), hybrid_of_degree(degree));
      const auto& [F_C, stress] = std::tie(coarse.solution.F_C, coarse.solution.stress);
      const DisplacementField u = recovered_displacement(coarse.system, coarse.solution);
      const std::optional<ContactIntervals> intervals = contact_intervals(
          coarse.system, stress, F_C, u, constitutive_error(coarse.system, stress, F_C, u),
          resultant_lifts(coarse.problem(), degree));
      ASSERT_TRUE(intervals);
      EXPECT_EQ(intervals->guaranteed, friction == 0);
      expect_inside(intervals->normal_resultant_N, *exact.normal_resultant_N);
      const double width = intervals->normal_resultant_N->high - intervals->normal_resultant_N->low;
      EXPECT_LT(width, 0.8 * widest);
      widest = width;
      if (friction > 0)
        expect_inside(intervals->tangential_resultant_N, *exact.tangential_resultant_N);
      EXPECT_EQ(intervals->tangential_resultant_N.has_value(), friction > 0);
    }
  }
}

TEST(TwoBodies, OneThatIsVeryStiffIsARigidWall) {
  const double friction = 0.3;
  Scene scene = pressed(friction);
  scene.materials["base"].young_MPa = 210000e6;
  Mesh block;
  block.name = "block";
  add_block(block, "block", {0, 0}, {12, 5}, 10, 4,
            {"contact:block", "force", "displacement:head", "force"});
  Scene alone;
  alone.friction = friction;
  alone.material = {210000, 0.3};
  alone.wall = FlatWall{{0, 0}, {0, 1}};
  alone.displacement_mm = {0.004, -0.01};
  for (const char* name : {"HYBRID", "HYBRID:k=3", "P2", "P3"}) {
    const Solved both(scene, two_blocks(10, 10), name), one(alone, block, name);
    const double energy = stress_norm_squared(one.problem(), one.solution.stress);
    EXPECT_NEAR(stress_norm_squared(both.problem(), both.solution.stress) / energy, 1, 1e-5)
        << name;
  }
}

TEST(TwoBodies, APathWithSlipDissipatesAsAtAWall) {
  Scene scene = pressed(0.3, {0, -0.01});
  scene.materials["base"].young_MPa = 210000e6;
  Scene alone;
  alone.friction = 0.3;
  alone.material = {210000, 0.3};
  alone.wall = FlatWall{{0, 0}, {0, 1}};
  alone.displacement_mm = {0, -0.01};
  for (const double x : {0.008, -0.008, 0.008}) {
    LoadStep step;
    step.boundary["displacement:head"].displacement_mm =
        LinearValue<Vector2d>{{Vector2d(x, -0.01), Vector2d(x, -0.01)}};
    scene.later_steps.push_back(step);
    LoadStep of_one;
    of_one.displacement_mm = {x, -0.01};
    alone.later_steps.push_back(of_one);
  }
  Mesh block;
  block.name = "block";
  add_block(block, "block", {0, 0}, {12, 5}, 10, 4,
            {"contact:block", "force", "displacement:head", "force"});
  for (const char* name : {"HYBRID", "HYBRID:k=2", "P2", "P3"}) {
    const auto work = [&](const Scene& of, const Mesh& mesh) {
      std::vector<double> works;
      solve_load_steps(select_methods(name).front(), testing::posed(of, mesh), {},
                       [&](int, const ContactSystem& system, const Solution& answer) {
                         EXPECT_EQ(answer.status, Status::ok) << answer.message;
                         works.push_back(dissipation_Nmm(system, answer));
                       });
      return works;
    };
    const std::vector<double> both = work(scene, two_blocks(10, 10)), one = work(alone, block);
    ASSERT_EQ(both.size(), 4);
    for (std::size_t k = 1; k < 4; ++k) {
      // After to and fro HYBRID dissipates 0.1, P2 0.004 N mm: P3 sticks everywhere.
      const bool sticks = name == std::string("P3") && k == 3;
      EXPECT_EQ(one[k] > 1e-3, !sticks) << name;
      EXPECT_NEAR(both[k], one[k], sticks ? 1e-12 : 1e-4 * one[k]) << name << " step " << k;
    }
  }
}

// Without friction the last step is that of one step with its clearance.
TEST(TwoBodies, LoadStepsMayChangeTheClearance) {
  const Mesh mesh = two_blocks(7, 10);
  const auto with_clearance = [](const ContactPair& pair, double clearance_mm) {
    return ContactPair{.between = pair.between, .clearance_mm = clearance_mm};
  };
  Scene path = pressed(0, {0, 0}), tight = pressed(0, {0, 0});
  const ContactPair pair = path.contacts.front();
  path.friction = tight.friction = 0;
  path.contacts = {with_clearance(pair, 0.01)};
  path.later_steps.resize(2);
  path.later_steps[0].contacts = {with_clearance(pair, -0.002)};
  path.later_steps[1].contacts = tight.contacts = {with_clearance(pair, -0.006)};
  const auto resultant_N = [](const ContactSystem& system, const Solution& own) {
    return *verify(system, own, nullptr).normal_resultant_N;
  };
  for (const char* name : {"HYBRID", "HYBRID:k=2", "3STEPD", "P2"}) {
    std::vector<double> pressed_N;
    solve_load_steps(select_methods(name).front(), testing::posed(path, mesh), {},
                     [&](int, const ContactSystem& system, const Solution& own) {
                       ASSERT_EQ(own.status, Status::ok) << name << ": " << own.message;
                       pressed_N.push_back(resultant_N(system, own));
                     });
    const Solved once(tight, mesh, name);
    const double expected = resultant_N(once.system, once.solution);
    ASSERT_EQ(pressed_N.size(), 3u) << name;
    EXPECT_NEAR(pressed_N[0] / expected, 0, 1e-9) << name;
    EXPECT_NEAR(pressed_N[1] / expected, 1. / 3, 1e-6) << name;
    EXPECT_NEAR(pressed_N[2] / expected, 1, 1e-9) << name;
  }
}

// A base that is moved as a whole changes nothing, also where its face ends at a prescribed edge
// and the other one's at a roller.
TEST(TwoBodies, MayBeHeldWhereTheirFacesEnd) {
  const Mesh mesh = two_blocks(7, 10, "displacement");
  const auto energy = [&](double up_mm, const char* name) {
    Scene scene = pressed(0.3, {0, -0.01 + up_mm});
    scene.displacement_mm = {0, up_mm};
    scene.boundary["displacement:floor"].displacement_mm->values.fill({0, up_mm});
    scene.boundary["displacement:block"].support = BoundaryValues::Support::normal;
    return Solved(scene, mesh, name).energy();
  };
  for (const char* name : {"P2", "P3", "HYBRID:k=2"})
    EXPECT_NEAR(energy(0.004, name) / energy(0, name), 1, 1e-9) << name;
}

TEST(TwoBodies, APartThatFacesNothingIsFree) {
  Mesh mesh;
  mesh.name = "ledge";
  add_block(mesh, "base", {0, -6}, {12, 0}, 9, 5,
            {"displacement:floor", "force", "contact:base", "force"});
  add_block(mesh, "block", {3, 0.5}, {8, 5}, 4, 4,
            {"contact:block", "force", "displacement:head", "force"});
  const Solved solved(pressed(0.3, {0, -0.51}), mesh, "HYBRID");
  const Reference reference = compute_reference(solved.system);
  EXPECT_LT(worst_measure(verify(solved.system, solved.solution, &reference)).value, 1e-9);
  double faces = 0;
  for (const BoundaryEdge& edge : solved.problem().mesh.boundary)
    if (boundary_label(solved.problem().mesh, edge) == "contact:base")
      faces += (solved.problem().mesh.vertices[edge.vertices[1]] -
                solved.problem().mesh.vertices[edge.vertices[0]])
                   .norm();
  EXPECT_NEAR(faces, 5, 1e-12);
}

// Each body then moves as a whole, with stresses that are rounding: no error, and no answer either
// where only the mesh is too coarse to see that they touch.
TEST(TwoBodies, ThatDoNotTouchHaveNoStress) {
  const Mesh mesh = two_blocks(8, 8);
  Scene apart = pressed(0, {0, -1e-4});
  apart.contacts.front().clearance_mm = 1e-3;
  Scene crowned = pressed(0, {0, -1e-4});
  crowned.boundary["contact:block"].contact.face =
      CircularWall{{6, 50}, 50, CircularWall::Bodies::inside};
  for (const char* name : {"HYBRID", "HYBRID:k=2"})
    for (const auto& [scene, error_total] : {std::pair(&apart, 0.), {&crowned, 1.}}) {
      const Solved solved(*scene, mesh, name);
      const Reference reference = compute_reference(solved.system);
      EXPECT_TRUE(solved.solution.F_C.isZero(0)) << name;
      const Verification seen = verify(solved.system, solved.solution, &reference);
      EXPECT_LT(worst_measure(seen).value, 1e-9);
      EXPECT_TRUE(seen.unstressed) << name;
      EXPECT_NEAR(solved.recovered_error().relative, error_total, 1e-6) << name;
    }
  // What rounding hides is never called right.
  apart = pressed(0, {0, 1000});
  apart.body_force_N_per_mm3 = {0, -1e-5};
  const Solved hidden(apart, mesh, "HYBRID");
  const Reference reference = compute_reference(hidden.system);
  EXPECT_TRUE(verify(hidden.system, hidden.solution, &reference).unstressed);
}

}  // namespace
}  // namespace airybench::two_bodies_test
