// Bodies in contact with each other: against a rigid wall, and each other.
#include <gtest/gtest.h>

#include <cmath>

#include "assembly/matched_faces.hpp"
#include "bench/verify/contact_intervals.hpp"
#include "bench/verify/verifier.hpp"
#include "solvers/loading/load_steps.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/pieces.hpp"
#include "tests/support/solved_scene.hpp"

namespace airybench::two_bodies_test {
namespace {

using Eigen::Vector2d;
using testing::add_block;

// One 12 mm wide on another, with so many edges on each face.
Mesh two_blocks(int lower, int upper, const std::string& left = "force") {
  Mesh mesh;
  mesh.name = "blocks";
  const std::string side = left == "force" ? left : left + ":";
  const auto of = [&](const char* body) { return left == "force" ? left : side + body; };
  add_block(mesh, "base", {0, -6}, {12, 0}, lower, 5,
            {"displacement:floor", "force", "contact:base", of("base")});
  add_block(mesh, "block", {0, 0}, {12, 5}, upper, 4,
            {"contact:block", "force", "displacement:head", of("block")});
  validate(mesh);
  return mesh;
}

const std::vector<std::array<int, 2>> pairs_of_meshes = {{7, 10}, {8, 8}, {5, 13}, {11, 6}};

Scene pressed(double friction, const Vector2d& head_mm = {0.004, -0.01}) {
  Scene scene;
  scene.crown_radius_mm.reset();
  scene.materials = {{"base", {70000, 0.33}}, {"block", {210000, 0.3}}};
  scene.contacts = {{.between = {{{"contact:block"}, {"contact:base"}}}, .friction = friction}};
  scene.boundary["displacement:floor"].displacement_mm = LinearValue<Vector2d>{};
  scene.boundary["displacement:floor"].displacement_mm->values.fill({0, 0});
  scene.boundary["displacement:head"].displacement_mm = LinearValue<Vector2d>{{head_mm, head_mm}};
  return scene;
}

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
    for (const auto& [name, accuracy] : {std::pair("HYBRID", 1e-10),
                                         {"HYBRID:CHOLMOD", 1e-10},
                                         {"P2", 1e-10},
                                         {"P3", 1e-9},
                                         {"P4", 1e-9},
                                         {"HYBRID:k=2", 1e-9},
                                         {"HYBRID:k=4", 1e-8},
                                         {"3STEPD:REFINED", 1e-10},
                                         {"BLIND:SCHUR:REFINED", 1e-10},
                                         {"3STEPD", 1e-6},
                                         {"BLIND:SCHUR", 1e-6},
                                         {"SSKY", 1e-6}}) {  // S of slivers is ill-conditioned
      const Solved solved(scene, two_blocks(lower, upper, "displacement"), name);
      double off = 0;
      for (std::size_t t = 0; t < solved.solution.stress.size(); ++t) {
        const Eigen::Matrix3Xd stress = solved.solution.stress[t];
        off = std::max(off,
                       (stress.colwise() - Eigen::Vector3d(0, expected, 0)).cwiseAbs().maxCoeff());
      }
      EXPECT_LT(off, accuracy * std::abs(expected)) << name << " " << lower << " on " << upper;
    }
}

TEST(TwoBodies, AllMethodsAgree) {
  for (const double friction : {0., 0.3, 1.})
    for (const auto& [lower, upper] : pairs_of_meshes) {
      const Mesh mesh = two_blocks(lower, upper);
      const Scene scene = pressed(friction);
      const Solved hybrid(scene, mesh, "HYBRID");
      const Reference reference = compute_reference(hybrid.system);
      for (const auto& [name, allowed] : {std::pair("HYBRID", 1e-10),
                                          {"HYBRID:CHOLMOD", 1e-10},
                                          {"HYBRID:MUMPS", 1e-10},
                                          {"3STEPD:REFINED", 1e-12},
                                          {"BLIND:SCHUR:REFINED", 1e-12},
                                          {"3STEPD", 1e-8},
                                          {"3STEPD:CHOLMOD", 1e-8},
                                          {"SSKY", 1e-8},
                                          {"BLIND", 1e-8},
                                          {"BLIND:SCHUR", 1e-8},
                                          {"BLIND:SKY", 1e-8},
                                          {"3STEPCG3", 1e-6},
                                          {"SDTIC3", 1e-6},
                                          {"ALM:AUTO", 1e-6}}) {
        const Solved other(scene, mesh, name);
        const WorstMeasure worst = worst_measure(verify(other.system, other.solution, &reference));
        EXPECT_LT(worst.value, allowed) << name << " mu " << friction << ": " << worst.name;
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
      const DisplacementField u =
          recovered_displacement(coarse.system, stress, F_C, coarse.solution.edge_moments);
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
                       [&](int, const DualSystem& system, const Solution& answer) {
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
  const auto resultant_N = [](const DualSystem& system, const Solution& own) {
    const Verification seen = own.displacement.cols() > 0 ? verify_displacement(system, own)
                                                          : verify(system, own, nullptr);
    return *seen.normal_resultant_N;
  };
  for (const char* name : {"HYBRID", "HYBRID:k=2", "3STEPD", "P2"}) {
    std::vector<double> pressed_N;
    solve_load_steps(select_methods(name).front(), testing::posed(path, mesh), {},
                     [&](int, const DualSystem& system, const Solution& own) {
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

TEST(TwoBodies, FacesMatchOneToOneWithSomeVerticesMoved) {
  const MatchedFaces matched = with_matched_faces(two_blocks(13, 17), pressed(0.3));
  const auto& [inserted, moved] = matched.changes;
  EXPECT_EQ(inserted + 2 * moved, 12 + 16);
  EXPECT_GT(moved, 0);
  EXPECT_NO_THROW(validate(matched.mesh));
  int pairs = 0;
  for (std::size_t row = 0; row < matched.edges.size(); ++row)
    if (const auto& edge = matched.edges[row]) {
      const auto& [a, b] = matched.mesh.boundary[row].vertices;
      const auto& [c, d] = matched.mesh.boundary[static_cast<std::size_t>(edge->opposite)].vertices;
      EXPECT_EQ(matched.edges[static_cast<std::size_t>(edge->opposite)]->opposite,
                static_cast<int>(row));
      EXPECT_LT((matched.mesh.vertices[a] - matched.mesh.vertices[d]).norm(), 1e-12);
      EXPECT_LT((matched.mesh.vertices[b] - matched.mesh.vertices[c]).norm(), 1e-12);
      ++pairs;
    }
  EXPECT_EQ(pairs, 2 * (13 + 17 - 1 - moved));
  const MatchedFaces again = with_matched_faces(matched.mesh, pressed(0.3));
  EXPECT_EQ(again.changes.inserted + again.changes.moved, 0);
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
      EXPECT_LT(worst_measure(verify(solved.system, solved.solution, &reference)).value, 1e-9);
      EXPECT_NEAR(solved.recovered_error().relative, error_total, 1e-6) << name;
    }
}

TEST(TwoBodies, WhatCannotBeIsRefusedInALine) {
  const Mesh mesh = two_blocks(7, 10);
  const auto complaint = [&](const auto& change) {
    Scene scene = pressed(0.3);
    change(scene);
    return testing::complaint_of<SceneError>([&] { pose(scene, mesh); });
  };
  EXPECT_EQ(
      complaint([](Scene& s) { s.contacts[0].between[1] = {"contact:bse"}; }),
      "default scene: contacts: between: contact:bse is no contact group of the mesh blocks (its "
      "contact groups: contact:base, contact:block)");
  EXPECT_EQ(
      complaint([](Scene& s) { s.contacts.push_back(s.contacts[0]); }),
      "default scene: contacts: between: contact:block again (allowed: every group in one pair)");
  EXPECT_EQ(
      complaint([](Scene& s) { s.contacts.clear(); }),
      "default scene: mesh blocks: 2 separate pieces, the piece at the vertex [0, 0] presses on no "
      "other (allowed: one piece, or pieces that contacts join; in Gmsh, Coherence or "
      "BooleanFragments joins surfaces that touch)");
  EXPECT_EQ(complaint([](Scene& s) { s.contacts[0].clearance_mm = -INFINITY; }),
            "default scene: contacts: clearance_mm: -inf (allowed: finite numbers)");
  EXPECT_EQ(complaint([](Scene& s) { s.boundary["contact:base"].contact.friction = 0.1; }),
            "default scene: boundary: contact:base: friction of a group in contacts (allowed: "
            "face; friction "
            "and clearance_mm of the pair)");
  EXPECT_EQ(complaint([](Scene& s) {
              s.later_steps.resize(1);
              s.later_steps[0].boundary["contact:base"].contact.clearance_mm = 0.1;
            }),
            "default scene: load_steps: 1: boundary: contact:base: clearance_mm of a group in "
            "contacts (allowed: clearance_mm of the pair, in contacts)");
  EXPECT_TRUE(
      complaint([](Scene& s) {
        s.later_steps.resize(1);
        s.later_steps[0].contacts = {{.between = s.contacts[0].between, .clearance_mm = -2}};
      })
          .starts_with("default scene: contacts: contact:block and contact:base: overlap by: "
                       "2 mm at [0, 0] (allowed: up to a tenth of the mesh's size, "));
  const auto of_step = [&](const auto& change) {
    return complaint([&](Scene& s) {
      s.later_steps.resize(1);
      s.later_steps[0].contacts = {{.between = s.contacts[0].between, .clearance_mm = 0.1}};
      change(s.later_steps[0].contacts[0]);
    });
  };
  EXPECT_EQ(of_step([](ContactPair& pair) { std::swap(pair.between[0], pair.between[1]); }),
            "default scene: load_steps: 1: contacts: between: contact:base and contact:block "
            "(allowed: as in contacts of the scene)");
  for (const auto& change : {+[](ContactPair& pair) { pair.friction = 0.1; },
                             +[](ContactPair& pair) { pair.clearance_mm.reset(); }})
    EXPECT_EQ(of_step(change),
              "default scene: load_steps: 1: contacts: contact:block and contact:base (allowed: "
              "clearance_mm, and no friction)");
  EXPECT_EQ(complaint([](Scene& s) {
              s.later_steps.resize(1);
              s.later_steps[0].contacts.resize(
                  2, {.between = s.contacts[0].between, .clearance_mm = 0.1});
            }),
            "default scene: load_steps: 1: contacts: between: contact:block and contact:base twice "
            "(allowed: every pair once)");
  EXPECT_EQ(of_step([](ContactPair& pair) { pair.clearance_mm = NAN; }),
            "default scene: load_steps: 1: contacts: clearance_mm: nan (allowed: finite numbers)");
}

// The place would belong to two contact points.
TEST(TwoBodies, FacesThatMeetAPlaceTwiceAreRefused) {
  Scene scene = pressed(0.3);
  scene.materials = {{"base", {70000, 0.33}}, {"left", {210000, 0.3}}, {"right", {210000, 0.3}}};
  scene.contacts[0].between[0] = {"contact:left", "contact:right"};
  const auto side_by_side = [&](int base, double gap_mm) {
    Mesh mesh;
    mesh.name = "side by side";
    add_block(mesh, "base", {0, -6}, {12, 0}, base, 5,
              {"displacement:floor", "force", "contact:base", "force"});
    add_block(mesh, "left", {1, 0}, {6, 5}, 4, 4,
              {"contact:left", "force", "displacement:head", "force"});
    add_block(mesh, "right", {6 + gap_mm, 0}, {11, 5}, 5, 4,
              {"contact:right", "force", "displacement:head", "force"});
    return testing::complaint_of<SceneError>([&] { pose(scene, mesh); });
  };
  for (const int base : {12, 7}) {  // at a vertex of the base, and inside an edge
    EXPECT_EQ(side_by_side(base, 0.1), "no complaint") << base;
    EXPECT_EQ(
        side_by_side(base, 0),
        "default scene: contacts: contact:left, contact:right and contact:base: meet twice at "
        "[6, 0] (allowed: faces of which one place, at most, lies in front of another: no "
        "steps or folds, and bodies side by side with a gap)")
        << base;
  }
}

TEST(TwoBodies, TheCurveOfAPairedFaceIsWhereItsEdgesAre) {
  Scene scene = pressed(0.3);
  const auto lowered_by = [&](double mm) {
    scene.boundary["contact:base"].contact.face =
        CircularWall{{6, -400 - mm}, 400, CircularWall::Bodies::inside};
    return testing::complaint_of<SceneError>([&] { pose(scene, two_blocks(8, 8)); });
  };
  EXPECT_EQ(lowered_by(0), "no complaint");
  EXPECT_TRUE(lowered_by(3).starts_with("default scene: contact:base: face: is 3.0"))
      << lowered_by(3);
}

// It leaves the group, whose name the scene may still have.
TEST(TwoBodies, AGroupThatFacesNothingMayHaveValues) {
  Scene scene = pressed(0.3);
  scene.contacts[0].between[1] = {"contact:base", "contact:side"};
  scene.boundary["contact:side"] = {};
  Mesh mesh;
  mesh.name = "blocks";
  add_block(mesh, "base", {0, -6}, {12, 0}, 8, 5,
            {"displacement:floor", "force", "contact:base", "contact:side"});
  add_block(mesh, "block", {0, 0}, {12, 5}, 8, 4,
            {"contact:block", "force", "displacement:head", "force"});
  EXPECT_EQ(testing::complaint_of<SceneError>([&] { pose(scene, mesh); }), "no complaint");
  scene.boundary["contact:sied"] = {};
  EXPECT_EQ(testing::complaint_of<SceneError>([&] { pose(scene, mesh); }),
            "default scene: boundary: contact:sied: no such group in the mesh blocks (its groups: "
            "contact:base, contact:block, contact:side, displacement:floor, displacement:head, "
            "force)");
}

}  // namespace
}  // namespace airybench::two_bodies_test
