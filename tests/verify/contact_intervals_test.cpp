// Intervals of what one asks of the contact: they hold what finer meshes say.
#include "verify/contact_intervals.hpp"

#include <algorithm>

#include "mesh/refinement.hpp"
#include "tests/support/small_meshes.hpp"
#include "tests/verify/distance_to_finer.hpp"
#include "tests/verify/solved_body.hpp"

namespace airybench::contact_intervals_test {
namespace {

struct Judged : testing::Solved {
  ConstitutiveError of_w = error();
  std::optional<ContactIntervals> intervals = contact_intervals(
      system, hybrid.stress, hybrid.F_C, w, of_w, resultant_lifts(*system.problem, system.degree));

  using Solved::Solved;
  double resultant(int component) const {
    const int m = system.contact.components;
    double sum = 0;
    for (int p = 0; p < system.contact.count; ++p) sum += hybrid.F_C(m * p + component);
    return sum;
  }
};

void expect_inside(const Bracket& interval, double value, const char* what) {
  EXPECT_LE(interval.low, value) << what;
  EXPECT_GE(interval.high, value) << what;
}

TEST(ContactIntervals, OfEveryDegreeHoldWhatTheHighestSaysOfAFinerMesh) {
  for (const double mu : {0.0, 0.2}) {
    const Scene scene = {.friction = mu};
    const Judged fine(scene, testing::catalogue_mesh("Mesh1"), highest_stress_degree);
    const ContactIntervals& narrow = fine.intervals.value();
    double widest = 2 * std::abs(fine.resultant(0));
    for (int k = 1; k <= highest_stress_degree; ++k) {
      SCOPED_TRACE(::testing::Message() << "degree " << k << ", friction " << mu);
      const Judged coarse(scene, testing::catalogue_mesh("Mesh0"), k);
      const ContactIntervals& wide = coarse.intervals.value();
      EXPECT_EQ(wide.guaranteed, mu == 0);
      ASSERT_TRUE(wide.normal_resultant_N);
      expect_inside(*wide.normal_resultant_N, fine.resultant(0), "normal");
      const double width = wide.normal_resultant_N->high - wide.normal_resultant_N->low;
      EXPECT_LT(width, 0.9 * widest);
      widest = width;
      if (mu > 0) expect_inside(*wide.tangential_resultant_N, fine.resultant(1), "tangential");
      ASSERT_TRUE(wide.largest_pressure_within_MPa) << name_of(wide.peak);
      expect_inside(*wide.largest_pressure_within_MPa, narrow.largest_pressure_MPa, "pressure");
      ASSERT_FALSE(wide.ends.empty());
      for (const ContactEnd& end : wide.ends)
        EXPECT_TRUE(std::ranges::any_of(narrow.ends, [&](const ContactEnd& fine_end) {
          const auto [low, high] = fine_end.along_face_mm;
          return end.along_face_mm.low <= low && high <= end.along_face_mm.high;
        })) << end.at_mm.transpose();
    }
  }
}

// Pressure of σ at points along all contact edges, by the binomial formula.
double largest_of_points(const Judged& s) {
  const Problem& problem = *s.system.problem;
  const int k = s.system.degree;
  double largest = 0;
  for (int p = 0; p < s.system.contact.count; p += k + 1) {
    const auto [a, b] = problem.mesh.boundary[s.system.contact.boundary[p]].vertices;
    const double length = (problem.mesh.vertices[b] - problem.mesh.vertices[a]).norm();
    for (int i = 0; i <= 100; ++i) {
      const double x = i / 100.;
      double pressure = 0;
      for (int j = 0; j <= k; ++j)
        pressure -= (k + 1) / length * s.hybrid.F_C(s.system.contact.components * (p + j)) *
                    binomial(k, j) * std::pow(x, j) * std::pow(1 - x, k - j);
      largest = std::max(largest, pressure);
    }
  }
  return largest;
}

TEST(ContactIntervals, NoPointHasMoreThanTheLargestPressure) {
  for (const double mu : {0.0, 0.2})
    for (int k = 1; k <= highest_stress_degree; ++k) {
      const Judged s({.friction = mu}, testing::small_tooth(6, 5), k);
      const double found = s.intervals.value().largest_pressure_MPa, sampled = largest_of_points(s);
      EXPECT_GE(found, (1 - 1e-9) * sampled) << k;
      EXPECT_LT(found, 1.01 * sampled) << k;  // and it is one of them
    }
}

// Three edges touch.
TEST(ContactIntervals, OfAFewClosedEdgesHoldWhatManySay) {
  const Scene scene = {.friction = 0, .crown_radius_mm = 50};
  const Judged many(scene, testing::small_block(24, 48, 0), highest_stress_degree);
  int given = 0;
  for (int k = 1; k <= highest_stress_degree; ++k) {
    const Judged few(scene, testing::small_block(6, 12, 0), k);
    EXPECT_EQ(few.intervals->peak, PressurePeak::bounded) << k;
    if (!few.intervals->largest_pressure_within_MPa) continue;
    ++given;
    expect_inside(*few.intervals->largest_pressure_within_MPa, many.intervals->largest_pressure_MPa,
                  "pressure");
  }
  EXPECT_GT(given, 0);
}

// A wall that ends within the face, at vertices; a crowned one.
TEST(ContactIntervals, TheLargestPressureIsUnboundedAtTheEdgeOfAPunch) {
  const Scene punch = {.friction = 0,
                       .crown_radius_mm = {},
                       .wall = PolylineWall{{{10, 2.5}, {10, 7.5}}}},
              crown = {.friction = 0, .crown_radius_mm = 400};
  Mesh mesh = testing::small_block(12, 12, 0);
  for (const int degree : {1, 1, 3}) {
    if (degree == 1) mesh = uniformly_refined(mesh);
    const Judged pressed(punch, mesh, degree), rolled(crown, mesh, degree);
    ASSERT_TRUE(pressed.intervals && rolled.intervals);
    EXPECT_EQ(pressed.intervals->peak, PressurePeak::unbounded) << degree;
    EXPECT_FALSE(pressed.intervals->largest_pressure_within_MPa);
    EXPECT_EQ(rolled.intervals->peak, PressurePeak::bounded) << degree;
    EXPECT_TRUE(rolled.intervals->largest_pressure_within_MPa);
  }
}

// Without friction n·v = 1 on both sides of a corner.
TEST(ContactIntervals, WithFrictionResultantsNeedAFaceWithoutCorners) {
  for (const double friction : {0., 0.3}) {
    Mesh mesh = testing::small_tooth(6, 5);
    mesh.is_polygon = true;
    for (Eigen::Vector2d& x : mesh.vertices) x.x() += 0.002 * x.x() * x.y() * x.y() / 10;
    const Judged judged({.friction = friction, .crown_radius_mm = {}}, mesh);
    ASSERT_TRUE(judged.intervals);
    EXPECT_EQ(judged.intervals->normal_resultant_N.has_value(), friction == 0);
    EXPECT_GT(judged.intervals->largest_pressure_MPa, 0);
    if (friction == 0)
      expect_inside(*judged.intervals->normal_resultant_N, judged.resultant(0), "normal");
  }
}

// The hole of a ring in contact, its edges counted from another one.
Mesh pin(int first) {
  Mesh mesh = testing::small_ring(24, 4, 2, 6);
  std::vector<BoundaryEdge> hole;
  for (BoundaryEdge& edge : mesh.boundary)
    if (edge.role == BoundaryRole::force) edge.role = BoundaryRole::contact, hole.push_back(edge);
  std::rotate(hole.begin(), hole.begin() + first, hole.end());
  std::size_t next = 0;
  for (BoundaryEdge& edge : mesh.boundary)
    if (edge.role == BoundaryRole::contact) edge = hole[next++];
  return mesh;
}

TEST(ContactIntervals, AClosedFaceHasTheSameEndsWhereverItStarts) {
  const Scene scene = {.friction = 0.3, .crown_radius_mm = {}};
  const auto ends = [&](int first) {
    const Judged judged(scene, pin(first));
    std::vector<ContactEnd> found = judged.intervals->ends;
    std::ranges::sort(found, {},
                      [](const ContactEnd& end) { return end.at_mm.x() + 2 * end.at_mm.y(); });
    return found;
  };
  const std::vector<ContactEnd> expected = ends(0);
  ASSERT_GE(expected.size(), 2u);
  for (const int first : {3, 8, 15, 21}) {
    const std::vector<ContactEnd> found = ends(first);
    ASSERT_EQ(found.size(), expected.size()) << first;
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_LT((found[k].at_mm - expected[k].at_mm).norm(), 1e-9) << first << " " << k;
      EXPECT_EQ(found[k].before, expected[k].before);
      EXPECT_EQ(found[k].after, expected[k].after);
      EXPECT_NEAR(found[k].along_face_mm.high - found[k].along_face_mm.low,
                  expected[k].along_face_mm.high - expected[k].along_face_mm.low, 1e-9);
    }
  }
}

TEST(MeanStress, IsNearerToTheSolutionThanItsBoundAndThanEitherStress) {
  for (const double mu : {0.0, 0.2}) {
    const Scene scene = {.friction = mu};
    const Mesh mesh = testing::small_tooth(6, 5);
    Mesh finer = mesh;
    for (int k = 0; k < 3; ++k) finer = uniformly_refined(finer);
    const Judged coarse(scene, mesh), fine(scene, finer);
    const Problem& problem = *coarse.system.problem;
    const StressField mean = mean_stress(problem, coarse.hybrid.stress, coarse.w);
    const double of_mean = testing::distance_to_finer(problem, mean, fine),
                 norm = std::sqrt(stress_norm_squared(problem, coarse.hybrid.stress)),
                 of_fine = fine.of_w.relative * norm;  // the fine one is off by at most
    EXPECT_LE(of_mean, coarse.of_w.relative_of_mean * norm + of_fine) << mu;
    EXPECT_LT(of_mean, testing::distance_to_finer(problem, coarse.hybrid.stress, fine)) << mu;
    EXPECT_GE(coarse.of_w.relative_of_mean, 0.5 * coarse.of_w.relative);
    EXPECT_LT(coarse.of_w.relative_of_mean, 0.6 * coarse.of_w.relative);
  }
}

}  // namespace
}  // namespace airybench::contact_intervals_test
