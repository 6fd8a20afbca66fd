#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/plan/scene_file.hpp"
#include "solvers/loading/load_steps.hpp"
#include "solvers/methods.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posed.hpp"

namespace airybench::friction_loop_test {
namespace {

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

}  // namespace
}  // namespace airybench::friction_loop_test
