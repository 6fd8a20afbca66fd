#include "bench/measure/stress_samples.hpp"

#include <Eigen/LU>
#include <cmath>

namespace airybench {

StressSamples::StressSamples(const Problem& problem, const StressField& stress, int parts)
    : parts_(parts), problem_(problem), stress_(stress) {
  for (int row = parts; row >= 0; --row)
    for (int j = 0; j <= row; ++j)
      lattice_.emplace_back(static_cast<double>(row) / parts,
                            row == 0 ? 0 : static_cast<double>(j) / row);
  const auto count = static_cast<Eigen::Index>(lattice_.size());
  weights_.resize(3, count);
  values_.resize(bernstein_count(stress.degree()), count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& [rho, s] = lattice_[static_cast<std::size_t>(i)];
    weights_.col(i) << rho * (1 - s), rho * s, 1 - rho;
    values_.col(i) = polynomials(weights_.col(i));
  }
}

Eigen::VectorXd StressSamples::polynomials(const Eigen::Vector3d& weights) const {
  return bernstein_values(stress_.degree(), weights);
}

StressSamples::Third StressSamples::third(int triangle, int k) const {
  const TriangleVertices v = problem_.vertices_of(triangle);
  const Eigen::Vector2d centroid = v.rowwise().mean();
  Eigen::Matrix<double, 2, 3> corners;
  corners << v.col(k), v.col((k + 1) % 3), centroid;
  const Eigen::Index columns = values_.rows();
  const auto own = stress_[static_cast<std::size_t>(triangle)].middleCols(k * columns, columns);
  const auto curves = problem_.curves_of(triangle, stress_.degree());
  Eigen::Matrix3d of_corners;  // their barycentric coordinates
  of_corners << Eigen::Vector3d::Unit(k), Eigen::Vector3d::Unit((k + 1) % 3),
      Eigen::Vector3d::Constant(1. / 3);
  if (!curves || (*curves)[static_cast<std::size_t>(k)].is_straight())
    return {corners * weights_, own * values_, of_corners * weights_};

  Eigen::Matrix2d from_centroid;
  from_centroid << corners.col(0) - centroid, corners.col(1) - centroid;
  const Eigen::Matrix2d inverse = from_centroid.inverse();
  Third third{Eigen::Matrix2Xd(2, weights_.cols()), Eigen::Matrix3Xd(3, weights_.cols()),
              Eigen::Matrix3Xd(3, weights_.cols())};
  for (Eigen::Index i = 0; i < weights_.cols(); ++i) {
    const auto& [rho, s] = lattice_[static_cast<std::size_t>(i)];
    const CurvePoint<double> point((*curves)[static_cast<std::size_t>(k)], s);
    third.at_mm.col(i) = centroid + rho * (point.at - centroid);
    const Eigen::Vector2d sides = rho * inverse * (point.at - centroid);
    const Eigen::Vector3d weights(sides(0), sides(1), 1 - sides.sum());
    third.stress.col(i) = own * polynomials(weights);
    third.lambda.col(i) = of_corners * weights;
  }
  return third;
}

}  // namespace airybench
