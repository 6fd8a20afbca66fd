#include "bench/verify/own_displacement.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <vector>

#include "assembly/small_cholesky.hpp"

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

// The constant matrices of OwnDisplacement, of one type for all degrees: compiled once.
struct Matrices {
  Eigen::MatrixXd projection, integral, condition, mass_inverse;
  std::array<Eigen::MatrixXd, 6> product;
};

// strain: of all displacements on the reference triangle; rows and columns as `reshaped()`.
Matrices matrices(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& on_thirds,
                  const Eigen::MatrixXd& strain) {
  const Eigen::Index n = mass.rows(), unknowns = strain.cols();
  Matrices result;
  result.mass_inverse = mass.inverse();
  result.projection.resize(3 * n, n);
  for (Eigen::Index t = 0; t < 3; ++t)
    result.projection.middleRows(n * t, n) =
        mass / 3 * on_thirds.middleCols(n * t, n).transpose() * result.mass_inverse;
  // Without three that hold the triangle, V1 and V2 across V1V2, columns are independent.
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < unknowns; ++i)
    if (i != 0 && i != 1 && i != 3) free.push_back(i);
  const auto rank = static_cast<Eigen::Index>(free.size());
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(Eigen::MatrixXd(strain(Eigen::all, free)));
  const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(3 * n, 3 * n);
  Eigen::MatrixXd inverse = Q.leftCols(rank).transpose();
  qr.matrixQR().topRows(rank).triangularView<Eigen::Upper>().solveInPlace(inverse);
  result.integral.setZero(unknowns, 3 * n);
  result.integral(free, Eigen::all) = inverse;
  result.condition = Q.rightCols(3 * n - rank);
  for (int m = 0; m < 6; ++m) {
    const Eigen::MatrixXd first = result.condition(Eigen::seqN(pairs[m][0], n, 3), Eigen::all),
                          second = result.condition(Eigen::seqN(pairs[m][1], n, 3), Eigen::all);
    result.product[m] = first.transpose() * result.mass_inverse * second;
    if (m >= 3) result.product[m] += result.product[m].transpose().eval();
  }
  return result;
}

}  // namespace

template <int k>
OwnDisplacement<k>::OwnDisplacement() {
  Eigen::MatrixXd strain(3 * n, 2 * Triangle::nodes);
  for (int i = 0; i < 2 * Triangle::nodes; ++i) {
    typename Triangle::Displacement u = Triangle::Displacement::Zero();
    u(i % 2, i / 2) = 1;
    strain.col(i) = Triangle::strain(Eigen::Matrix2d::Identity(), u).reshaped();
  }
  const auto& constants = Triangle::constants();
  const Matrices all = matrices(constants.mass, constants.on_thirds, strain);
  projection_ = all.projection;
  integral_ = all.integral;
  condition_ = all.condition;
  mass_inverse_ = all.mass_inverse;
  for (int m = 0; m < 6; ++m) product_[m] = all.product[m];
}

template <int k>
typename OwnDisplacement<k>::Triangle::Displacement OwnDisplacement<k>::operator()(
    const TriangleShape& shape, const Eigen::Matrix3d& compliance, const Stress& stress) const {
  const Eigen::Matrix3d to_xi = to_coordinates(shape.B);
  const Eigen::Matrix3d dual = to_xi.lazyProduct(compliance);
  typename Triangle::Strain strain = dual.lazyProduct(stress.lazyProduct(projection_).eval());
  if constexpr (conditions > 0) {
    const Eigen::Matrix3d c = dual.lazyProduct(to_xi.transpose());
    Eigen::Matrix<double, conditions, conditions> S =
        Eigen::Matrix<double, conditions, conditions>::Zero();
    for (int m = 0; m < 6; ++m) S += c(pairs[m][0], pairs[m][1]) * product_[m];
    Eigen::Matrix<double, conditions, 1> y = condition_.transpose().lazyProduct(strain.reshaped());
    const SmallCholesky<double, conditions> factor(S);
    if (factor.last_pivot() > 0) {  // else a sliver's strain stays nearly compatible
      factor.solve(y);
      typename Triangle::Strain multiplier;
      multiplier.reshaped() = condition_.lazyProduct(y);
      strain -= c.lazyProduct(multiplier.lazyProduct(mass_inverse_).eval());
    }
  }
  typename Triangle::Displacement u = Triangle::Displacement::Zero();
  for (int i = 0; i < 3 * n; ++i) u.reshaped() += strain.reshaped()(i) * integral_.col(i);
  return shape.gradients.lazyProduct(u);  // B⁻ᵀ û
}

#define AIRYBENCH_INSTANTIATE(k) template class OwnDisplacement<k>;
AIRYBENCH_STRESS_DEGREES(AIRYBENCH_INSTANTIATE)
#undef AIRYBENCH_INSTANTIATE

}  // namespace airybench
