#include "assembly/elements/curved_element.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <numbers>

#include "assembly/elements/elasticity.hpp"
#include "assembly/elements/equilibrium_element.hpp"
#include "mesh/edge_curve.hpp"
#include "support/wide.hpp"

namespace airybench::curved_element_test {
namespace {

using Point = Eigen::Vector2d;

const Eigen::Matrix3d steel = compliance({200000, 0.3}, Plane::strain);

TriangleVertices triangle() {
  TriangleVertices v;
  v << 1, 3, 1.6, 0.5, 1, 2.7;
  return v;
}

// An arc from a to b that turns by this, to the right of its chord where it is positive.
std::vector<Point> arc(const Point& a, const Point& b, double turn_rad) {
  const Point chord = b - a;
  std::vector<Point> points;
  const double radius = chord.norm() / (2 * std::sin(turn_rad / 2));
  const Point along = chord.normalized(), right(along.y(), -along.x());
  for (int i = 0; i <= EdgeCurve::max_degree; ++i) {
    const double angle = turn_rad * (static_cast<double>(i) / EdgeCurve::max_degree - 0.5);
    points.emplace_back(
        (a + b) / 2 +
        radius * (std::sin(angle) * along + (std::cos(angle) - std::cos(turn_rad / 2)) * right));
  }
  points.front() = a;
  points.back() = b;
  return EdgeCurve{points}.points_mm;
}

template <typename Element>
auto stiffness_of(const Element& element) {
  using Scalar = std::decay_t<decltype(element.independence())>;
  const typename Element::Root root = element.root();
  const Eigen::Index size = root.cols();
  std::vector<Scalar> lower(static_cast<std::size_t>(size * (size + 1) / 2));
  Element::square(root, lower.data());
  Eigen::MatrixX<Scalar> K(size, size);
  const Scalar* entry = lower.data();
  for (Eigen::Index j = 0; j < size; ++j)
    for (Eigen::Index i = j; i < size; ++i) K(i, j) = K(j, i) = *entry++;
  return K;
}

// Moments of a displacement that is linear along the chords.
template <int k>
Eigen::VectorXd moments_of(const TriangleVertices& v, const std::function<Point(const Point&)>& u) {
  Eigen::VectorXd moments(6 * (k + 1));
  for (int e = 0; e < 3; ++e)
    for (int j = 0; j <= k; ++j) {
      const double s = (j + 1.) / (k + 2);
      const Point at = (1 - s) * v.col(e) + s * v.col((e + 1) % 3);
      moments.segment<2>(2 * ((k + 1) * e + j)) = u(at);
    }
  return moments;
}

std::vector<std::function<Point(const Point&)>> rigid_motions() {
  return {[](const Point&) { return Point(1, 0); }, [](const Point&) { return Point(0, 1); },
          [](const Point& x) { return Point(-x.y(), x.x()); }};
}

template <int k>
void check_degree() {
  SCOPED_TRACE(k);
  const TriangleVertices v = triangle();
  using Element = CurvedElement<double>;
  const Eigen::MatrixXd straight = stiffness_of(EquilibriumElement<double, k>(v, steel)),
                        of_chords = stiffness_of(Element(v, steel, {}, k));
  EXPECT_LT((straight - of_chords).norm(), 1e-11 * straight.norm());
  for (const double turn : {0.4, -0.4}) {
    const std::vector<Point> first = arc(v.col(0), v.col(1), turn),
                             last = arc(v.col(2), v.col(0), turn / 2);
    const CurvedSides sides = {SideCurve{first, {}, {}}, SideCurve{}, SideCurve{last, {}, {}}};
    const Element element(v, steel, sides, k);
    const Eigen::MatrixXd K = stiffness_of(element);
    EXPECT_GT((K - straight).norm(), 1e-3 * straight.norm());
    const Eigen::VectorXd eigenvalues =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues();
    EXPECT_LT(eigenvalues.head<3>().cwiseAbs().maxCoeff(), 1e-11 * eigenvalues.tail<1>()(0));
    EXPECT_GT(eigenvalues(3), 1e-5 * eigenvalues.tail<1>()(0));
    for (const auto& motion : rigid_motions()) {
      const Eigen::VectorXd u = moments_of<k>(v, motion);
      EXPECT_LT((K * u).norm(), 1e-11 * K.norm() * u.norm());
      const auto stress = element.stress(u);
      EXPECT_LT(stress.norm(), 1e-11 * K.norm() * u.norm());
    }
    // Forces of any stress that it can have are in balance.
    const auto stress = element.stress(Eigen::VectorXd::LinSpaced(6 * (k + 1), -1, 2));
    const auto forces = element.edge_forces(stress);
    for (const auto& motion : rigid_motions())
      EXPECT_NEAR(forces.dot(moments_of<k>(v, motion)), 0, 1e-11 * forces.norm());
    // ∫ σ:C:σ is the work of its edges.
    const Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(6 * (k + 1), -1, 2);
    EXPECT_NEAR(element.energy(stress, stress), u.dot(K * u), 1e-9 * u.dot(K * u));
    // The same in extended precision.
    const Eigen::MatrixXd wide =
        stiffness_of(CurvedElement<Wide>(v, steel, sides, k)).template cast<double>();
    EXPECT_LT((wide - K).norm(), 1e-11 * K.norm());
  }
}

TEST(CurvedElement, OfEveryDegreeHasRigidMotionsAndNoOthers) {
  check_degree<2>();
  check_degree<3>();
  check_degree<4>();
}

// Of a contact law with normals that turn less than the arc.
TEST(CurvedSide, UnderAContactLawHasItsFrames) {
  const Point a(1, 0.5), b(3, 1), centre(1.2, 6);
  const std::vector<Point> points = arc(a, b, 0.6);
  for (int k = 2; k <= highest_stress_degree; ++k) {
    SCOPED_TRACE(k);
    const auto normals = [&](int parts) {
      std::vector<Point> n;
      for (int i = 0; i <= parts; ++i)
        n.push_back((EdgeCurve{points}.at(i / static_cast<double>(parts)) - centre).normalized());
      return n;
    };
    const std::vector<Point> law = normals(6), of_moments = normals(k);
    const CurvedSide<double> side({points, law, of_moments}, k);
    constexpr int count = CurvedSide<double>::points;
    // About its centre the motion is tangential, and its moments all are.
    Eigen::Matrix2Xd turn(2, count);
    for (int q = 0; q < count; ++q) {
      const Point from_centre = side.at(q) - centre;
      turn.col(q) = Point(-from_centre.y(), from_centre.x());
    }
    const Eigen::Matrix2Xd moments = side.moments(turn);
    for (int j = 0; j <= k; ++j)
      EXPECT_NEAR(moments.col(j).dot(of_moments[static_cast<std::size_t>(j)]), 0, 1e-8);
    // Forces work on the moments of rigid motions as tractions on these.
    const Eigen::Matrix2Xd forces = Eigen::Matrix2Xd::Random(2, k + 1);
    Eigen::Matrix2Xd density(2, count);
    for (int q = 0; q < count; ++q) density.col(q) = side.density(forces, q);
    EXPECT_LT((side.forces(density) - forces).norm(), 1e-12 * forces.norm());
    for (const auto& motion : rigid_motions()) {
      double work = 0;
      Eigen::Matrix2Xd u(2, count);
      for (int q = 0; q < count; ++q) {
        u.col(q) = motion(side.at(q));
        work += CurvedSide<double>::weight(q) * density.col(q).dot(u.col(q));
      }
      EXPECT_NEAR(side.moments(u).cwiseProduct(forces).sum(), work, 1e-11 * forces.norm());
    }
  }
}

// Without a law the moments of rigid motions are those on the chord, and all are exact.
TEST(CurvedSide, KnowsTheMomentsOfRigidMotions) {
  const Point a(1, 0.5), b(3, 1);
  const std::vector<Point> points = arc(a, b, 0.6);
  for (int k = 2; k <= highest_stress_degree; ++k) {
    const CurvedSide<double> side({points, {}, {}}, k);
    for (const auto& motion : rigid_motions()) {
      Eigen::Matrix2Xd u(2, CurvedSide<double>::points);
      for (int q = 0; q < u.cols(); ++q) u.col(q) = motion(side.at(q));
      const Eigen::Matrix2Xd moments = side.moments(u);
      for (int j = 0; j <= k; ++j) {
        const double s = (j + 1.) / (k + 2);
        EXPECT_LT((moments.col(j) - motion((1 - s) * a + s * b)).norm(), 1e-12) << k << ' ' << j;
      }
    }
  }
}

TEST(CurvedSide, MeasuresArcs) {
  const double turn = 0.6;
  const Point a(1, 0.5), b(3, 1), across(1.6, 2.7);
  const double radius = (b - a).norm() / (2 * std::sin(turn / 2)),
               segment = radius * radius * (turn - std::sin(turn)) / 2;
  const std::vector<Point> control = arc(a, b, turn);
  const CurvedSide<double> side({control, {}, {}}, 2);
  double length = 0;
  for (int q = 0; q < CurvedSide<double>::points; ++q)
    length += CurvedSide<double>::weight(q) * side.normal(q).norm();
  EXPECT_NEAR(length, radius * turn, 1e-10);
  const Point centroid = (a + b + across) / 3;
  const Eigen::MatrixXd W = side.mass_root(centroid);
  const double third = ((b - a).x() * (centroid - a).y() - (b - a).y() * (centroid - a).x()) / 2;
  EXPECT_NEAR((W * Eigen::VectorXd::Ones(6)).squaredNorm(), third + segment, 1e-9);
  EXPECT_NEAR(segment_area({control}), segment, 1e-9);
}

}  // namespace
}  // namespace airybench::curved_element_test
