#include "meshgen/tooth_geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>

#include "meshgen/apportion.hpp"
#include "tests/support/complaint.hpp"

namespace airybench::tooth_geometry_test {
namespace {

constexpr auto displacement = BoundaryRole::displacement, force = BoundaryRole::force,
               contact = BoundaryRole::contact;

ToothDimensions rack(int teeth) { return {.teeth = teeth}; }

// Shoelace formula; positive when counter-clockwise.
double area(const BoundaryPolygon& polygon) {
  double twice = 0;
  const std::size_t n = polygon.vertices.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto &a = polygon.vertices[i], &b = polygon.vertices[(i + 1) % n];
    twice += a.x() * b.y() - b.x() * a.y();
  }
  return twice / 2;
}

double edge_length(const BoundaryPolygon& polygon, std::size_t i) {
  return (polygon.vertices[(i + 1) % polygon.vertices.size()] - polygon.vertices[i]).norm();
}

TEST(BoundarySegments, OneToothIsATrapezoid) {
  const auto segments = boundary_segments({});
  ASSERT_EQ(segments.size(), 4u);
  const auto expect_segment = [&](int k, double x, double y, BoundaryRole role) {
    EXPECT_EQ(segments[k].start, Eigen::Vector2d(x, y)) << k;
    EXPECT_EQ(segments[k].role, role) << k;
  };
  expect_segment(0, 0, -5, force);
  expect_segment(1, 10, -3, contact);
  expect_segment(2, 10, 3, force);
  expect_segment(3, 0, 5, displacement);
}

TEST(BoundarySegments, TouchingRootsLeaveNoGaps) {
  ToothDimensions dimensions = rack(3);
  dimensions.pitch = 2 * dimensions.root_half_height;
  EXPECT_EQ(boundary_segments(dimensions).size(), 3u * 3 + 2 + 1);
}

TEST(BoundaryPolygon, ClosedCounterClockwiseWithTheBodysArea) {
  EXPECT_NEAR(area(boundary_polygon({}, {6, 24, 10})), 80, 1e-8);
  EXPECT_NEAR(area(boundary_polygon(rack(4), {21, 98, 50})), 6 * 50 + 4 * 80, 1e-8);
}

TEST(BoundaryPolygon, EdgeCountsAreExact) {
  for (const EdgeCounts& edges : {EdgeCounts{6, 24, 10}, {1, 2, 1}, {3, 17, 5}}) {
    std::map<BoundaryRole, int> count;
    for (const BoundaryRole role : boundary_polygon({}, edges).roles) ++count[role];
    EXPECT_EQ(count[displacement], edges.displacement);
    EXPECT_EQ(count[force], edges.force);
    EXPECT_EQ(count[contact], edges.contact);
  }
}

TEST(BoundaryPolygon, ContactAndDisplacementEdgesAreEqual) {
  const BoundaryPolygon polygon = boundary_polygon({}, {6, 24, 10});
  for (std::size_t i = 0; i < polygon.roles.size(); ++i) {
    if (polygon.roles[i] == force) continue;
    EXPECT_NEAR(edge_length(polygon, i), polygon.roles[i] == contact ? 0.6 : 10.0 / 6, 1e-9);
  }
}

TEST(BoundaryPolygon, FlankEdgesAreGradedTowardsTheContactFace) {
  const EdgeCounts edges{6, 24, 10};
  const BoundaryPolygon polygon = boundary_polygon({}, edges);
  // On a flank ds/h is the same for all edges, so lengths have the ratio of h at their ends.
  const double ratio = std::pow((6.0 / 10) / (10.0 / 6), 1.0 / 10);  // of h per mm of x
  for (std::size_t i = 0; i + 1 < 12; ++i) {
    const double shrink = edge_length(polygon, i + 1) / edge_length(polygon, i);
    const double x0 = polygon.vertices[i].x(), x2 = polygon.vertices[i + 2].x();
    EXPECT_LT(shrink, 1);
    EXPECT_GT(shrink, std::pow(ratio, x2 - x0));
    EXPECT_NEAR(polygon.vertices[i].y(), -5 + 0.2 * x0, 1e-9);  // on the straight flank
  }
  const SizeField h = size_field({}, edges);
  const double first = edge_length(polygon, 0) / h.at(polygon.vertices[1].x() / 2);
  const double last = edge_length(polygon, 11) / h.at((polygon.vertices[11].x() + 10) / 2);
  EXPECT_NEAR(first, last, 0.01 * first);
}

TEST(BoundaryPolygon, OneToothIsSymmetric) {
  const BoundaryPolygon polygon = boundary_polygon({}, {6, 24, 10});
  // Vertices 0..12 go up the lower flank, 22..34 down the upper one.
  for (std::size_t k = 0; k <= 12; ++k) {
    EXPECT_NEAR(polygon.vertices[k].x(), polygon.vertices[34 - k].x(), 2e-10);
    EXPECT_NEAR(polygon.vertices[k].y(), -polygon.vertices[34 - k].y(), 2e-10);
  }
}

TEST(SizeField, RunsGeometricallyFromDisplacementToContact) {
  const SizeField h = size_field(rack(4), {40, 230, 160});
  EXPECT_DOUBLE_EQ(h.at(-6), 50.0 / 40);
  EXPECT_DOUBLE_EQ(h.at(10), 24.0 / 160);
  EXPECT_DOUBLE_EQ(h.at(2), std::sqrt(h.at(-6) * h.at(10)));  // half-way
  EXPECT_DOUBLE_EQ(h.at(2, 2), h.h_d * std::pow(h.h_c / h.h_d, 0.25));
  EXPECT_DOUBLE_EQ(h.at(-7), h.h_d);
  EXPECT_DOUBLE_EQ(h.at(11), h.h_c);
}

struct Impossible {
  ToothDimensions dimensions;
  EdgeCounts edges;
  std::string named;
};

TEST(BoundaryPolygon, RefusesImpossibleDimensionsAndTooFewEdges) {
  const EdgeCounts edges{6, 40, 10};
  const std::vector<Impossible> cases = {
      {{.root_half_height = 0}, edges, "root half height is 0 mm"},
      {{.length = -10}, edges, "length is -10 mm"},
      {{.tip_half_height = std::nan("")}, edges, "tip half height is nan mm"},
      {{.teeth = 0}, edges, "teeth is 0"},
      {{.teeth = 2, .pitch = 9}, edges, "pitch is 9 mm; the roots need at least 10"},
      {{.teeth = 2, .tip_half_height = 7, .pitch = 14}, edges, "the tips need more than 14"},
      {{.teeth = 2, .block_depth = 0}, edges, "block depth is 0 mm"},
      {{.pitch = 1, .block_depth = -1}, edges, "no complaint"},  // a rack's only
      {{}, {0, 24, 10}, "displacement edges: 0; at least 1"},
      {{}, {6, 1, 10}, "force edges: 1; at least 2"},
      {rack(4), {6, 40, 3}, "contact edges: 3; at least 4"},
  };
  for (const auto& [dimensions, counts, named] : cases)
    testing::expect_named(testing::complaint_of<std::invalid_argument>(
                              [&of = dimensions, &with = counts] { boundary_polygon(of, with); }),
                          {named});
}

using Counts = std::vector<int>;

TEST(Apportion, LargestRemaindersGetTheRestAndSmallSegmentsOneFirst) {
  struct Case {
    std::vector<double> weights;
    int total;
    Counts counts;
  };
  for (const auto& [weights, total, counts] :
       {Case{{1, 2, 3}, 12, {2, 4, 6}},            // exact shares
        Case{{2.6, 3.3, 4.1}, 10, {3, 3, 4}},      // shares 2.6, 3.3, 4.1
        Case{{1, 1, 1, 1}, 50, {13, 13, 12, 12}},  // equal remainders go to the earlier
        Case{{1, 1 + 1e-15, 1, 1 + 1e-15}, 50, {13, 13, 12, 12}},  // equal but for rounding
        Case{{0.001, 10, 0.001, 10}, 6, {1, 2, 1, 2}}, Case{{1e-12, 1}, 2, {1, 1}}})
    EXPECT_EQ(apportion(weights, total), counts) << weights.front() << " … in " << total;
}

TEST(Apportion, SumIsTheTotalAndEachGetsOne) {
  const std::vector<double> weights = {0.3, 7.1, 2.9, 0.05, 4.4, 1.25, 1.25};
  for (int total = 7; total < 300; ++total) {
    const Counts counts = apportion(weights, total);
    EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0), total);
    for (const int count : counts) EXPECT_GE(count, 1) << total;
  }
}

TEST(Apportion, WithinOneOfTheShareWhenAllSharesExceedOne) {
  const std::vector<double> weights = {3.7, 7.1, 2.9, 5.3};
  const double sum = 19;
  const Counts counts = apportion(weights, 77);
  for (std::size_t i = 0; i < weights.size(); ++i)
    EXPECT_LT(std::abs(counts[i] - 77 * weights[i] / sum), 1);
}

TEST(Apportion, RefusesTooFewEdgesAndBadWeights) {
  EXPECT_THROW(apportion({1, 1, 1}, 2), std::invalid_argument);
  EXPECT_THROW(apportion({1, 0}, 5), std::invalid_argument);
  EXPECT_THROW(apportion({1, -1}, 5), std::invalid_argument);
}

}  // namespace
}  // namespace airybench::tooth_geometry_test
