// The gap as it is, against a sum over many points of an edge.
#include "assembly/problem/wall_gap.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/support/dice.hpp"
#include "tests/support/sanitized.hpp"

namespace airybench::wall_gap_test {
namespace {

using Eigen::Vector2d;

constexpr int points = 20000, lines = testing::sanitized ? 20 : 200;

// The detail by midpoints, and how far what `detail` says is below the wall is above it
// at most.
struct Sampled {
  WallDetail::Moments moments_mm{}, unmet{};
  double above_mm = -1;
};
Sampled sampled(const FacingEdge& edge, const std::array<double, 3>& q, const WallDetail& detail) {
  Sampled sum;
  const auto& lowered = detail.lowered_mm;
  for (int i = 0; i < points; ++i) {
    const double s = (i + 0.5) / points;
    constexpr int n = highest_stress_degree;
    WallDetail::Moments weight;
    for (int j = 0; j <= n; ++j)
      weight[j] = (n + 1) * binomial(n, j) * std::pow(s, j) * std::pow(1 - s, n - j) / points;
    const std::optional<double> gap = edge.gap_mm(s);
    const double quadratic =
        q[0] * (1 - s) * (1 - 2 * s) + 4 * q[1] * s * (1 - s) + q[2] * s * (2 * s - 1);
    if (gap) {
      const double low = quadratic - (lowered[0] * (1 - s) * (1 - s) +
                                      2 * lowered[1] * s * (1 - s) + lowered[2] * s * s);
      sum.above_mm = std::max(sum.above_mm, low - *gap);
    }
    for (std::size_t k = 0; k < weight.size(); ++k)
      if (gap)
        sum.moments_mm[k] += weight[k] * (*gap - quadratic);
      else
        sum.unmet[k] += weight[k];
  }
  return sum;
}

void expect_as_sampled(const FacingEdge& edge, double tolerance_mm, const std::string& name) {
  const std::array<double, 3> q = {edge.gap_mm(0).value_or(0.1), edge.gap_mm(0.5).value_or(0.1),
                                   edge.gap_mm(1).value_or(0.1)};
  const WallDetail detail = wall_detail(gap_pieces(edge), q);
  const Sampled expected = sampled(edge, q, detail);
  EXPECT_LE(expected.above_mm, 1e-9) << name;
  for (std::size_t k = 0; k < expected.unmet.size(); ++k) {
    EXPECT_NEAR(detail.moments_mm[k], expected.moments_mm[k], tolerance_mm) << name;
    EXPECT_NEAR(detail.unmet[k], expected.unmet[k], tolerance_mm) << name;
  }
}

// The rim's lower side from x = 0 to 2, turned with its wall about a point far from the origin.
struct Turned {
  Eigen::Rotation2Dd turn;
  Vector2d at(double x, double y) const { return turn * Vector2d(x, y) + Vector2d(100, -30); }
  FacingEdge edge(const Wall& wall, const std::optional<Wall>& face) const {
    return {at(0, 0), at(2, 0), turn * Vector2d(0, -1), wall, face};
  }
};

// Corners from left of the edge to right of it, or not so far; one in five is above the one before.
PolylineWall random_line(testing::Dice& dice, const Turned& turned) {
  const int corners = 2 + static_cast<int>(12 * dice.unit());
  double x = -1 + 1.5 * dice.unit(), y = 0;
  PolylineWall line;
  for (int k = 0; k < corners; ++k) {
    y = -0.3 + 0.35 * dice.unit();
    line.points_mm.push_back(turned.at(x, y));
    if (dice.unit() > 0.2) x += 0.1 + 0.8 * dice.unit();
  }
  line.points_mm.push_back(turned.at(x + 0.1 + dice.unit(), y));
  return line;
}

TEST(WallGap, OfRandomPolylinesIsWhatManyPointsSay) {
  testing::Dice dice(7);
  const std::optional<Wall> no_face;
  for (int k = 0; k < lines; ++k) {
    const Turned turned{Eigen::Rotation2Dd(0.37 * k)};
    const Wall wall = random_line(dice, turned);
    expect_as_sampled(turned.edge(wall, no_face), 2e-4, "wall " + std::to_string(k));
    const Wall flat = FlatWall{turned.at(0, -0.1), turned.turn * Vector2d(0.2, 1)};
    const std::optional<Wall> face = random_line(dice, turned);
    expect_as_sampled(turned.edge(flat, face), 2e-4, "face " + std::to_string(k));
    const Wall disc = CircularWall{turned.at(0.7, -5.2), 5, CircularWall::Bodies::outside};
    expect_as_sampled(turned.edge(disc, face), 2e-4, "face on a disc " + std::to_string(k));
  }
}

TEST(WallGap, OfRoundCurvesIsWithinWhatItSays) {
  const Turned turned{Eigen::Rotation2Dd(1.1)};
  const std::optional<Wall> no_face;
  for (const double radius : {1.2, 3., 50.}) {
    const Wall disc =
        CircularWall{turned.at(0.8, -radius - 0.1), radius, CircularWall::Bodies::outside};
    expect_as_sampled(turned.edge(disc, no_face), 1e-4, "disc");
    const Wall flat = FlatWall{turned.at(0, -0.5), turned.turn * Vector2d(0, 1)};
    const std::optional<Wall> face =
        CircularWall{turned.at(1, radius - 0.02), radius, CircularWall::Bodies::inside};
    expect_as_sampled(turned.edge(flat, face), 1e-2, "face");
  }
}

// Corners as far away as numbers go cost no more pieces: what rounding does to them is no corner.
TEST(WallGap, FarCornersAreNoReasonToHalve) {
  const std::optional<Wall> no_face;
  for (const double far : {1e3, 1e6, 1e9, 1e15, 1e200, 1e308}) {
    const Turned turned{Eigen::Rotation2Dd(0.3)};
    const Vector2d along = turned.turn * Vector2d(1, 0.001);
    const Wall line = PolylineWall{{turned.at(0, -0.2) - far * along, turned.at(1, -0.2),
                                    turned.at(0, -0.2) + far * along}},
               disc = CircularWall{turned.at(0, -0.2) - far * (turned.turn * Vector2d(0, 1)), far,
                                   CircularWall::Bodies::outside};
    EXPECT_LT(gap_pieces(turned.edge(line, no_face)).size(), 100u) << far;
    EXPECT_LT(gap_pieces(turned.edge(disc, no_face)).size(), 100u) << far;
  }
}

TEST(WallGap, ABumpBetweenThePointsIsSeen) {
  const Turned turned{Eigen::Rotation2Dd(0)};
  const std::optional<Wall> no_face;
  const Wall wall = PolylineWall{{turned.at(-2, 0), turned.at(0.4, 0), turned.at(0.5, 0.01),
                                  turned.at(0.6, 0), turned.at(12, 0)}};
  const std::vector<GapPiece> pieces = gap_pieces(turned.edge(wall, no_face));
  EXPECT_EQ(pieces.size(), 4u);
  const WallDetail detail = wall_detail(pieces, {0, 0, 0});
  EXPECT_LT(sampled(turned.edge(wall, no_face), {0, 0, 0}, detail).above_mm, 1e-12);
  // ∫ of the bump is 0.001 mm², its middle at a quarter of the edge, L = 2.
  const std::array<double, 2> moments = lower_moments<1>(detail.moments_mm);
  EXPECT_NEAR(moments[0], -0.001 * 0.75, 1e-12);
  EXPECT_NEAR(moments[1], -0.001 * 0.25, 1e-12);
  EXPECT_EQ(lower_moments<0>(detail.unmet)[0], 0);
}

TEST(WallGap, BelowAStepNothingIsLoweredByAllOfIt) {
  const Turned turned{Eigen::Rotation2Dd(0)};
  const std::optional<Wall> no_face;
  const Wall wall = PolylineWall{
      {turned.at(-2, 0), turned.at(0.6, 0), turned.at(0.6, -0.5), turned.at(12, -0.5)}};
  const FacingEdge edge = turned.edge(wall, no_face);
  const WallDetail detail = wall_detail(gap_pieces(edge), {0, 0.5, 0.5});
  EXPECT_NEAR(detail.lowered_mm[0], 0, 1e-9);
}

TEST(WallGap, WhereQuadraticsAreExactNothingIsLeftOut) {
  const Turned turned{Eigen::Rotation2Dd(0.4)};
  const std::optional<Wall> no_face;
  const Wall flat = FlatWall{turned.at(0, -0.5), turned.turn * Vector2d(0.3, 1)},
             line = PolylineWall{{turned.at(-3, -0.2), turned.at(5, 0.1)}};
  for (const Wall* wall : {&flat, &line}) {
    const FacingEdge edge = turned.edge(*wall, no_face);
    EXPECT_EQ(gap_pieces(edge).size(), 1u);
    EXPECT_TRUE(wall_detail(gap_pieces(edge), {*edge.gap_mm(0), *edge.gap_mm(0.5), *edge.gap_mm(1)})
                    .is_nothing(2e-12));
  }
}

}  // namespace
}  // namespace airybench::wall_gap_test
