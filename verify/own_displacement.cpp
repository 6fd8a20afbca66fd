#include "verify/own_displacement.hpp"

#include <Eigen/QR>
#include <vector>

#include "verify/positive_definite.hpp"

namespace airybench {
namespace {

constexpr int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};

// Of (xx, yy, 2xy): ε → Bᵀ ε B.
Eigen::Matrix3d to_coordinates(const Eigen::Matrix2d& B) {
  const double a = B(0, 0), b = B(0, 1), c = B(1, 0), d = B(1, 1);
  Eigen::Matrix3d map;
  map << a * a, c * c, a * c, b * b, d * d, b * d, 2 * a * b, 2 * c * d, a * d + b * c;
  return map;
}

}  // namespace

const OwnDisplacement& OwnDisplacement::of_degree(int k) {
  return made_once(k, [](int degree) { return OwnDisplacement(degree); });
}

OwnDisplacement::OwnDisplacement(int k) : triangle_(DisplacementTriangle::of_degree(k + 1)) {
  const Eigen::Index n = triangle_.strains, unknowns = 2 * triangle_.nodes;
  // Of all displacements on the reference triangle; rows and columns as `reshaped()`.
  Eigen::MatrixXd strain(3 * n, unknowns);
  for (Eigen::Index i = 0; i < unknowns; ++i) {
    Eigen::Matrix2Xd u = Eigen::Matrix2Xd::Zero(2, triangle_.nodes);
    u(i % 2, i / 2) = 1;
    strain.col(i) = triangle_.strain(Eigen::Matrix2d::Identity(), u).reshaped();
  }
  mass_inverse_ = Eigen::MatrixXd::Identity(n, n);
  solve_positive_definite(triangle_.mass, mass_inverse_);
  projection_.resize(3 * n, n);
  for (Eigen::Index t = 0; t < 3; ++t)
    projection_.middleRows(n * t, n) =
        (triangle_.mass / 3)
            .lazyProduct(triangle_.on_thirds.middleCols(n * t, n).transpose())
            .eval()
            .lazyProduct(mass_inverse_);
  // Without three that hold the triangle, V1 and V2 across V1V2, columns are independent.
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < unknowns; ++i)
    if (i != 0 && i != 1 && i != 3) free.push_back(i);
  const auto rank = static_cast<Eigen::Index>(free.size());
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(Eigen::MatrixXd(strain(Eigen::all, free)));
  const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(3 * n, 3 * n);
  Eigen::MatrixXd inverse = Q.leftCols(rank).transpose();
  qr.matrixQR().topRows(rank).triangularView<Eigen::Upper>().solveInPlace(inverse);
  integral_.setZero(unknowns, 3 * n);
  for (Eigen::Index i = 0; i < rank; ++i) integral_.row(free[i]) = inverse.row(i);
  condition_ = Q.rightCols(3 * n - rank);
  if (condition_.cols() == 0) return;
  for (int m = 0; m < 6; ++m) {
    const auto rows_of = [&](int component) {
      Eigen::MatrixXd rows(n, condition_.cols());
      for (Eigen::Index i = 0; i < n; ++i) rows.row(i) = condition_.row(3 * i + component);
      return rows;
    };
    product_[m] = rows_of(pairs[m][0])
                      .transpose()
                      .lazyProduct(mass_inverse_)
                      .eval()
                      .lazyProduct(rows_of(pairs[m][1]));
    if (m >= 3) product_[m] += product_[m].transpose().eval();
  }
}

DisplacementTriangle::Displacement OwnDisplacement::operator()(
    const TriangleShape& shape, const Eigen::Matrix3d& compliance,
    const DisplacementTriangle::StressRef& stress) const {
  const Eigen::Matrix3d to_xi = to_coordinates(shape.B);
  const Eigen::Matrix3d dual = to_xi.lazyProduct(compliance);
  DisplacementTriangle::Strain strain = dual.lazyProduct(stress.lazyProduct(projection_).eval());
  if (condition_.cols() > 0) {
    const Eigen::Matrix3d c = dual.lazyProduct(to_xi.transpose());
    Eigen::MatrixXd S = c(0, 0) * product_[0];
    for (int m = 1; m < 6; ++m) S += c(pairs[m][0], pairs[m][1]) * product_[m];
    Eigen::MatrixXd y = condition_.transpose().lazyProduct(strain.reshaped());
    if (solve_positive_definite(S, y)) {  // else a sliver's strain stays nearly compatible
      DisplacementTriangle::Strain multiplier(3, triangle_.strains);
      multiplier.reshaped() = condition_.lazyProduct(y);
      strain -= c.lazyProduct(multiplier.lazyProduct(mass_inverse_).eval());
    }
  }
  DisplacementTriangle::Displacement u(2, triangle_.nodes);
  u.reshaped() = integral_.lazyProduct(strain.reshaped());
  return shape.gradients.lazyProduct(u);  // B⁻ᵀ û
}

}  // namespace airybench
