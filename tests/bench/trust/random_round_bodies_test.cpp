// Total errors of round bodies, each a quarter with an elliptic hole and rim under tractions
// that a closed form leaves on both. (On chords, as degree 1 has them, these would not be linear.)
#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/arcs.hpp"
#include "mesh/transform.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/kolosov_fields.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/support/small_meshes.hpp"
#include "tests/verify/solved_body.hpp"
#include "tests/verify/true_error.hpp"

namespace airybench::random_round_bodies_test {
namespace {

using testing::Complex, testing::Dice, testing::KolosovField;
using Point = Eigen::Vector2d;

// A sum of odd powers with real coefficients: its value, and as many derivatives but one.
class OddPowers {
 public:
  explicit OddPowers(Dice& dice) {
    for (double& c : coefficient_) c = dice.between(-1, 1);
  }
  template <std::size_t count>
  std::array<Complex, count> at(Complex z) const {
    std::array<Complex, count> result{};
    for (std::size_t i = 0; i < powers.size(); ++i) {
      int n = powers[i];
      double c = coefficient_[i] * std::pow(0.3, std::max(0, n - 1));
      for (Complex& derivative : result) {
        derivative += c * std::pow(z, n);
        c *= n--;
      }
    }
    return result;
  }

 private:
  static constexpr std::array powers = {-3, -1, 1, 3};
  std::array<double, powers.size()> coefficient_{};
};

// Symmetric about both axes.
KolosovField symmetric_field(Dice& dice, double poisson) {
  const OddPowers f(dice), g(dice);
  return {poisson, [=](Complex z) { return f.at<3>(z); }, [=](Complex z) { return g.at<2>(z); }};
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
      EXPECT_GT(error.relative, truth) << "body " << body << ", degree " << degree;
      EXPECT_LT(error.relative, 2.5 * truth) << "body " << body << ", degree " << degree;
    }
  }
}

}  // namespace
}  // namespace airybench::random_round_bodies_test
