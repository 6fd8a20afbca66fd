// Contact problems whose answers are published or known in closed form. Sources:
// docs/validation.md. What is found is committed in tests/data/validation/profiles.csv.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "assembly/control_points.hpp"
#include "assembly/edge_forces.hpp"
#include "bench/plan/scene_file.hpp"
#include "solvers/condensation/hybridized.hpp"
#include "solvers/contact/condensed.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "solvers/loading/load_steps.hpp"
#include "solvers/methods.hpp"
#include "tests/bench/studies/expected_table.hpp"
#include "tests/support/condensed.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/solved.hpp"

namespace airybench::contact_cases_test {
namespace {

testing::ExpectedTable& table() {
  static auto* const own = static_cast<testing::ExpectedTable*>(::testing::AddGlobalTestEnvironment(
      new testing::ExpectedTable(testing::test_data("validation/profiles.csv"), 4)));
  return *own;
}
const testing::ExpectedTable& opened = table();

// Compares with the committed value, or notes this one. `size`: of such values.
void expect_committed(const std::string& what, int refined, const std::string& quantity, double x,
                      double value, double size) {
  const testing::ExpectedTable::Row key = {what, std::to_string(refined), quantity,
                                           fmt::format("{:.6g}", x)};
  if (testing::update() != testing::Update::no)
    return table().note(key, {fmt::format("{:.8g}", value)});
  const auto* row = table().find(key);
  ASSERT_NE(row, nullptr) << what << " " << quantity << " at " << x;
  EXPECT_NEAR(value, std::stod(row->front()), 1e-6 * size)
      << what << " " << quantity << " at " << x;
}

// The contact face of a solved problem: forces by HYBRID, displacements by both.
struct Face {
  std::shared_ptr<const Problem> problem;
  DualSystem system;
  Eigen::VectorXd F_C, slip;  // per contact point: N; ū_t over the wall, mm
  DisplacementField u;        // by P2

