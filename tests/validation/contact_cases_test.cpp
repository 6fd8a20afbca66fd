// Contact problems whose answers are published or known in closed form. Sources:
// docs/validation.md. What is found is committed in tests/data/validation/profiles.csv.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "assembly/control_points.hpp"
#include "assembly/elements/edge_forces.hpp"
#include "assembly/total_displacement.hpp"
#include "bench/plan/scene_file.hpp"
#include "solvers/condensation/hybridized.hpp"
#include "solvers/contact/condensed.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "solvers/loading/load_steps.hpp"
#include "solvers/methods.hpp"
#include "tests/support/condensed.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/solved.hpp"
#include "tests/validation/committed_profiles.hpp"
#include "tests/validation/edge_tractions.hpp"

namespace airybench::contact_cases_test {
namespace {

using testing::EdgeTraction;
using testing::expect_committed;
using testing::fitted;

// The contact face of a solved problem: forces by HYBRID, displacements by both.
struct Face {
  std::shared_ptr<const Problem> problem;
  ContactSystem system;
  Eigen::VectorXd F_C, slip;  // per contact point: N; ū_t over the wall, mm
  DisplacementField u;        // by P2
  std::vector<EdgeTraction> edges;

  Face(const char* mesh, const char* scene_name, int refined) {
    Scene scene = read_scene(testing::test_data(std::string("validation/") + scene_name + ".json"));
    scene.mesh.refine = refined;
    problem = testing::posed(
        scene, read_msh(testing::test_data(std::string("validation/") + mesh + ".msh")));
    system = contact_system(problem);
    RunControl control;
    control.contact.max_iterations = 50;  // then active sets
    Solution solution;
    const contact::Problem condensed = testing::condensed(*problem, system.contact);
    solve_condensed_contact(condensed, control, solution);
    EXPECT_EQ(solution.status, Status::ok) << solution.message;
    F_C = solution.F_C;
    edges = testing::edge_tractions(*problem, system.contact, F_C);
    const Eigen::VectorXd r =
        relative_to_gap(system.contact, Eigen::VectorXd(condensed.D * F_C - condensed.G));
    slip = Eigen::VectorXd::Zero(system.contact.count);
    for (int p = 0; p < system.contact.count && system.contact.components == 2; ++p)
      slip(p) = r(2 * p + 1);
    const Solution displacements = testing::solved_by("P2", system, control);
    EXPECT_EQ(displacements.status, Status::ok) << displacements.message;
    u = with_rigid_motion(*problem, testing::displacement(displacements));
  }
  double resultant(int component) const {
    double sum = 0;
    for (int i = component; i < F_C.size(); i += system.contact.components) sum += F_C(i);
    return std::abs(sum);
  }
};

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
  for (int e = 0; e < face.system.contact.count / 2; ++e) {
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
    for (const EdgeTraction& edge : face.edges) {
      const double x = edge.start.x();
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
    const auto normal = fitted(face.edges, 0.2, &EdgeTraction::pressure);
    const auto stick = fitted(face.edges, 0.3, [](auto& e) { return mu * e.pressure - e.shear; });
    const double a = hertz_half_width(P), p0 = 2 * P / (std::numbers::pi * a),
                 c = a * std::sqrt(1 - Q / (mu * P));
    const double worst =
        std::max({std::abs(normal.half_width / a - 1), std::abs(normal.height / p0 - 1),
                  std::abs(stick.half_width / c - 1)});
    expect_committed("cattaneo_mindlin", refined,
                     {{"P", P},
                      {"Q", Q},
                      {"a", normal.half_width},
                      {"p0", normal.height},
                      {"c", stick.half_width}});
    EXPECT_LT(worst, before) << refined;
    before = worst;
    if (refined < 2) continue;
    EXPECT_LT(worst, 0.01);
    // Published for P = 10, Q = 0.936 N/mm.
    EXPECT_NEAR(normal.half_width / 0.6808, 1, 0.01);
    EXPECT_NEAR(normal.height / 9.351, 1, 0.01);
    EXPECT_NEAR(stick.half_width / 0.4965, 1, 0.01);
    for (const EdgeTraction& edge : face.edges) {
      // Mindlin's shear where it sticks: not shifted, nothing added by the body's other end.
      const double x = edge.middle().x();
      if (std::abs(x) < 0.9 * c) {
        EXPECT_NEAR(
            edge.shear,
            mu * p0 * (std::sqrt(1 - x * x / (a * a)) - c / a * std::sqrt(1 - x * x / (c * c))),
            0.01 * mu * p0)
            << x;
      }
    }
    expect_committed("cattaneo_mindlin", refined, face.edges);
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
        [&](int step, const ContactSystem& system, const Solution& answer) {
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
    const auto found = fitted(face.edges, 0.2, &EdgeTraction::pressure);
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
    for (const EdgeTraction& edge : face.edges) {
      const double x = edge.middle().x();
      if (refined == 2) expect_committed("punch", refined, "pressure", x, edge.pressure, 100);
      if (std::abs(x) > 0.8) continue;
      const double a = edge.start.x(), b = edge.end.x();  // the mean of P/(π √(1 − x²)) over it
      const double exact = P / std::numbers::pi * (std::asin(b) - std::asin(a)) / (b - a);
      worst = std::max(worst, std::abs(edge.pressure / exact - 1));
    }
    expect_committed("punch", refined, "worst deviation for |x| < 0.8", 0, worst, 1);
    EXPECT_LT(worst, before) << refined;
    before = worst;
  }
  EXPECT_LT(before, 0.01);
}

}  // namespace
}  // namespace airybench::contact_cases_test
