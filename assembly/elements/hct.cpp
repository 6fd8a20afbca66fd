#include "assembly/elements/hct_templates.hpp"
#include "assembly/elements/small_cholesky.hpp"

namespace airybench {

std::array<int, 10> hct_third(int t) {
  const int i = t, j = (t + 1) % 3;
  return {i, j, 18, 3 + 2 * t, 4 + 2 * t, 9 + i, 9 + j, 12 + t, 15 + i, 15 + j};
}

template HctCoefficients hct_coefficients<double>(const TriangleVertices&, const EdgeSigns&);
template HctStress hct_stress<double>(const TriangleVertices&, const EdgeSigns&);

Eigen::Matrix<double, 36, 12> hct_flexibility_root(const HctStress& stress, double area_mm2,
                                                   const Eigen::Matrix3d& compliance) {
  // With compliance = RᵀR, M stacks √(a/12) R σ for the sum and the three corner values of every
  // third.
  const SmallCholesky<double, 3> cholesky(compliance);
  const Eigen::Matrix3d weight = cholesky.L().transpose() * std::sqrt(area_mm2 / 36);
  Eigen::Matrix<double, 36, 12> m;
  for (int t = 0; t < 3; ++t) {
    for (int corner = 0; corner < 3; ++corner)
      m.middleRows<3>(12 * t + 3 * corner) =
          weight.lazyProduct(stress.middleRows<3>(9 * t + 3 * corner));
    m.middleRows<3>(12 * t + 9) =
        m.middleRows<3>(12 * t) + m.middleRows<3>(12 * t + 3) + m.middleRows<3>(12 * t + 6);
  }
  return m;
}

HctFlexibility hct_flexibility(const HctStress& stress, double area_mm2,
                               const Eigen::Matrix3d& compliance) {
  const Eigen::Matrix<double, 36, 12> m = hct_flexibility_root(stress, area_mm2, compliance);
  HctFlexibility flexibility;
  for (int j = 0; j < 12; ++j)
    for (int i = 0; i <= j; ++i) flexibility(i, j) = flexibility(j, i) = m.col(i).dot(m.col(j));
  return flexibility;
}

}  // namespace airybench
