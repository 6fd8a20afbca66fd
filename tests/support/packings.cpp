#include "tests/support/packings.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace airybench::testing {
namespace {

using Vector = Eigen::Vector3d;  // in the plane the last component is zero

constexpr int wall = -1;

struct Touch {
  int below, above;                     // bodies; below may be the wall
  Vector arm_below, arm_above, normal;  // from the centres to the point; from below to above
};

class PackingDice {
 public:
  explicit PackingDice(unsigned seed) : generator_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_()) / 4294967296.0;
  }
  bool falls(double probability) { return between(0, 1) < probability; }
  Vector direction(int components) {
    Vector v(between(-1, 1), between(-1, 1), components == 3 ? between(-1, 1) : 0);
    return v.norm() > 0.1 ? Vector(v.normalized()) : direction(components);
  }

 private:
  std::mt19937 generator_;  // the same on every machine, unlike the distributions
};

// Boxes of 2 × 1 (× 1) in rows; every other row is shifted by half a box.
std::vector<Touch> brick_wall(int components, int contacts, int& bodies) {
  const int corners = components == 3 ? 4 : 2;
  const int width = std::max(2, static_cast<int>(std::sqrt(contacts / (2.0 * corners))));
  std::vector<Touch> touches;
  bodies = 0;
  for (int row = 0; static_cast<int>(touches.size()) < contacts; ++row) {
    for (int k = 0; k < width; ++k, ++bodies) {
      const double x = 2.0 * k + row % 2;
      for (int other = 0; other < (row == 0 ? 1 : width); ++other) {
        const double x_below = row == 0 ? x : 2.0 * other + (row - 1) % 2;
        const double low = std::max(x, x_below) - 1, high = std::min(x, x_below) + 1;
        if (high - low < 0.5) continue;
        for (int corner = 0; corner < corners; ++corner) {
          const double at = corner % 2 == 0 ? low : high, z = corners == 2 ? 0 : corner / 2 - 0.5;
          touches.push_back({row == 0 ? wall : bodies - width - k + other,
                             bodies,
                             {at - x_below, 0.5, z},
                             {at - x, -0.5, z},
                             {0, 1, 0}});
        }
      }
    }
  }
  return touches;
}

// Neighbours in the plane of a triangular lattice, in space of a cubic one with half of the
// diagonals of its faces; some 30 % are left out. on_wall: its lowest bodies touch a wall, and it
// does not go on below.
std::vector<Touch> lattice(int components, int contacts, bool on_wall, PackingDice& dice,
                           int& bodies) {
  constexpr double left_out = 0.3;
  const bool space = components == 3;
  std::vector<Eigen::Vector3i> steps = {{1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  if (space) steps = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, 1}};
  const double per_body = (1 - left_out) * static_cast<double>(steps.size());
  const double side = std::pow(contacts / per_body, space ? 1 / 3.0 : 0.5);
  const int nx = std::max(3, static_cast<int>(std::ceil(side))), nz = space ? nx : 1;
  int ny = std::max(3, static_cast<int>(std::ceil(contacts / per_body / nx / nz)) + 1);
  const auto at = [&](int i, int j, int k) {
    return ((i + nx) % nx * ny + (j + ny) % ny) * nz + (k + nz) % nz;
  };
  bodies = nx * ny * nz;
  std::vector<double> radius(static_cast<std::size_t>(bodies));
  for (double& r : radius) r = dice.between(0.7, 1.3);
  std::vector<Touch> touches;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      for (int k = 0; k < nz; ++k) {
        const int here = at(i, j, k);
        if (on_wall && j == 0)
          touches.push_back({wall, here, {}, {0, -radius[here], 0}, {0, 1, 0}});
        for (const Eigen::Vector3i& step : steps) {
          if (dice.falls(left_out) || (on_wall && j + step.y() >= ny)) continue;
          const Vector jitter = 0.3 * dice.direction(components);
          Vector normal = step.cast<double>();
          if (!space) normal.x() -= 0.5 * step.y();  // of the triangles
          normal = (normal + jitter).normalized();
          const int there = at(i + step.x(), j + step.y(), k + step.z());
          touches.push_back({here, there, radius[here] * normal, -radius[there] * normal, normal});
        }
      }
  return touches;
}

