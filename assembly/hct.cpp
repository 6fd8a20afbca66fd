#include "assembly/hct_templates.hpp"

namespace airybench {

std::array<int, 10> hct_third(int t) {
  const int i = t, j = (t + 1) % 3;
  return {i, j, 18, 3 + 2 * t, 4 + 2 * t, 9 + i, 9 + j, 12 + t, 15 + i, 15 + j};
}

template HctCoefficientsIn<double> hct_coefficients<double>(const TriangleVertices&,
                                                            const EdgeSigns&);
template HctStressIn<double> hct_stress<double>(const TriangleVertices&, const EdgeSigns&);
template HctStressIn<double, 9> hct_stress<double, 9>(const TriangleVertices&, const EdgeSigns&);
template Eigen::Matrix<double, 12, 12> hct_flexibility(const Eigen::Matrix<double, 27, 12>&, double,
                                                       const Eigen::Matrix3d&);
template Eigen::Matrix<double, 36, 9> hct_flexibility_root(const Eigen::Matrix<double, 27, 9>&,
                                                           double, const Eigen::Matrix3d&);
template HctCoefficientsIn<long double> hct_coefficients<long double>(const TriangleVertices&,
                                                                      const EdgeSigns&);
template HctStressIn<long double> hct_stress<long double>(const TriangleVertices&,
                                                          const EdgeSigns&);
template HctStressIn<long double, 9> hct_stress<long double, 9>(const TriangleVertices&,
                                                                const EdgeSigns&);
template Eigen::Matrix<long double, 36, 9> hct_flexibility_root(
    const Eigen::Matrix<long double, 27, 9>&, long double, const Eigen::Matrix3d&);

}  // namespace airybench
