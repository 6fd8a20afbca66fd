// hct_stress() and its transpose applied without forming the matrix: a tenth of the operations.
#pragma once

#include <array>

#include "assembly/elements/hct_templates.hpp"
#include "assembly/stress_field.hpp"

namespace airybench {

template <typename Scalar>
class HctAction {
 public:
  using Dofs = Eigen::Matrix<Scalar, 12, 1>;

  HctAction(const TriangleVerticesFor<Scalar>& vertices, const EdgeSigns& outward) {
    using namespace hct_formulas;
    const Corners<Scalar> v = at_origin<Scalar>(vertices);
    const Eigen::Vector2<Scalar> centroid = mean(v);
    for (int t = 0; t < 3; ++t) {
      const int j = next(t);
      to_centroid_[t] = (centroid - v.col(t)) / Scalar(3);
      edge_[t] = (v.col(j) - v.col(t)) / Scalar(3);
      alpha_[t] = normal_direction<Scalar>(v.col(t), v.col(j), centroid);
      outward_[t] = Scalar(outward[t] * 4) / Scalar(3);
      weights_[t] =
          stress_weights<Scalar>(barycentric_gradients<Scalar>(v.col(t), v.col(j), centroid));
    }
  }

  ElementStressIn<Scalar> stress(const Dofs& phi) const {
    using namespace hct_formulas;
    const Coefficients c = coefficients(phi);
    ElementStressIn<Scalar> stress;
    for (int t = 0; t < 3; ++t) {
      const std::array<int, 10> third = hct_third(t);
      for (int m = 0; m < 3; ++m) {
        Eigen::Matrix<Scalar, 6, 1> near;
        for (int k = 0; k < 6; ++k) near(k) = c(third[near_corner[m][k]]);
        stress.reshaped().template segment<3>(3 * (3 * t + m)) = weights_[t].lazyProduct(near);
      }
    }
    return stress;
  }

  Dofs transposed(const ElementStressIn<Scalar>& dual) const {
    using namespace hct_formulas;
    Coefficients c = Coefficients::Zero();
    for (int t = 0; t < 3; ++t) {
      const std::array<int, 10> third = hct_third(t);
      for (int m = 0; m < 3; ++m) {
        const Eigen::Matrix<Scalar, 6, 1> near = weights_[t].transpose().lazyProduct(
            dual.reshaped().template segment<3>(3 * (3 * t + m)));
        for (int k = 0; k < 6; ++k) c(third[near_corner[m][k]]) += near(k);
      }
    }
    return transposed_coefficients(c);
  }

 private:
  using Coefficients = Eigen::Matrix<Scalar, 19, 1>;

  // hct_coefficients() times φ.
  Coefficients coefficients(const Dofs& phi) const {
    using namespace hct_formulas;
    Coefficients c;
    const auto extrapolated = [&](int i, const Eigen::Vector2<Scalar>& by) {
      return phi(3 * i) + phi(3 * i + 1) * by.x() + phi(3 * i + 2) * by.y();
    };
    for (int i = 0; i < 3; ++i) {
      c(i) = phi(3 * i);
      c(9 + i) = extrapolated(i, to_centroid_[i]);
    }
    for (int t = 0; t < 3; ++t) {
      c(3 + 2 * t) = extrapolated(t, edge_[t]);
      c(4 + 2 * t) = extrapolated(next(t), -edge_[t]);
    }
    complete_coefficients<Scalar>(
        alpha_, [&](int row) -> Scalar& { return c(row); },
        [&](int t) -> Scalar { return phi(9 + t) * outward_[t]; });
    return c;
  }

  // The transposed lines of coefficients(), in reverse order.
  Dofs transposed_coefficients(Coefficients c) const {
    using namespace hct_formulas;
    const Scalar two = 2, three = 3;
    Dofs phi = Dofs::Zero();
    const auto extrapolated = [&](int i, const Eigen::Vector2<Scalar>& by, const Scalar& of) {
      phi(3 * i) += of;
      phi(3 * i + 1) += of * by.x();
      phi(3 * i + 2) += of * by.y();
    };
    for (int i = 0; i < 3; ++i) {
      const Scalar share = (c(15 + i) + c(18) / three) / three;
      for (const int row : {9 + i, 12 + i, 12 + next(next(i))}) c(row) += share;
    }
    for (int t = 0; t < 3; ++t) {
      const int i = t, j = next(t);
      const Eigen::Vector3<Scalar>& alpha = alpha_[t];
      const Scalar inner = c(12 + t) / (two * alpha(2));
      phi(9 + t) = inner * outward_[t];
      c(i) -= inner * alpha(0);
      c(j) -= inner * alpha(1);
      for (const int end : {i, j}) c(9 + end) -= inner * alpha(2);
      extrapolated(i, edge_[t], c(3 + 2 * t) - inner * (two * alpha(0) + alpha(1)));
      extrapolated(j, -edge_[t], c(4 + 2 * t) - inner * (alpha(0) + two * alpha(1)));
    }
    for (int i = 0; i < 3; ++i) {
      phi(3 * i) += c(i);
      extrapolated(i, to_centroid_[i], c(9 + i));
    }
    return phi;
  }

  std::array<Eigen::Vector2<Scalar>, 3> to_centroid_, edge_;  // a third of each way
  std::array<Eigen::Vector3<Scalar>, 3> alpha_;
  std::array<Scalar, 3> outward_;
  std::array<Eigen::Matrix<Scalar, 3, 6>, 3> weights_;
};

}  // namespace airybench