Eigen::Matrix3d frame_of(const Vector& normal, int components, PackingDice& dice) {
  Eigen::Matrix3d frame;
  const Vector other = components == 2 ? Vector(0, 0, 1) : dice.direction(3);
  const Vector t = other.cross(normal).normalized();
  frame << normal, t, normal.cross(t);
  return frame;
}

// Columns of H of one contact: the body at `arm` from its centre moves with sign.
void add_columns(int first_row, int first_column, double sign, const Vector& arm,
                 const Eigen::Matrix3d& frame, int components,
                 std::vector<Eigen::Triplet<double>>& entries) {
  for (int k = 0; k < components; ++k) {
    const Vector along = frame.col(k), turning = arm.cross(along);
    for (int i = 0; i < components; ++i)
      entries.emplace_back(first_row + i, first_column + k, sign * along(i));
    if (components == 2) entries.emplace_back(first_row + 2, first_column + k, sign * turning.z());
    for (int i = 0; components == 3 && i < 3; ++i)
      entries.emplace_back(first_row + 3 + i, first_column + k, sign * turning(i));
  }
}

// r and u of a contact that is open, sticks or slips, one time in three each.
void choose(double mu, int components, PackingDice& dice, Eigen::Ref<Eigen::VectorXd> r,
            Eigen::Ref<Eigen::VectorXd> u) {
  const double which = dice.between(0, 3);
  const Eigen::VectorXd direction = [&] {
    if (components == 2) return Eigen::VectorXd::Constant(1, dice.falls(0.5) ? 1.0 : -1.0).eval();
    const double angle = dice.between(0, 2 * 3.14159265358979);
    return Eigen::VectorXd(Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }();
  const auto tangent = Eigen::seq(1, Eigen::last);
  r.setZero();
  u.setZero();
  if (which < 1) {
    u(0) = dice.between(0.1, 1);
    u(tangent) = dice.between(0, 1) * direction;
    return;
  }
  r(0) = dice.between(0.5, 1.5);
  r(tangent) = (which < 2 ? dice.between(0, 0.9) : 1) * mu * r(0) * direction;
  if (which >= 2) u(tangent) = -dice.between(0.1, 1) * direction;
}

// r and u of every contact, and the w that they follow from. solve: M⁻¹ b.
template <typename Solve>
void choose_answer(PackingDice& dice, Packing& result, Solve solve) {
  const ContactPoints& points = result.points;
  const int m = points.components;
  Eigen::VectorXd r(points.size()), u(points.size());
  for (int p = 0; p < points.count; ++p)
    choose(points.friction_at(p), m, dice, r.segment(m * p, m), u.segment(m * p, m));
  result.w = u - result.H.transpose() * solve(Eigen::VectorXd(result.H * r));
  result.F = -r;
}

}  // namespace

Packing packing(Packed shape, int components, int contacts, unsigned seed) {
  PackingDice dice(seed);
  int bodies = 0;
  const std::vector<Touch> touches =
      shape == Packed::brick_wall
          ? brick_wall(components, contacts, bodies)
          : lattice(components, contacts, shape == Packed::flow, dice, bodies);
  const int per_body = components == 2 ? 3 : 6, n = per_body * bodies;
  Packing result;
  ContactPoints& points = result.points;
  points.components = components;
  points.count = static_cast<int>(touches.size());
  std::vector<Eigen::Triplet<double>> masses, columns;
  for (int b = 0; b < bodies; ++b) {
    const double mass = dice.between(0.5, 2);
    for (int i = 0; i < per_body; ++i)
      masses.emplace_back(per_body * b + i, per_body * b + i, i < components ? mass : 0.4 * mass);
  }
  for (int p = 0; p < points.count; ++p) {
    const Touch& touch = touches[static_cast<std::size_t>(p)];
    const Eigen::Matrix3d frame = frame_of(touch.normal, components, dice);
    add_columns(per_body * touch.above, components * p, 1, touch.arm_above, frame, components,
                columns);
    if (touch.below != wall)
      add_columns(per_body * touch.below, components * p, -1, touch.arm_below, frame, components,
                  columns);
    points.friction.push_back(dice.between(0.2, 0.6));
  }
  result.M.resize(n, n);
  result.M.setFromTriplets(masses.begin(), masses.end());
  result.H.resize(n, points.size());
  result.H.setFromTriplets(columns.begin(), columns.end());

  result.f = Eigen::VectorXd::Zero(n);
  result.w = Eigen::VectorXd::Zero(points.size());
  if (shape == Packed::flow) {  // downwards, faster above, turning somehow
    for (int b = 0; b < bodies; ++b) {
      const int row = per_body * b;
      result.f(row) = result.M.coeff(row, row) * dice.between(0.5, 1);
      result.f(row + 1) = -result.M.coeff(row, row) * dice.between(0.5, 1.5);
      for (int i = components; i < per_body; ++i)
        result.f(row + i) = result.M.coeff(row + i, row + i) * dice.between(-1, 1);
    }
    return result;
  }
  choose_answer(dice, result, [&](const Eigen::VectorXd& b) {
    return Eigen::VectorXd(b.cwiseQuotient(result.M.diagonal()));
  });
  return result;
}

