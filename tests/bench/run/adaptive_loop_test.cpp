// The adaptive loop: what it reaches, how fast the error falls, and how it ends when it cannot.
#include "bench/run/adaptive_loop.hpp"
#include "assembly/problem/pose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "mesh/arcs.hpp"
#include "mesh/quality.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/places.hpp"
#include "tests/support/small_meshes.hpp"
#include "tests/verify/solved_body.hpp"

namespace airybench::adaptive_loop_test {
namespace {

Method hybrid() { return select_methods("HYBRID").front(); }

AdaptiveSettings until(std::optional<double> error, std::optional<int> unknowns = {}) {
  AdaptiveSettings settings;
  settings.goals = {{error, unknowns}};
  return settings;
}

std::vector<AdaptiveLevel> levels_of(AdaptiveLoop& loop) {
  std::vector<AdaptiveLevel> levels;
  while (auto level = loop.next()) levels.push_back(std::move(*level));
  return levels;
}

TEST(AdaptiveLoop, EndsAtTheFirstLevelBelowTheError) {
  const Mesh mesh = testing::small_tooth(6, 5);
  AdaptiveLoop loop({}, mesh, hybrid(), until(0.02));
  const std::vector<AdaptiveLevel> levels = levels_of(loop);
  EXPECT_TRUE(loop.reached());
  EXPECT_EQ(loop.why_ended(), "");
  ASSERT_GT(levels.size(), 2u);
  EXPECT_EQ(levels.front().mesh.triangles, mesh.triangles);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const AdaptiveLevel& level = levels[k];
    EXPECT_EQ(level.number, static_cast<int>(k));
    EXPECT_EQ(*level.error <= 0.02, k + 1 == levels.size());
    EXPECT_EQ(level.unknowns, mesh_sizes(level.mesh).n_phi);
    EXPECT_GE(mesh_quality(level.mesh).smallest_angle_deg,
              0.5 * mesh_quality(levels.front().mesh).smallest_angle_deg);
    testing::expect_same_body(level.mesh, mesh);
    if (k > 0) {
      EXPECT_GT(level.unknowns, levels[k - 1].unknowns);
      EXPECT_GT(level.time_s, levels[k - 1].time_s);
    }
  }
}

TEST(AdaptiveLoop, SeveralGoalsAreReachedOneAfterTheOther) {
  AdaptiveSettings settings = until(0.03);
  settings.goals.push_back({0.01, {}});
  settings.goals.push_back({{}, 5000});
  AdaptiveLoop loop({}, testing::small_tooth(6, 5), hybrid(), settings);
  const std::vector<AdaptiveLevel> levels = levels_of(loop);
  EXPECT_TRUE(loop.reached());
  std::vector<AdaptiveLevel> reaching;
  for (const AdaptiveLevel& level : levels) {
    EXPECT_EQ(level.unknowns >= 5000, level.number == levels.back().number);
    if (level.goal) reaching.push_back(level);
  }
  ASSERT_EQ(reaching.size(), 3u);
  EXPECT_LE(*reaching[0].error, 0.03);
  EXPECT_GT(*reaching[0].error, 0.01);
  EXPECT_LE(*reaching[1].error, 0.01);
  EXPECT_EQ(reaching[2].number, levels.back().number);
}

// By expectation there are fewer levels than with bulk marking, and the meshes are as good.
// A ring under pressure from within, whose energy the first mesh has.
TEST(AdaptiveLoop, RefinesUntilTheLargestStressIsKnown) {
  constexpr double pressure = 10, inner = 1, outer = 4, of_stress = 0.01;
  Mesh mesh = testing::quarter_ring(4, 3, inner, outer);
  EXPECT_EQ(recognise_arcs(mesh), 8);
  Scene scene;
  scene.displacement_mm = {0, 0};
  for (const char* side : {"displacement:bottom", "displacement:left"})
    scene.boundary[side].support = BoundaryValues::Support::normal;
  scene.boundary["force:hole"].pressure_MPa = LinearValue<double>{{pressure, pressure}};
  AdaptiveSettings settings = until(0.05);
  settings.stress_error = of_stress;
  const Method method = select_methods(hybrid_of_degree(2)).front();
  AdaptiveLoop loop(scene, mesh, method, settings);
  const std::vector<AdaptiveLevel> levels = levels_of(loop);
  EXPECT_TRUE(loop.reached());
  ASSERT_GT(levels.size(), 1U);
  EXPECT_LT(*levels.front().error, 0.05);
  EXPECT_FALSE(levels.front().goal);
  EXPECT_TRUE(levels.back().goal);
  for (const AdaptiveLevel* level : {&levels.front(), &levels.back()}) {
    const testing::Solved solved(scene, level->mesh, 2);
    const ConstitutiveError error = solved.error();
    const SolvedFields fields{solved.system, solved.hybrid, solved.w, &error, nullptr, {}};
    EXPECT_EQ(stress_doubt(fields)->relative > of_stress, level == &levels.front());
    const double exact =
        pressure * (outer * outer + inner * inner) / (outer * outer - inner * inner);
    const ContactPicture none = contact_picture(solved.system, solved.hybrid, solved.w);
    const LargestStress principal = part_files(fields, none).answer.stress.principal;
    EXPECT_NEAR(principal.value, exact, *principal.off_MPa);
  }
}

TEST(AdaptiveLoop, WhatIsExpectedOfTheErrorSavesLevels) {
  const Mesh mesh = testing::catalogue_mesh("Mesh0");
  constexpr double goal = 0.002;
  AdaptiveLoop expected({}, mesh, hybrid(), until(goal));
  AdaptiveSettings settings = until(goal);
  settings.marking = 0.75;
  AdaptiveLoop marked({}, mesh, hybrid(), settings);
  const std::vector<AdaptiveLevel> few = levels_of(expected), many = levels_of(marked);
  EXPECT_TRUE(expected.reached() && marked.reached());
  EXPECT_LT(few.size(), many.size());
  EXPECT_LT(*few.back().error * few.back().unknowns,
            1.15 * *many.back().error * many.back().unknowns);
  const auto sum = [](const std::vector<AdaptiveLevel>& levels) {
    std::int64_t unknowns = 0;
    for (const AdaptiveLevel& level : levels) unknowns += level.unknowns;
    return unknowns;
  };
  EXPECT_LT(sum(few), 0.8 * static_cast<double>(sum(many)));
}

// An L of two materials that presses its foot against the wall: what is left of a block, its
// vertices in another order, a boundary by where an edge is.
Mesh corner_piece() {
  const Mesh block = testing::small_block(8, 8, 0);
  Mesh piece;
  piece.name = "L";
  piece.body_names = {"upright", "foot"};
  std::map<int, int> number;  // of the block's vertices
  std::set<std::array<int, 2>> sides;
  for (std::array<int, 3> t : block.triangles) {
    const Eigen::Vector2d middle =
        (block.vertices[t[0]] + block.vertices[t[1]] + block.vertices[t[2]]) / 3;
    if (middle.x() >= 5 && middle.y() >= 5) continue;
    for (int& v : t) {
      const auto [place, is_new] = number.emplace(v, std::ssize(piece.vertices));
      if (is_new) piece.vertices.push_back(block.vertices[v]);
      v = place->second;
    }
    piece.triangles.push_back(t);
    piece.triangle_body.push_back(middle.x() > 5);
    for (int k = 0; k < 3; ++k) sides.insert({t[k], t[(k + 1) % 3]});
  }
  for (const auto& [a, b] : sides) {
    if (sides.contains({b, a})) continue;
    const Eigen::Vector2d middle = (piece.vertices[a] + piece.vertices[b]) / 2;
    piece.boundary.push_back({{a, b},
                              middle.y() > 9.99   ? BoundaryRole::displacement
                              : middle.x() > 9.99 ? BoundaryRole::contact
                                                  : BoundaryRole::force});
  }
  validate(piece);
  return piece;
}

// The singular corners of tooth and L cost nothing: e ~ N^-1, from 3 % on.
TEST(AdaptiveLoop, TheErrorFallsWithTheInverseOfTheUnknowns) {
  Scene of_corner_piece;
  of_corner_piece.materials = {{"upright", {70000, 0.33}}, {"foot", {210000, 0.3}}};
  const std::vector<std::pair<Scene, Mesh>> bodies = {{{}, testing::catalogue_mesh("Mesh0")},
                                                      {of_corner_piece, corner_piece()}};
  for (const auto& [scene, mesh] : bodies) {
    AdaptiveLoop loop(scene, mesh, hybrid(), until(0.003));
    const std::vector<AdaptiveLevel> levels = levels_of(loop);
    ASSERT_TRUE(loop.reached()) << loop.why_ended();
    const AdaptiveLevel& fine = levels.back();
    const auto coarse = std::ranges::find_if(
        levels, [](const AdaptiveLevel& level) { return *level.error < 0.03; });
    const double slope = std::log(*fine.error / *coarse->error) /
                         std::log(static_cast<double>(fine.unknowns) / coarse->unknowns);
    EXPECT_LT(slope, -0.9) << mesh.name;
  }
}

TEST(AdaptiveLoop, SaysWhyItEndsBefore) {
  const Mesh mesh = testing::small_tooth(6, 5);
#ifndef AIRYBENCH_SANITIZED  // no limit on the heap there
  AdaptiveSettings little_memory = until(0.001);
  little_memory.memory_limit_bytes = 100'000;
  AdaptiveLoop starved({}, mesh, hybrid(), little_memory);
  EXPECT_FALSE(starved.next());
  EXPECT_FALSE(starved.reached());
  EXPECT_TRUE(testing::contains(starved.why_ended(), "out_of_memory"));
#endif

  Scene at_rest;
  at_rest.displacement_mm = {-1, 0};  // away from the wall
  AdaptiveLoop done(at_rest, mesh, hybrid(), until({}, 5000));
  EXPECT_TRUE(done.next());
  EXPECT_FALSE(done.next());
  EXPECT_TRUE(testing::contains(done.why_ended(), "the error is zero"));

  // Γ_D is pushed through the wall where it ends on Γ_C.
  Scene through;
  through.mesh.keep_force_edges = 0;
  Problem posed = pose(through, mesh);
  AdaptiveLoop flawed({}, posed.mesh, hybrid(), until(0.001));
  const std::optional<AdaptiveLevel> level = flawed.next();
  ASSERT_TRUE(level);
  EXPECT_FALSE(level->error);
  EXPECT_TRUE(testing::contains(flawed.why_ended(), "through the wall"));
  EXPECT_FALSE(flawed.next());
}

}  // namespace
}  // namespace airybench::adaptive_loop_test
