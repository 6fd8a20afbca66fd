// Words and intervals of the largest pressure: none is wrong where a mesh that is refined towards
// its peak, a closed form or the theory of corners says what is right.
#include "verify/pressure_peak.hpp"

#include <algorithm>

#include "mesh/bisection.hpp"
#include "mesh/refinement.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/pieces.hpp"
#include "tests/support/random_scenes.hpp"
#include "tests/support/small_meshes.hpp"
#include "tests/verify/solved_body.hpp"
#include "verify/contact_intervals.hpp"

namespace airybench::pressure_peak_test {
namespace {

using enum PressurePeak;

struct Posed {
  Scene scene;
  Mesh mesh;
};

LinearValue<Eigen::Vector2d> along_x(double width, const Eigen::Vector2d& start,
                                     const Eigen::Vector2d& end) {
  return {{start, end}, {Eigen::Vector2d(0, 0), Eigen::Vector2d(width, 0)}};
}

void add_roller(Scene& scene, const std::string& group, const Eigen::Vector2d& moved_mm) {
  BoundaryValues& values = scene.boundary["displacement:" + group];
  values.support = BoundaryValues::Support::normal;
  values.displacement_mm = along_x(1, moved_mm, moved_mm);
}

// A block on a flat, crowned, ending or bent wall, or on another block of the same width or wider,
// pressed, sheared and tilted, its sides free or on rollers.
Posed random_contact(int number) {
  testing::Dice dice(7919u + 31u * static_cast<unsigned>(number));
  for (int k = 0; k < 5; ++k) dice.unit();
  Posed posed;
  Scene& scene = posed.scene;
  scene.crown_radius_mm.reset();
  scene.friction = dice.below(3) == 0 ? 0 : dice.between(0.05, 0.6);
  scene.material = {dice.log_between(20000, 300000), dice.between(0, 0.42)};
  const double width = dice.between(3, 12), height = dice.between(3, 10),
               down = dice.between(0.002, 0.01),
               shear = dice.below(3) == 0 ? 0 : dice.sign() * down * dice.between(0.1, 1.5),
               tilt = dice.below(3) == 0 ? dice.sign() * down * dice.between(0.1, 0.8) : 0;
  const int across = 6 + dice.below(6), up = std::max(3, static_cast<int>(across * height / width)),
            side = dice.below(4);  // 2, 3: the left or right one rolls
  scene.boundary["displacement:top"].displacement_mm =
      along_x(width, {shear, -down - tilt}, {shear, -down + tilt});
  const auto label = [&](int which) {
    if (side != which) return std::string("force");
    add_roller(scene, "side", {shear, 0});
    return std::string("displacement:side");
  };
  const bool is_pair = number % 5 > 2;
  if (is_pair) {
    scene.boundary["displacement:floor"].displacement_mm = along_x(1, {0, 0}, {0, 0});
    const double wider = number % 5 == 3 ? 0 : dice.between(0.1, 0.5) * width;
    scene.contacts = {
        {.between = {{{"contact:block"}, {"contact:base"}}}, .friction = scene.friction}};
    scene.materials = {{"base", {dice.log_between(20000, 300000), dice.between(0, 0.42)}}};
    testing::add_block(posed.mesh, "base", {-wider, -height}, {width + wider, 0}, across + 1, up,
                       {"displacement:floor", "force", "contact:base", "force"});
  } else if (number % 5 == 1) {
    scene.crown_radius_mm = width * width / 8 / (down * dice.log_between(0.05, 1.5));
  } else if (number % 5 == 2) {
    const double bend = width * dice.between(0.3, 0.6), sign = dice.sign(),
                 slope = dice.between(1e-4, 1e-3);
    const Eigen::Vector2d middle(bend, 0), left(-5, sign * slope * (bend + 5)),
        right(width + 5, sign * slope * (width + 5 - bend));
    scene.wall = dice.below(3) == 0 ? PolylineWall{{middle, {width + 5, 0}}}
                                    : PolylineWall{{left, middle, right}};
  }
  testing::add_block(
      posed.mesh, "block", {0, 0}, {width, height}, across, up,
      {is_pair ? "contact:block" : "contact", label(3), "displacement:top", label(2)});
  validate(posed.mesh);
  return posed;
}

struct Judged : testing::Solved {
  ContactIntervals intervals =
      contact_intervals(system, hybrid.stress, hybrid.F_C, w, error(), {}).value();
  using Solved::Solved;
};

// Cut twice: triangles at the ends of contact faces, at those of the wall's corners, and at the
// peak of the pressure of degree k.
Mesh finer_at_peak(const Posed& posed, const Mesh& mesh, const Judged& solved) {
  const Problem& problem = *solved.system.problem;
  std::vector<Eigen::Vector2d> places;
  const auto add = [&](int row) {
    for (const int v : problem.mesh.boundary[row].vertices)
      places.push_back(problem.mesh.vertices[v]);
  };
  const int m = solved.system.contact.components;
  int at = 0;
  double highest = 0;
  for (int p = 0; p < solved.system.contact.count; ++p) {
    const int row = solved.system.contact.boundary[p];
    const double pressure = -solved.hybrid.F_C(m * p) / problem.frame_at(row, 0, 1).length_mm;
    if (pressure > highest) highest = pressure, at = row;
  }
  add(at);
  for (const std::vector<int>& rows : boundary_chains(problem.mesh, BoundaryRole::contact)) {
    add(rows.front());
    add(rows.back());
  }
  if (posed.scene.wall)
    for (const Eigen::Vector2d& corner : std::get<PolylineWall>(*posed.scene.wall).points_mm)
      places.push_back(corner);
  std::vector<bool> is_near(mesh.vertices.size(), false);
  for (const BoundaryEdge& edge : mesh.boundary) {
    if (edge.role != BoundaryRole::contact) continue;
    const Eigen::Vector2d &a = mesh.vertices[edge.vertices[0]],
                          &b = mesh.vertices[edge.vertices[1]];
    const double length = (b - a).norm();
    for (const Eigen::Vector2d& x : places)
      if ((x - a).norm() + (x - b).norm() < (1 + 1e-6) * length)
        for (const int v : edge.vertices) is_near[static_cast<std::size_t>(v)] = true;
  }
  std::vector<int> cuts;
  for (const auto& triangle : mesh.triangles)
    cuts.push_back(
        std::ranges::any_of(triangle, [&](int v) { return is_near[static_cast<std::size_t>(v)]; })
            ? 2
            : 0);
  return bisected(mesh, cuts).mesh;
}

// The largest pressures of ever finer meshes; it is bounded if the last ones agree.
struct Truth {
  std::vector<double> pressures_MPa;

