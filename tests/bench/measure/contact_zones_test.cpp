// The ends of a zone from its forces: exact for the root that they are derived from, and of second
// order for the pressure of Hertz.
#include "bench/measure/contact_zones.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace airybench::contact_zones_test {
namespace {

constexpr int points = 3;  // per edge

// Edges between `ends`, of a pressure whose integral from the first end on is given, positive up to
// `reach`. A point is inside where its part of the edge begins inside.
std::vector<ZoneEdge> edges_of(const std::vector<double>& ends,
                               const std::function<double(double)>& integral, double reach) {
  std::vector<ZoneEdge> edges;
  for (std::size_t k = 1; k < ends.size(); ++k) {
    const double start = ends[k - 1], length = ends[k] - start;
    ZoneEdge& edge = edges.emplace_back();
    edge.length_mm = length;
    edge.force_N = integral(std::min(ends[k], reach)) - integral(std::min(start, reach));
    for (int j = 0; j < points; ++j) edge.is_inside.push_back(start + length * j / points < reach);
  }
  return edges;
}
double sum(const std::vector<double>& lengths) {
  return std::accumulate(lengths.begin(), lengths.end(), 0.);
}

class EndOfRoot : public ::testing::TestWithParam<double> {};

TEST_P(EndOfRoot, IsExactFromEitherSide) {
  const double a = GetParam();
  const auto integral = [a](double s) { return -std::pow(a - s, 1.5); };
  std::vector<ZoneEdge> edges = edges_of({0, 1, 1.5, 2.2, 3}, integral, a);
  EXPECT_NEAR(sum(zone_lengths_mm(edges, false)), a, 1e-12);
  for (ZoneEdge& edge : edges) std::reverse(edge.is_inside.begin(), edge.is_inside.end());
  std::ranges::reverse(edges);
  EXPECT_NEAR(sum(zone_lengths_mm(edges, false)), a, 1e-12);
}
// Within an edge, at its end, and in the first part of one.
INSTANTIATE_TEST_SUITE_P(Ends, EndOfRoot, ::testing::Values(1.6, 1.9, 2.1, 2.2, 2.21));

TEST(ContactZones, TheEndOfHertzConvergesTwiceAsFastAsTheEdges) {
  constexpr double a = 0.937;  // nowhere at the end of an edge
  const auto integral = [](double x) {
    const double s = std::min(x / a, 1.);
    return s * std::sqrt(1 - s * s) + std::asin(s);
  };
  std::vector<double> off;
  for (const int n : {8, 16, 32, 64}) {
    std::vector<double> ends;
    for (int k = 0; k <= 2 * n; ++k) ends.push_back(a * (k - 0.37) / n);  // alike on every mesh
    ends.front() = 0;
    off.push_back(std::abs(sum(zone_lengths_mm(edges_of(ends, integral, a), false)) - a));
  }
  for (std::size_t k = 1; k < off.size(); ++k) EXPECT_NEAR(off[k - 1] / off[k], 4, 0.8) << k;
  EXPECT_LT(off.back(), 1e-3 * a / 64);  // of an edge
}

TEST(ContactZones, WhatHasNoNeighbourOfItsZoneIsCountedByItsPoints) {
  const std::vector<ZoneEdge> edges = {{3, 1, {false, true, true}},
                                       {3, 0, {false, false, false}},
                                       {6, 1, {true, false, true}},
                                       {1, 2, {true, true, true}}};
  EXPECT_EQ(zone_lengths_mm(edges, false), (std::vector<double>{2, 0, 4, 1}));
}

// Up to what the next edge's first point stands for, whatever the forces.
TEST(ContactZones, AWholeLastEdgeReachesALittleIntoTheNext) {
  std::vector<ZoneEdge> edges = {
      {1, 3, {true, true, true}}, {1, 2, {true, true, true}}, {3, 0, {false, false, false}}};
  const double share = std::pow(2. / 5, 2. / 3);
  EXPECT_NEAR(zone_lengths_mm(edges, false)[1], share / (1 - share), 1e-12);
  EXPECT_GT(share / (1 - share), 1);
  edges[1].force_N = 100;
  EXPECT_EQ(zone_lengths_mm(edges, false)[1], 2);
}

// The zone goes through the place where the loop is cut.
TEST(ContactZones, ALoopHasNoEnds) {
  const std::vector<ZoneEdge> all(4, ZoneEdge{2, 1, {true, true, true}});
  EXPECT_EQ(sum(zone_lengths_mm(all, true)), 8);
  const auto integral = [](double s) { return -std::pow(1.7 - s, 1.5); };
  std::vector<ZoneEdge> edges = edges_of({0, 1, 2, 3}, integral, 1.7);
  edges.push_back({1, 2, {true, true, true}});  // before the first
  EXPECT_NEAR(zone_lengths_mm(edges, true)[1], 0.7, 1e-12);
  std::rotate(edges.begin(), edges.begin() + 1, edges.end());  // cut before the end
  EXPECT_NEAR(zone_lengths_mm(edges, true)[0], 0.7, 1e-12);
}

}  // namespace
}  // namespace airybench::contact_zones_test