Packing elastic_strip(int cells, unsigned seed) {
  constexpr int height = 5, nodes_across = height + 1;
  constexpr double mass = 1, lambda = 5, shear = 5;  // λ and G, of a time step's square
  PackingDice dice(seed);
  Packing result;
  const int n = 2 * (cells + 1) * nodes_across;
  const auto node = [](int i, int j) { return nodes_across * i + j; };
  std::vector<Eigen::Triplet<double>> entries, columns;
  for (int row = 0; row < n; ++row) entries.emplace_back(row, row, mass);
  const auto add_triangle = [&](const std::array<int, 3>& corner, const Eigen::Matrix2d& edges) {
    Eigen::Matrix<double, 2, 3> gradient;  // of the corners' shape functions
    gradient.rightCols<2>() = edges.inverse().transpose();
    gradient.col(0) = -gradient.col(1) - gradient.col(2);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        const Eigen::Vector2d of_a = gradient.col(a), of_b = gradient.col(b);
        const Eigen::Matrix2d K =
            0.5 * (lambda * of_a * of_b.transpose() + shear * of_b * of_a.transpose() +
                   shear * of_a.dot(of_b) * Eigen::Matrix2d::Identity());
        for (int i = 0; i < 2; ++i)
          for (int k = 0; k < 2; ++k)
            entries.emplace_back(2 * corner[a] + i, 2 * corner[b] + k, K(i, k));
      }
  };
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < height; ++j) {
      add_triangle({node(i, j), node(i + 1, j), node(i, j + 1)}, Eigen::Matrix2d::Identity());
      add_triangle({node(i + 1, j + 1), node(i, j + 1), node(i + 1, j)},
                   -Eigen::Matrix2d::Identity());
    }
  result.points.components = 2;
  for (int i = 0; i <= cells; ++i)
    for (const int j : {0, height}) {
      const double inwards = j == 0 ? 1 : -1;  // contacts push the strip
      const int p = result.points.count++;
      columns.emplace_back(2 * node(i, j) + 1, 2 * p, inwards);
      columns.emplace_back(2 * node(i, j), 2 * p + 1, inwards);
      result.points.friction.push_back(dice.between(0.1, 0.3));
    }
  result.M.resize(n, n);
  result.M.setFromTriplets(entries.begin(), entries.end());
  result.H.resize(n, result.points.size());
  result.H.setFromTriplets(columns.begin(), columns.end());
  result.f = Eigen::VectorXd::Zero(n);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(result.M);
  choose_answer(dice, result,
                [&](const Eigen::VectorXd& b) { return Eigen::VectorXd(factor.solve(b)); });
  return result;
}

contact::Problem Packing::problem() const {
  const Eigen::VectorXd inverse = M.diagonal().cwiseInverse();
  const Eigen::SparseMatrix<double> scaled = inverse.asDiagonal() * H;
  contact::Problem problem;
  problem.rows = SparseRows(Eigen::SparseMatrix<double>(H.transpose() * scaled));
  problem.G = w + H.transpose() * inverse.cwiseProduct(f);
  problem.points = points;
  return problem;
}

}  // namespace airybench::testing