  explicit Truth(const Posed& posed) {
    Mesh mesh = uniformly_refined(posed.mesh);
    for (int cut = 0; cut < 7; ++cut) {
      const Judged solved(posed.scene, mesh, 3);
      pressures_MPa.push_back(solved.intervals.largest_pressure_MPa);
      mesh = finer_at_peak(posed, mesh, solved);
    }
  }
  double pressure_MPa() const { return pressures_MPa.back(); }
  double change_MPa() const {
    const auto [least, most] = std::minmax_element(pressures_MPa.end() - 3, pressures_MPa.end());
    return *most - *least;
  }
  bool is_bounded() const { return change_MPa() < 1e-3 * pressure_MPa(); }
  bool is_unbounded() const {
    return pressure_MPa() > 1.02 * pressures_MPa[pressures_MPa.size() - 4];
  }
};

TEST(LargestPressure, OfRandomBlocksNoIntervalAndNoWordIsWrong) {
  const testing::Campaign asked = testing::campaign(10);
  int bounded_words = 0, unbounded_words = 0, intervals = 0;
  for (int number = asked.first; number < asked.first + asked.count; ++number) {
    SCOPED_TRACE(number);
    const Posed posed = random_contact(number);
    const Truth truth(posed);
    Bracket common{0, std::numeric_limits<double>::infinity()};
    for (int degree = 1; degree <= highest_stress_degree; ++degree)
      for (const Mesh& mesh : {posed.mesh, uniformly_refined(posed.mesh)}) {
        const ContactIntervals found = Judged(posed.scene, mesh, degree).intervals;
        bounded_words += found.peak == bounded;
        unbounded_words += found.peak == unbounded;
        if (found.peak == bounded) {
          EXPECT_FALSE(truth.is_unbounded()) << degree;
        }
        if (found.peak == unbounded) {
          EXPECT_FALSE(truth.is_bounded()) << degree;
        }
        if (!found.largest_pressure_within_MPa) continue;
        ++intervals;
        const auto [low, high] = *found.largest_pressure_within_MPa;
        EXPECT_LE(low, truth.pressure_MPa() + truth.change_MPa()) << degree;
        EXPECT_GE(high, truth.pressure_MPa() - truth.change_MPa()) << degree;
        common = {std::max(common.low, low), std::min(common.high, high)};
      }
    EXPECT_LE(common.low, common.high) << "two intervals are disjoint";
  }
  if (asked.is_asked_for) return;
  EXPECT_GT(bounded_words, asked.count);  // of eight each
  EXPECT_GT(unbounded_words, asked.count);
  EXPECT_GT(intervals, asked.count);
}

// Lamé's: p (c_1 + c_2) = interference / R, where a ring is c R p wider or narrower at the face.
double lame_MPa(double interference_mm, double inside, double face, double outside,
                const Material& hub, const Material& rim) {
  const auto compliance = [&](const Material& m, double free) {
    const double a = face * face, b = free * free;
    return (1 + m.poisson) / m.young_MPa * ((1 - 2 * m.poisson) * a + b) / std::abs(a - b);
  };
  return interference_mm / face / (compliance(hub, inside) + compliance(rim, outside));
}

TEST(LargestPressure, OfAPressFitIsBoundedAndLames) {
  constexpr double inside = 2, face = 5, outside = 9, interference = 0.01;
  const Material hub = {70000, 0.3}, rim = {210000, 0.33};
  const double lame = lame_MPa(interference, inside, face, outside, hub, rim);
  ASSERT_NEAR(lame, 88.877, 1e-3);
  const auto posed = [&](int around_hub, int around_rim, double friction) {
    Posed fit;
    const std::array<double, 2> quarter = {0, std::acos(0.0)};
    testing::add_ring_sector(fit.mesh, "hub", {inside, 2.75, 3.5, 4.25, face}, around_hub, "force",
                             "contact:hub", {quarter, {"displacement:x1", "displacement:y1"}});
    testing::add_ring_sector(fit.mesh, "rim", {face, 6, 7, 8, outside}, around_rim, "contact:rim",
                             "force", {quarter, {"displacement:x2", "displacement:y2"}});
    fit.mesh.name = "fit";
    validate(fit.mesh);
    fit.scene.crown_radius_mm.reset();
    fit.scene.friction = friction;
    fit.scene.materials = {{"hub", hub}, {"rim", rim}};
    fit.scene.contacts = {{.between = {{{"contact:hub"}, {"contact:rim"}}},
                           .friction = friction,
                           .clearance_mm = -interference}};
    for (const char* group : {"x1", "y1", "x2", "y2"}) add_roller(fit.scene, group, {0, 0});
    for (const char* group : {"contact:hub", "contact:rim"})
      fit.scene.boundary[group].contact.face =
          CircularWall{{0, 0}, face, CircularWall::Bodies::inside};
    return fit;
  };
  int intervals = 0;
  for (const auto& [around_hub, around_rim] : {std::pair{12, 12}, {24, 17}})
    for (const double friction : {0., 0.2})
      for (int degree = 1; degree <= highest_stress_degree; ++degree) {
        SCOPED_TRACE(::testing::Message() << around_hub << " " << friction << " " << degree);
        const Posed fit = posed(around_hub, around_rim, friction);
        const ContactIntervals found = Judged(fit.scene, fit.mesh, degree).intervals;
        EXPECT_EQ(found.peak, bounded);
        if (!found.largest_pressure_within_MPa) continue;
        ++intervals;
        EXPECT_LE(found.largest_pressure_within_MPa->low, lame);
        EXPECT_GE(found.largest_pressure_within_MPa->high, lame);
      }
  EXPECT_GE(intervals, 8);  // slivers where the meshes do not match leave less
}

// A block whose whole face presses on a flat wall, between free sides or two rollers.
PressurePeak word_of_block(double friction, double shear_mm, bool on_roller,
                           double side_angle = 90) {
  constexpr int across = 16;
  Posed block;
  block.scene.crown_radius_mm.reset();
  block.scene.friction = friction;
  block.scene.boundary["displacement:top"].displacement_mm =
      along_x(1, {shear_mm, -0.01}, {shear_mm, -0.01});
  if (on_roller) add_roller(block.scene, "side", {shear_mm, 0});
  const std::string left = on_roller ? "displacement:side" : "force";
  testing::add_block(block.mesh, "block", {0, 0}, {8, 8}, across, across,
                     {"contact", left, "displacement:top", left});
  const double lean = std::tan((90 - side_angle) * std::acos(-1.) / 180);
  for (Eigen::Vector2d& x : block.mesh.vertices) x.x() += (x.x() - 4) / 4 * lean * (8 - x.y());
  validate(block.mesh);
  return Judged(block.scene, block.mesh, 2).intervals.peak;
}

TEST(LargestPressure, AtTheEndOfAFaceIsBoundedOnlyWhereReflectionSaysSo) {
  EXPECT_EQ(word_of_block(0, 0, false), bounded);
  EXPECT_EQ(word_of_block(0, 0, false, 70), bounded);
  EXPECT_NE(word_of_block(0, 0, false, 110), bounded);
  EXPECT_EQ(word_of_block(0, 0.003, true), bounded);
  EXPECT_EQ(word_of_block(10, 0, true), bounded);      // sticks
  EXPECT_EQ(word_of_block(10, 0, false), unbounded);   // sticks at free sides: r^−0.29
  EXPECT_NE(word_of_block(0.3, 0.02, true), bounded);  // slips towards one roller
  EXPECT_NE(word_of_block(0.3, 0.02, false), bounded);
}

// Into a wall's protruding corner, p grows like ln(1/r); from a receding one the block lifts.
TEST(LargestPressure, AtACornerOfTheWallIsUnboundedIfItProtrudes) {
  for (const double sign : {-1., 1.}) {
    Posed block;
    block.scene.crown_radius_mm.reset();
    block.scene.friction = 0;
    block.scene.displacement_mm = {0, -0.02};
    block.scene.wall = PolylineWall{{{-5, 0.001 * sign * 9}, {4, 0}, {13, 0.001 * sign * 9}}};
    testing::add_block(block.mesh, "block", {0, 0}, {8, 8}, 32, 16,
                       {"contact", "force", "displacement", "force"});
    validate(block.mesh);
    const PressurePeak word = Judged(block.scene, block.mesh, 2).intervals.peak;
    EXPECT_EQ(word, sign < 0 ? unbounded : bounded) << sign;
  }
}

}  // namespace
}  // namespace airybench::pressure_peak_test
