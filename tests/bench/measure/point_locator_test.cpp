#include "bench/measure/point_locator.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/measure/stress_samples.hpp"
#include "solvers/methods.hpp"
#include "tests/verify/round_bodies.hpp"

namespace airybench::testing {
namespace {

// A quarter of a ring from 1 to 2 mm, and its stresses of degree 2.
struct Ring {
  std::shared_ptr<const Problem> problem =
      std::make_shared<const Problem>(quarter(4, 2, 2, pressed, 0.3));
  Solution solution = run(select_methods("HYBRID:k=2").front(), contact_system(problem, 2), {});
  PointLocator locator{*problem, 2};
};

TEST(PointLocator, FindsTheStressOfEverySample) {
  const Ring ring;
  constexpr int parts = 4;
  const StressSamples samples(*ring.problem, ring.solution.stress, parts);
  double largest = 0;
  for (int t = 0; t < static_cast<int>(ring.problem->mesh.triangles.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      const StressSamples::Third third = samples.third(t, k);
      // Inside: on sides it may be that of the neighbour.
      const Eigen::Vector2d x = third.at_mm.rowwise().mean();
      const auto place = ring.locator.place_of(x);
      ASSERT_TRUE(place);
      EXPECT_EQ(place->triangle, t);
      EXPECT_EQ(place->third, k);
      for (Eigen::Index i = 0; i < third.at_mm.cols(); ++i)
        EXPECT_TRUE(ring.locator.place_of(third.at_mm.col(i)));
      const Eigen::Index inner = samples.place(1, 1);
      largest =
          std::max(largest, (stress_at(ring.locator, ring.solution.stress, third.at_mm.col(inner)) -
                             third.stress.col(inner))
                                .norm());
    }
  EXPECT_LT(largest, 1e-12);
}

TEST(PointLocator, EndsAtTheCurveNotAtItsChord) {
  const Ring ring;
  for (const double turn : {0.03, 0.2, 0.55, 1.1, 1.5}) {
    const Eigen::Vector2d direction(std::cos(turn), std::sin(turn));
    for (const double inside : {1.0001, 1.5, 1.9999})
      EXPECT_TRUE(ring.locator.place_of(inside * direction)) << turn << ' ' << inside;
    for (const double outside : {0.0, 0.99, 2.001, 5.0}) {
      EXPECT_FALSE(ring.locator.place_of(outside * direction)) << turn << ' ' << outside;
      EXPECT_TRUE(
          std::isnan(stress_at(ring.locator, ring.solution.stress, outside * direction).x()));
    }
  }
  EXPECT_FALSE(ring.locator.place_of({-1, 1}));
  EXPECT_FALSE(ring.locator.place_of({std::nan(""), 1}));
}

}  // namespace
}  // namespace airybench::testing
