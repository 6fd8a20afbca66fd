#include "solvers/contact/paired_points.hpp"

#include <stdexcept>

namespace airybench {
namespace {

// The second of a pair: its joined point is the first's.
bool is_second(const ContactPoints& points, int p) {
  const int q = points.opposite_of(p);
  return q != ContactPoints::no_point && q < p;
}

// Per point, which of the joined points it belongs to.
std::vector<int> joined_number(const ContactPoints& points, int& count) {
  std::vector<int> number(static_cast<std::size_t>(points.count));
  count = 0;
  for (int p = 0; p < points.count; ++p)
    number[p] = is_second(points, p) ? number[points.opposite_of(p)] : count++;
  return number;
}

// T.
Eigen::SparseMatrix<double> joining(const ContactPoints& points) {
  const int m = points.components;
  int count = 0;
  const std::vector<int> number = joined_number(points, count);
  std::vector<Eigen::Triplet<double>> ones;
  for (int p = 0; p < points.count; ++p)
    for (int k = 0; k < m; ++k) ones.emplace_back(m * p + k, m * number[p] + k, 1);
  Eigen::SparseMatrix<double> T(points.size(), m * count);
  T.setFromTriplets(ones.begin(), ones.end());
  return T;
}

}  // namespace

ContactPoints joined(const ContactPoints& points) {
  if (points.opposite.empty()) return points;
  ContactPoints result;
  result.per_edge = points.per_edge;
  result.components = points.components;
  for (int p = 0; p < points.count; ++p) {
    if (is_second(points, p)) continue;
    if (!points.friction.empty()) result.friction.push_back(points.friction_at(p));
    if (!points.boundary.empty()) result.boundary.push_back(points.boundary[p]);
    ++result.count;
  }
  if (points.gap.size() > 0) result.gap = of_both(points, points.gap);
  result.free = points.free;
  result.free.motions.resize(result.size(), points.free.motions.cols());
  for (Eigen::Index m = 0; m < points.free.motions.cols(); ++m)
    result.free.motions.col(m) = of_both(points, points.free.motions.col(m));
  return result;
}

contact::Problem joined(const contact::Problem& problem) {
  if (problem.points.opposite.empty()) return problem;
  if (!problem.is_dense()) throw std::invalid_argument("pairs of points with a sparse D");
  const Eigen::SparseMatrix<double> T = joining(problem.points);
  contact::Problem result{.points = joined(problem.points),
                          .name = problem.name,
                          .is_symmetric = problem.is_symmetric,
                          .how = problem.how};
  result.D = T.transpose() * (problem.D * T).eval();
  result.G = of_both(problem.points, problem.G);
  return result;
}

Eigen::VectorXd of_first(const ContactPoints& points, const Eigen::VectorXd& rows) {
  if (points.opposite.empty()) return rows;
  const int m = points.components;
  Eigen::VectorXd first(rows.size());
  int count = 0;
  for (int p = 0; p < points.count; ++p) {
    if (is_second(points, p)) continue;
    first.segment(m * count++, m) = rows.segment(m * p, m);
  }
  first.conservativeResize(m * count);
  return first;
}

Eigen::VectorXd of_both(const ContactPoints& points, const Eigen::VectorXd& rows) {
  return of_first(points, sums_of_pairs(points, rows));
}

Eigen::VectorXd at_both(const ContactPoints& points, const Eigen::VectorXd& F) {
  if (points.opposite.empty()) return F;
  return joining(points) * F;
}

void set_means_of_pairs(const ContactPoints& points,
                        const Eigen::Ref<const Eigen::VectorXd>& weight,
                        Eigen::Ref<Eigen::VectorXd> rows) {
  const int m = points.components;
  for (int p = 0; p < points.count; ++p) {
    const int q = points.opposite_of(p);
    if (q < p) continue;
    for (int k = 0; k < m; ++k) {
      double &one = rows(m * p + k), &other = rows(m * q + k);
      const double a = weight(m * p + k), b = weight(m * q + k);
      one = other = (a * one + b * other) / (a + b);
    }
  }
}

}  // namespace airybench
