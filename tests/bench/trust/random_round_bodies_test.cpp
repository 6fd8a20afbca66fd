// Total errors of fifty round bodies, each a quarter with an elliptic hole and rim under tractions
// that a closed form leaves on both. (On chords, as degree 1 has them, these would not be linear.)
#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/arcs.hpp"
#include "mesh/transform.hpp"
#include "tests/bench/verify/solved.hpp"
#include "tests/bench/verify/true_error.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/kolosov_fields.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::random_round_bodies_test {
namespace {

using testing::Complex, testing::Dice, testing::KolosovField;
using Point = Eigen::Vector2d;

// f and g of odd powers with real coefficients: symmetric about both axes.
KolosovField symmetric_field(Dice& dice, double poisson) {
  constexpr std::array powers = {-3, -1, 1, 3};
  std::array<double, 4> of_f{}, of_g{};
  for (double& c : of_f) c = dice.between(-1, 1);
  for (double& c : of_g) c = dice.between(-1, 1);
  return {poisson,
          [=](Complex z) {
            std::array<Complex, 3> f{};
            for (std::size_t i = 0; i < powers.size(); ++i) {
              const int n = powers[i];
              const double c = of_f[i] * std::pow(0.3, std::max(0, n - 1));
              f[0] += c * std::pow(z, n);
              f[1] += c * double(n) * std::pow(z, n - 1);
              f[2] += c * double(n * (n - 1)) * std::pow(z, n - 2);
            }
            return f;
          },
          [=](Complex z) {
            std::array<Complex, 2> g{};
            for (std::size_t i = 0; i < powers.size(); ++i) {
              const int n = powers[i];
              const double c = of_g[i] * std::pow(0.3, std::max(0, n - 1));
              g[0] += c * std::pow(z, n);
              g[1] += c * double(n) * std::pow(z, n - 1);
            }
            return g;
          }};
}

Problem round_body(Dice& dice, const KolosovField& field) {
  const double outer = dice.between(1.5, 4);
  const int around = 4 + dice.below(7);
  const int across = std::max(1, static_cast<int>(around * std::log(outer) / 1.6));
  Mesh mesh = testing::quarter_ring(around, across, 1, outer);
  EXPECT_EQ(recognise_arcs(mesh), 2 * around);
  MeshTransform stretched;
  stretched.stretch = {dice.log_between(0.6, 1.6), 1};
  mesh = transformed(std::move(mesh), stretched);
  Loads loads;
  for (const BoundaryEdge& edge : mesh.boundary)
    loads.rollers.push_back(edge.role == BoundaryRole::displacement);
  loads.traction_MPa = [field](const Point& x, const Point& n, int) {
    return traction(field.stress(testing::point(x)), n);
  };
  return make_problem(std::move(mesh), {field.C()}, std::move(loads), 0);
}

TEST(RandomRoundBodies, TotalErrorsAreAboveTheTrueOnesAndNotByMuch) {
  constexpr int bodies = testing::sanitized ? 10 : 50;
  Dice dice(73);
  std::array<std::vector<double>, highest_stress_degree> ratio;
  for (int body = 0; body < bodies; ++body) {
    const KolosovField field = symmetric_field(dice, dice.between(0, 0.45));
    const Problem problem = round_body(dice, field);
    for (int degree = 2; degree <= highest_stress_degree; ++degree) {
      const testing::Solved solved(problem, degree);
      const ConstitutiveError error = solved.error();
      EXPECT_EQ(error.flaw, "");
      const double truth = testing::true_error(problem, solved.hybrid.stress, [&](const Point& x) {
        return field.stress(testing::point(x));
      });
      ratio[static_cast<std::size_t>(degree - 1)].push_back(error.relative / truth);
      EXPECT_GT(error.relative, truth) << "body " << body << ", degree " << degree;
      EXPECT_LT(error.relative, 2.5 * truth) << "body " << body << ", degree " << degree;
    }
  }
  for (int degree = 2; degree <= highest_stress_degree; ++degree) {
    auto& of_degree = ratio[static_cast<std::size_t>(degree - 1)];
    std::ranges::sort(of_degree);
    std::cout << "degree " << degree << ": " << of_degree.front() << " to " << of_degree.back()
              << ", median " << of_degree[bodies / 2] << "\n";
  }
}

}  // namespace
}  // namespace airybench::random_round_bodies_test
