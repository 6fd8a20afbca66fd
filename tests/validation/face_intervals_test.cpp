// Intervals of every contact face, against forces that statics or symmetry know and Lamé's
// pressure.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh/refinement.hpp"
#include "tests/support/pieces.hpp"
#include "tests/support/small_meshes.hpp"
#include "tests/support/two_blocks.hpp"
#include "tests/validation/shrink_fit.hpp"
#include "tests/verify/solved_body.hpp"
#include "verify/contact_intervals.hpp"

namespace airybench::face_intervals_test {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;
using testing::add_block;
using testing::ShrinkFit;

struct Judged : testing::Solved {
  ResultantLifts lifts;
  ContactIntervals intervals;

  Judged(const Scene& scene, const Mesh& mesh, int degree)
      : Solved(scene, mesh, degree),
        lifts(resultant_lifts(*system.problem, degree)),
        intervals(contact_intervals(system, hybrid.stress, hybrid.F_C, w, error(), lifts).value()) {
  }
  const FaceIntervals& face(const std::string& name) const {
    for (std::size_t k = 0; k < lifts.faces.size(); ++k)
      if (face_name(lifts.faces[k].labels) == name) return intervals.faces[k];
    throw std::invalid_argument(name);
  }
};

double width(const std::optional<Bracket>& of) {
  EXPECT_TRUE(of);
  return of ? of->high - of->low : 0;
}
void expect_holds(const std::optional<Bracket>& interval, double value, const char* what) {
  ASSERT_TRUE(interval) << what;
  EXPECT_LE(interval->low, value) << what;
  EXPECT_GE(interval->high, value) << what;
}
bool is_same(const std::optional<Bracket>& a, const std::optional<Bracket>& b) {
  return a.has_value() == b.has_value() && (!a || (a->low == b->low && a->high == b->high));
}

void set_label(Mesh& mesh, BoundaryEdge& edge, const std::string& label) {
  const BoundaryLabel parsed = *parse_boundary_label(label);
  edge.role = parsed.role;
  edge.group = boundary_group(mesh, parsed.name);
}

// Guided below and pushed along its top, it presses on the wall at its right.
TEST(FaceIntervals, OfABarBetweenTwoWallsHoldItsLoadAndZero) {
  constexpr double traction_MPa = 5, load_N = 4 * traction_MPa;
  Mesh bar;
  bar.name = "bar";
  add_block(bar, "bar", {0, 0}, {12, 3}, 12, 3,
            {"displacement", "contact:right", "force", "contact:left"});
  for (BoundaryEdge& edge : bar.boundary) {
    const Vector2d middle = (bar.vertices[edge.vertices[0]] + bar.vertices[edge.vertices[1]]) / 2;
    if (middle.y() == 3 && std::abs(middle.x() - 6) < 2) set_label(bar, edge, "force:top");
  }
  validate(bar);
  Scene scene = {.crown_radius_mm = {}, .displacement_mm = {0, 0}};
  scene.boundary["displacement"].support = BoundaryValues::Support::normal;
  scene.boundary["force:top"].traction_MPa = LinearValue<Vector2d>{};
  scene.boundary["force:top"].traction_MPa->values.fill({traction_MPa, 0});
  for (const double friction : {0., 0.3})
    for (int degree = 1; degree <= 3; ++degree) {
      SCOPED_TRACE(::testing::Message() << "friction " << friction << ", degree " << degree);
      scene.friction = friction;
      Mesh mesh = bar;
      double before = 4 * load_N;
      for (int level = 0; level < (degree == 1 ? 3 : 2); ++level) {
        const Judged judged(scene, mesh, degree);
        EXPECT_EQ(judged.intervals.guaranteed, friction == 0);
        ASSERT_EQ(judged.lifts.faces.size(), 2u);
        const FaceIntervals &right = judged.face("contact:right"),
                            &left = judged.face("contact:left");
        expect_holds(judged.intervals.normal_resultant_N, -load_N, "all");
        expect_holds(right.normal_resultant_N, -load_N, "right");
        expect_holds(left.normal_resultant_N, 0, "left");
        EXPECT_FALSE(right.tangential_resultant_N);  // v = t at the guide
        EXPECT_EQ(left.peak, PressurePeak::bounded);
        EXPECT_FALSE(left.largest_pressure_within_MPa);
        EXPECT_GE(right.largest_pressure_MPa, load_N / 3);
        EXPECT_EQ(right.largest_pressure_at_mm.x(), 12);
        EXPECT_LT(width(right.normal_resultant_N), (friction == 0 ? 0.75 : 0.9) * before);
        before = width(right.normal_resultant_N);
        mesh = uniformly_refined(mesh);
      }
    }
}

// Vertically each block is free to move as a whole, and the forces are known from statics.
TEST(FaceIntervals, OfAStackOfBlocksAreWhatStaticsSays) {
  Mesh mesh;
  mesh.name = "stack";
  add_block(mesh, "base", {-2, -3}, {12, 0}, 11, 3,
            {"displacement:floor", "force", "contact:base", "displacement:guide"});
  add_block(mesh, "middle", {0, 0}, {10, 4}, 7, 4,
            {"contact:below", "force", "contact:above", "displacement:guide"});
  add_block(mesh, "top", {1, 4}, {9, 6}, 9, 3,
            {"contact:top", "force", "force:head", "displacement:guide"});
  validate(mesh);
  Scene scene;
  scene.crown_radius_mm.reset();
  scene.displacement_mm = {0, 0};
  scene.body_force_N_per_mm3 = {0, -0.25};
  scene.boundary["displacement:guide"].support = BoundaryValues::Support::normal;
  scene.boundary["force:head"].pressure_MPa = LinearValue<double>{};
  scene.boundary["force:head"].pressure_MPa->values.fill(7);
  const double on_middle = 7 * 8 + 0.25 * 8 * 2, on_base = on_middle + 0.25 * 10 * 4;
  for (const double friction : {0., 0.4})
    for (const int degree : {1, 3}) {
      SCOPED_TRACE(::testing::Message() << "friction " << friction << ", degree " << degree);
      scene.contacts = {{.between = {{{"contact:below"}, {"contact:base"}}}, .friction = friction},
                        {.between = {{{"contact:top"}, {"contact:above"}}}, .friction = friction}};
      const Judged judged(scene, mesh, degree);
      const auto expect = [&](const FaceIntervals& face, double force, const char* what) {
        expect_holds(face.normal_resultant_N, -force, what);
        EXPECT_LT(width(face.normal_resultant_N), 1e-6 * force) << what;
      };
      expect(judged.face("contact:base against contact:below"), on_base, "below");
      expect(judged.face("contact:above against contact:top"), on_middle, "above");
      expect(judged.intervals, on_base + on_middle, "both");
    }
}

// Bodies of two materials, whose vertices do not match, on a curve.
TEST(FaceIntervals, OfAShrinkFitHoldLamesForceAndPressure) {
  constexpr double a = ShrinkFit::a, b = ShrinkFit::b, c = ShrinkFit::c;
  const double pressure = ShrinkFit::pressure_MPa();
  for (int degree = 1; degree <= 2; ++degree) {
    double before = 4 * pressure * pi / 2 * b;
    for (const int times : {1, 2, 4}) {
      SCOPED_TRACE(::testing::Message() << "degree " << degree << ", " << times);
      std::vector<double> hub, rim;
      for (int k = 0; k <= 3 * times; ++k) {
        hub.push_back(std::lerp(a, b, k / (3. * times)));
        rim.push_back(std::lerp(b, c, k / (3. * times)));
      }
      const Judged judged(ShrinkFit::scene(), ShrinkFit::mesh(hub, 6 * times, rim, 8 * times),
                          degree);
      const FaceIntervals& face = judged.face("contact:hub against contact:rim");
      expect_holds(face.normal_resultant_N, -pressure * pi / 2 * b, "force");
      const double now = width(face.normal_resultant_N);
      EXPECT_LT(now, 0.7 * before);
      before = now;
      if (face.largest_pressure_within_MPa)
        expect_holds(face.largest_pressure_within_MPa, pressure, "pressure");
      EXPECT_TRUE(times < 4 || face.largest_pressure_within_MPa) << name_of(face.peak);
    }
  }
}

// The only face of a scene has the intervals of all faces; of two that meet on a line only their
// sum has one.
TEST(FaceIntervals, ThatMeetAreKnownTogether) {
  for (const double friction : {0., 0.3}) {
    Mesh mesh = testing::small_tooth(6, 5);
    const Scene scene = {.friction = friction};
    const Judged one(scene, mesh, 1);
    ASSERT_EQ(one.intervals.faces.size(), 1u);
    const FaceIntervals& face = one.intervals.faces.front();
    EXPECT_TRUE(face.normal_resultant_N);
    EXPECT_EQ(face.tangential_resultant_N.has_value(), friction > 0);
    EXPECT_TRUE(is_same(face.normal_resultant_N, one.intervals.normal_resultant_N));
    EXPECT_TRUE(is_same(face.tangential_resultant_N, one.intervals.tangential_resultant_N));
    EXPECT_TRUE(
        is_same(face.largest_pressure_within_MPa, one.intervals.largest_pressure_within_MPa));
    EXPECT_EQ(face.largest_pressure_MPa, one.intervals.largest_pressure_MPa);
    EXPECT_EQ(face.peak, one.intervals.peak);

    double middle = 0, edges = 0;
    const auto place = [&](const BoundaryEdge& edge) {
      return mesh.vertices[edge.vertices[0]].y() + mesh.vertices[edge.vertices[1]].y();
    };
    for (const BoundaryEdge& edge : mesh.boundary)
      if (edge.role == BoundaryRole::contact) middle += place(edge), ++edges;
    for (BoundaryEdge& edge : mesh.boundary)
      if (edge.role == BoundaryRole::contact)
        set_label(mesh, edge, place(edge) > middle / edges ? "contact:above" : "contact:below");
    const Judged two(scene, mesh, 1);
    ASSERT_EQ(two.intervals.faces.size(), 2u);
    for (const FaceIntervals& own : two.intervals.faces) EXPECT_FALSE(own.normal_resultant_N);
    EXPECT_NEAR(two.intervals.normal_resultant_N.value().low, face.normal_resultant_N->low, 1e-6);
    EXPECT_NEAR(two.intervals.normal_resultant_N.value().high, face.normal_resultant_N->high, 1e-6);
  }
}

}  // namespace
}  // namespace airybench::face_intervals_test