  Face(const char* mesh, const char* scene_name, int refined) {
    Scene scene = read_scene(testing::test_data(std::string("validation/") + scene_name + ".json"));
    scene.mesh.refine = refined;
    problem = testing::posed(
        scene, read_msh(testing::test_data(std::string("validation/") + mesh + ".msh")));
    system = assemble(problem, Blocks::contact_points);
    RunControl control;
    control.contact.most_iterations = 50;  // then active sets
    Solution solution;
    const contact::Problem condensed = testing::condensed(*problem, system.contact);
    solve_condensed_contact(condensed, control, solution);
    EXPECT_EQ(solution.status, Status::ok) << solution.message;
    F_C = solution.F_C;
    const Eigen::VectorXd r =
        relative_to_gap(system.contact, Eigen::VectorXd(condensed.D * F_C - condensed.G));
    slip = Eigen::VectorXd::Zero(system.contact.count);
    for (int p = 0; p < system.contact.count && system.contact.components == 2; ++p)
      slip(p) = r(2 * p + 1);
    const Solution displacements = testing::solved_by("P2", system, control);
    EXPECT_EQ(displacements.status, Status::ok) << displacements.message;
    u = with_rigid_motion(*problem, displacements.displacement);
  }
  int edges() const { return system.contact.count / 2; }
  std::array<Eigen::Vector2d, 2> ends(int edge) const {
    const auto [a, b] = problem->mesh.boundary[system.contact.boundary[2 * edge]].vertices;
    return {problem->mesh.vertices[a], problem->mesh.vertices[b]};
  }
  // Mean traction of an edge, MPa: pressure and shear.
  double mean(int edge, int component) const {
    const int m = system.contact.components;
    const auto [a, b] = ends(edge);
    return (F_C(2 * m * edge + component) + F_C(2 * m * edge + m + component)) / (b - a).norm();
  }
  double pressure(int edge) const { return -mean(edge, 0); }
  double shear(int edge) const {
    return system.contact.components == 2 ? std::abs(mean(edge, 1)) : 0;
  }
  double middle(int edge) const { return (ends(edge)[0].x() + ends(edge)[1].x()) / 2; }
  double resultant(int component) const {
    double sum = 0;
    for (int i = component; i < F_C.size(); i += system.contact.components) sum += F_C(i);
    return std::abs(sum);
  }
};

// y² = A + B x + C x² through the points with y above `least` times the largest: the half width of
// an ellipse of pressure and its height.
struct Ellipse {
  double half_width, height;
};
Ellipse fitted(const Face& face, double least, const std::function<double(int edge)>& y) {
  double largest = 0;
  for (int e = 0; e < face.edges(); ++e) largest = std::max(largest, y(e));
  std::vector<Eigen::Vector4d> rows;
  for (int e = 0; e < face.edges(); ++e)
    if (const double x = face.middle(e); y(e) > least * largest)
      rows.emplace_back(1, x, x * x, y(e) * y(e));
  const Eigen::Map<const Eigen::Matrix4Xd> all(rows.front().data(), 4,
                                               static_cast<Eigen::Index>(rows.size()));
  const Eigen::VectorXd c =
      testing::least_squares(all.topRows<3>().transpose(), all.row(3).transpose());
  const double height_squared = c(0) - c(1) * c(1) / (4 * c(2));
  return {std::sqrt(-height_squared / c(2)), std::sqrt(height_squared)};
}

constexpr double radius = 4, composite_modulus = 82.4286 / (1 - 0.4999 * 0.4999);
double hertz_half_width(double P) {
  return std::sqrt(4 * P * radius / (std::numbers::pi * composite_modulus));
}

// Test SSNV128: means of many codes, micrometres, with 5 % spread.
constexpr std::array<std::pair<double, double>, 5> published = {
    {{0, 28.6}, {1.25, 27.2}, {5, 22.8}, {7.5, 19.8}, {11.25, 15.0}}};

// Tangential displacement of the floor at x, micrometres, towards +x: by P2 at the vertex, by
// HYBRID from the edges' moments, u_a = 2 ū_a − ū_b, the mean of both sides.
std::pair<double, double> floor_displacement(const Face& face, double x) {
  double sum = 0, p2 = 0;
  int count = 0;
  for (int e = 0; e < face.edges(); ++e) {
    const auto [a, b] = face.problem->mesh.boundary[face.system.contact.boundary[2 * e]].vertices;
    const auto& vertices = face.problem->mesh.vertices;
    const double tangent = edge_frame(vertices[a], vertices[b]).tangent.x();
    for (const int end : {0, 1}) {
      const int v = end == 0 ? a : b;
      if (std::abs(vertices[v].x() - x) > 1e-9) continue;
      sum += tangent * (2 * face.slip(2 * e + end) - face.slip(2 * e + 1 - end));
      p2 = face.u(0, v);
      ++count;
    }
  }
  EXPECT_GT(count, 0) << x;
  return {1e3 * sum / count, 1e3 * p2};
}

TEST(FrictionBlock, AgreesWithThePublishedMeanAndKnowsItsOwnErrorBetter) {
  std::array<double, 5> gap_before{};
  for (const int refined : {0, 1, 2}) {
    const Face face("friction_block", "friction_block", refined);
    for (std::size_t k = 0; k < published.size(); ++k) {
      const auto [x, mean] = published[k];
      const auto [stress, displacement] = floor_displacement(face, x);
      expect_committed("friction_block", refined, "u_x HYBRID", x, stress, 30);
      expect_committed("friction_block", refined, "u_x P2", x, displacement, 30);
      EXPECT_NEAR(stress / mean, 1, 0.05) << x;
      EXPECT_NEAR(displacement / mean, 1, 0.05) << x;
      const double gap = std::abs(stress - displacement) / mean;
      if (refined > 0) {
        EXPECT_LT(gap, gap_before[k]) << x;
      }
      gap_before[k] = gap;
    }
    // Two discrete problems, one with stresses and one with displacements that are admissible.
    if (refined < 2) continue;
    EXPECT_LT(*std::ranges::max_element(gap_before), 1e-4);
    for (int e = 0; e < face.edges(); ++e) {
      const double x = face.ends(e)[0].x();
      expect_committed("friction_block", refined, "floor HYBRID", x,
                       floor_displacement(face, x).first, 30);
    }
  }
}

TEST(CattaneoMindlin, ConvergesToHalfWidthsAndPressure) {
  double before = 1;
  for (const int refined : {0, 1, 2}) {
    const Face face("half_plane", "cattaneo_mindlin", refined);
    constexpr double mu = 0.2;
    const double P = face.resultant(0), Q = face.resultant(1);
    const auto normal = fitted(face, 0.2, [&](int e) { return face.pressure(e); });
    const auto stick =
        fitted(face, 0.3, [&](int e) { return mu * face.pressure(e) - face.shear(e); });
    const double a = hertz_half_width(P), p0 = 2 * P / (std::numbers::pi * a),
                 c = a * std::sqrt(1 - Q / (mu * P));
    const double worst =
        std::max({std::abs(normal.half_width / a - 1), std::abs(normal.height / p0 - 1),
                  std::abs(stick.half_width / c - 1)});
    for (const auto& [quantity, value] : {std::pair("P", P),
                                          {"Q", Q},
                                          {"a", normal.half_width},
                                          {"p0", normal.height},
                                          {"c", stick.half_width}})
      expect_committed("cattaneo_mindlin", refined, quantity, 0, value, 1);
    EXPECT_LT(worst, before) << refined;
    before = worst;
    if (refined < 2) continue;
    EXPECT_LT(worst, 0.01);
    // Published for P = 10, Q = 0.936 N/mm.
    EXPECT_NEAR(normal.half_width / 0.6808, 1, 0.01);
    EXPECT_NEAR(normal.height / 9.351, 1, 0.01);
    EXPECT_NEAR(stick.half_width / 0.4965, 1, 0.01);
    for (int e = 0; e < face.edges(); ++e) {
      // Mindlin's shear where it sticks: not shifted, nothing added by the body's other end.
      const double x = face.middle(e);
      if (std::abs(x) < 0.9 * c) {
        EXPECT_NEAR(
            face.shear(e),
            mu * p0 * (std::sqrt(1 - x * x / (a * a)) - c / a * std::sqrt(1 - x * x / (c * c))),
            0.01 * mu * p0)
            << x;
      }
      expect_committed("cattaneo_mindlin", refined, "pressure", face.middle(e), face.pressure(e),
                       10);
      expect_committed("cattaneo_mindlin", refined, "shear", face.middle(e), face.shear(e), 10);
    }
  }
}

// To and fro under constant pressure, Q between ±q μP, E* = E/(1 − ν²). Mindlin and Deresiewicz's
// loop in the plane:  W = (μP)²/(πE*) (4 (1 − q) ln(1 − q) + 2q (2 − q)),  whatever the body behind
// the contact.
TEST(CattaneoMindlin, AStepwiseLoopDissipatesWhatTheClosedFormSays) {
  constexpr double mu = 0.2, travel_mm = 0.1;
  double area_off = 1;
  for (const int n : {4, 8}) {
    Scene scene = read_scene(testing::test_data("validation/cattaneo_mindlin.json"));
    const double pressed_mm = scene.displacement_mm.y();
    scene.displacement_mm.x() = 0;
    std::vector<double> moved;
    for (int k = 1; k <= 5 * n; ++k)  // to 1, back to −1, to 1
      moved.push_back(travel_mm * (k <= n ? k : k <= 3 * n ? 2 * n - k : k - 4 * n) / n);
    for (const double x : moved) {
      scene.later_steps.emplace_back();
      scene.later_steps.back().displacement_mm = Eigen::Vector2d(x, pressed_mm);
    }
    double P = 0, Q_before = 0, highest = 0, lowest = 0, dissipated = 0, area = 0;
    solve_load_steps(
        select_methods("HYBRID").front(),
        testing::posed(scene, read_msh(testing::test_data("validation/half_plane.msh"))), {},
        [&](int step, const DualSystem& system, const Solution& answer) {
          ASSERT_EQ(answer.status, Status::ok) << answer.message;
          double Q = 0;  // of the body on the wall
          P = 0;
          for (int p = 0; p < system.contact.count; ++p) {
            P -= answer.F_C(2 * p);
            Q -= answer.F_C(2 * p + 1);
          }
          if (step > n) {
            dissipated += dissipation_Nmm(system, answer);
            area += (Q + Q_before) / 2 * (moved[step - 1] - moved[step - 2]);
          }
          highest = std::max(highest, Q);
          lowest = std::min(lowest, Q);
          Q_before = Q;
        });
    const double q = (highest - lowest) / 2 / (mu * P), E = 82.4286 / (1 - 0.4999 * 0.4999);
    EXPECT_NEAR(q, 0.75, 0.01);
    const double closed = mu * P * mu * P / (std::numbers::pi * E) *
                          (4 * (1 - q) * std::log(1 - q) + 2 * q * (2 - q));
    EXPECT_NEAR(dissipated / closed, 1, 0.003) << n;
    // ∮ Q dU by trapezoids knows only the steps' ends.
    EXPECT_LT(std::abs(area / closed - 1), area_off / 2) << n;
    area_off = std::abs(area / closed - 1);
  }
  EXPECT_LT(area_off, 0.01);
}

TEST(Hertz, TheHalfWidthGrowsWithTheRootOfTheLoad) {
  for (const char* load : {"hertz_1", "hertz_2", "hertz_3"}) {
    const Face face("half_plane", load, 1);
    const double P = face.resultant(0), a = hertz_half_width(P);
    const auto found = fitted(face, 0.2, [&](int e) { return face.pressure(e); });
    EXPECT_NEAR(found.half_width / a, 1, 0.01) << load;
    EXPECT_NEAR(found.height / (2 * P / (std::numbers::pi * a)), 1, 0.01) << load;
    expect_committed(load, 1, "P", 0, P, 10);
    expect_committed(load, 1, "a", 0, found.half_width, 1);
    expect_committed(load, 1, "p0", 0, found.height, 10);
  }
}

TEST(FlatPunch, HasTheSquareRootPressure) {
  double before = 1;
  for (const int refined : {0, 1, 2}) {
    const Face face("punch", "punch", refined);
    const double P = face.resultant(0);
    expect_committed("punch", refined, "P", 0, P, 10);
    double worst = 0;
    for (int e = 0; e < face.edges(); ++e) {
      const double x = face.middle(e);
      if (refined == 2) expect_committed("punch", refined, "pressure", x, face.pressure(e), 100);
      if (std::abs(x) > 0.8) continue;
      const auto [a, b] = face.ends(e);  // the mean of P/(π √(1 − x²)) over the edge
      const double exact =
          P / std::numbers::pi * (std::asin(b.x()) - std::asin(a.x())) / (b.x() - a.x());
      worst = std::max(worst, std::abs(face.pressure(e) / exact - 1));
    }
    expect_committed("punch", refined, "worst deviation for |x| < 0.8", 0, worst, 1);
    EXPECT_LT(worst, before) << refined;
    before = worst;
  }
  EXPECT_LT(before, 0.01);
}

}  // namespace
}  // namespace airybench::contact_cases_test
