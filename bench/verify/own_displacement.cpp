#include "bench/verify/own_displacement.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
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

}  // namespace

template <int k>
OwnDisplacement<k>::OwnDisplacement() {
  const auto& constants = Triangle::constants();
  mass_inverse_ = Eigen::MatrixXd(constants.mass).inverse();
  for (int t = 0; t < 3; ++t)
    projection_.template middleRows<n>(n * t) =
        constants.mass / 3 * constants.on_thirds.template middleCols<n>(n * t).transpose() *
        mass_inverse_;
  // Strains of all displacements but three that hold the triangle: V1, and V2 across V1V2.
  constexpr std::array<int, 3> held = {0, 1, 3};
  Eigen::MatrixXd strain(3 * n, 0);
  std::vector<int> free;
  for (int i = 0; i < 2 * Triangle::nodes; ++i) {
    if (std::ranges::count(held, i) > 0) continue;
    typename Triangle::Displacement u = Triangle::Displacement::Zero();
    u(i % 2, i / 2) = 1;
    free.push_back(i);
    strain.conservativeResize(Eigen::NoChange, strain.cols() + 1);
    strain.rightCols(1) = Triangle::strain(Eigen::Matrix2d::Identity(), u).reshaped();
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(strain);
  const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(3 * n, 3 * n);
  const Eigen::MatrixXd inverse =
      qr.matrixQR().topRows(strain.cols()).template triangularView<Eigen::Upper>().solve(
          Eigen::MatrixXd(Q.leftCols(strain.cols()).transpose()));
  integral_.setZero();
  for (std::size_t i = 0; i < free.size(); ++i)
    integral_.row(free[i]) = inverse.row(static_cast<Eigen::Index>(i));
  if constexpr (conditions > 0) {
    condition_ = Q.template rightCols<conditions>();
    for (int m = 0; m < 6; ++m) {
      const auto rows = [&](int component) {
        return Eigen::MatrixXd(condition_(Eigen::seqN(component, n, 3), Eigen::all));
      };
      const auto [a, b] = pairs[m];
      const Eigen::MatrixXd product = rows(a).transpose() * mass_inverse_ * rows(b);
      product_[m] = a == b ? product : Eigen::MatrixXd(product + product.transpose());
    }
  }
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
    Eigen::Matrix<double, conditions, 1> y =
        condition_.transpose().lazyProduct(strain.reshaped());
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
