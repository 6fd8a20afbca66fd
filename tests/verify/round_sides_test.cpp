// Stresses of degree 2 and more follow curved force edges: closed forms, with the order k + 1.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verify/round_bodies.hpp"
#include "tests/verify/solved_body.hpp"
#include "verify/reference.hpp"
#include "verify/verifier.hpp"

namespace airybench::round_sides_test {
namespace {

using testing::ExactStress, testing::pressed, testing::quarter, testing::Rim,
    testing::RingInASocket, testing::stretched, testing::true_error, testing::value_at;
using Point = Eigen::Vector2d;

struct Judged {
  double truth, total;
  double of_hole;  // the worst hoop stress there is off by this
};

Judged judged(const Problem& problem, int degree, const ExactStress& exact) {
  const testing::Solved solved(problem, degree);
  const ConstitutiveError error = solved.error();
  EXPECT_EQ(error.flaw, "");
  Judged result{true_error(*solved.system.problem, solved.hybrid.stress, exact), error.relative, 0};
  for (const Problem::RoundTriangle& round : problem.round)
    for (int k = 0; k < 3; ++k) {
      const int row = round.rows[k];
      if (row == Problem::no_row ||
          boundary_label(problem.mesh, problem.mesh.boundary[row]) != "force:hole")
        continue;
      for (const double s : {0., 0.25, 0.5, 1.}) {
        const Point x = problem.mesh.boundary[row].curve.at(s);
        const TriangleVertices v = problem.vertices_of(round.triangle);
        const Point centroid = v.rowwise().mean(), a = v.col(k), b = v.col((k + 1) % 3);
        Eigen::Matrix3d corners;
        corners << a, b, centroid, 1, 1, 1;
        const Eigen::Vector3d at = corners.inverse() * Eigen::Vector3d(x.x(), x.y(), 1);
        const Point t(-x.y(), x.x());
        const auto hoop = [&](const Eigen::Vector3d& stress) { return t.dot(traction(stress, t)); };
        result.of_hole = std::max(
            result.of_hole,
            std::abs(hoop(value_at(solved.hybrid.stress, round.triangle, k, at(1), at(2))) -
                     hoop(exact(x))));
      }
    }
  return result;
}

void expect_order(const ExactStress& exact, double outer_mm, int across, double poisson,
                  Rim rim = Rim::loaded) {
  for (int degree = 2; degree <= highest_stress_degree; ++degree) {
    SCOPED_TRACE(::testing::Message() << "degree " << degree << ", Poisson " << poisson);
    const Judged coarse = judged(quarter(4, across, outer_mm, exact, poisson, rim), degree, exact),
                 fine =
                     judged(quarter(8, 2 * across, outer_mm, exact, poisson, rim), degree, exact);
    const double order = std::log2(coarse.truth / fine.truth),
                 of_hole = std::log2(coarse.of_hole / fine.of_hole);
    EXPECT_GT(order, degree + 0.7);
    EXPECT_GT(of_hole, degree + 0.5);
    for (const Judged& own : {coarse, fine}) {
      EXPECT_GT(own.total, own.truth);
      EXPECT_LT(own.total, testing::most_overestimated(poisson, rim) * own.truth);
    }
  }
}

TEST(RoundSides, RingsUnderPressureAreOfFullOrder) { testing::for_pressed_rings(expect_order); }

// Rollers on one circle would let a ring turn: their chords do not.
TEST(RoundSides, RollersThatAloneWouldLetTheBodyTurnAreChords) {
  for (const bool is_alone : {true, false}) {
    Problem problem = quarter(4, 2, 2, pressed, 0.3, Rim::rolling);
    Mesh mesh = problem.mesh;
    Loads loads = problem.loads;
    for (std::size_t row = 0; row < mesh.boundary.size() && is_alone; ++row)
      if (boundary_label(mesh, mesh.boundary[row]) != "displacement:rim") {
        mesh.boundary[row].role = BoundaryRole::force;
        loads.rollers[row] = false;
      }
    problem = make_problem(std::move(mesh), problem.compliance, std::move(loads), 0);
    for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row)
      if (const BoundaryEdge& edge = problem.mesh.boundary[row]; !edge.curve.is_straight()) {
        const bool is_rim = boundary_label(problem.mesh, edge) == "displacement:rim";
        EXPECT_EQ(problem.follows_curve(row, 2), !is_alone || !is_rim);
      }
    const testing::Solved solved(problem, 2);
    EXPECT_EQ(solved.error().flaw, "");
  }
}

TEST(RoundSides, ARingInASocketIsOfFullOrder) {
  for (const double friction : {0., 0.2})
    for (int degree = 2; degree <= highest_stress_degree; ++degree) {
      SCOPED_TRACE(::testing::Message() << "degree " << degree << ", friction " << friction);
      std::vector<double> truth, of_pressure;
      for (const int around : {4, 8}) {
        const testing::Solved solved(RingInASocket::scene(friction), RingInASocket::mesh(around),
                                     degree);
        const ConstitutiveError error = solved.error();
        EXPECT_EQ(error.flaw, "");
        truth.push_back(
            true_error(*solved.system.problem, solved.hybrid.stress, RingInASocket::exact));
        EXPECT_GT(error.relative, truth.back());
        EXPECT_LT(error.relative, 2.5 * truth.back());
        const ContactPoints& points = solved.system.contact;
        double worst = 0;
        for (int p = 0; p < points.count; ++p) {
          const EdgeFrame frame = solved.system.problem->frame_of_moment(points.boundary[p], degree,
                                                                         p % points.per_edge);
          worst = std::max(worst, std::abs(-(degree + 1) / frame.length_mm *
                                               solved.hybrid.F_C(points.components * p) -
                                           RingInASocket::pressure));
        }
        of_pressure.push_back(worst / RingInASocket::pressure);
      }
      EXPECT_GT(std::log2(truth[0] / truth[1]), degree + 0.7);
      EXPECT_GT(std::log2(of_pressure[0] / of_pressure[1]), degree + 0.5);
    }
}

TEST(RoundSides, AHoleUnderTensionIsOfFullOrder) { expect_order(stretched, 4, 4, 0.3); }

TEST(RoundSides, TheLargestStressAtAHoleIsThatOfTheRoundOne) {
  const Judged own = judged(quarter(16, 16, 4, stretched, 0.3), 2, stretched);
  EXPECT_LT(own.of_hole, 0.01);  // of 3 MPa
  EXPECT_LT(own.truth, 3e-4);
}

TEST(RoundSides, AreInBalanceUnderTheirOwnWeightToo) {
  for (const Rim rim : {Rim::loaded, Rim::rolling})
    for (int degree = 2; degree <= highest_stress_degree; ++degree) {
      Problem problem = quarter(4, 3, 3, pressed, 0.3, rim);
      problem.loads.body_force_N_per_mm3 = {3, -2};
      const testing::Solved solved(problem, degree);
      const Verification v = verify(solved.system, solved.hybrid, nullptr);
      EXPECT_LT(*v.equilibrium_residual, 1e-11) << degree;
      EXPECT_LT(*v.unbalanced_N, 1e-10) << degree;
    }
}

TEST(RoundSides, OfAFreeBodyAreInBalanceToo) {
  const testing::RingInSocket ring;
  for (int degree = 1; degree <= highest_stress_degree; ++degree) {
    const testing::Solved solved(ring.scene, ring.mesh, degree);
    const Verification v = verify(solved.system, solved.hybrid, nullptr);
    EXPECT_LT(*v.equilibrium_residual, 1e-10) << degree;
    EXPECT_LT(*v.unbalanced_N, 1e-9) << degree;
  }
}

TEST(RoundSides, TheReferenceFollowsThemToo) {
  for (const Rim rim : {Rim::loaded, Rim::rolling})
    for (int degree = 1; degree <= highest_stress_degree; ++degree) {
      const ExactStress exact = rim == Rim::loaded ? stretched : pressed;
      const testing::Solved solved(quarter(6, 4, 4, exact, 0.3, rim), degree);
      const auto reference = compute_reference(solved.system);
      const Verification v = verify(solved.system, solved.hybrid, &reference);
      EXPECT_LT(*v.error_stress, 1e-11) << degree;
      EXPECT_LT(*v.equilibrium_residual, 1e-11) << degree;
      EXPECT_LT(*verify(solved.system, solved.hybrid, nullptr).stress_of_moments_off, 1e-11)
          << degree;
    }
}

}  // namespace
}  // namespace airybench::round_sides_test
