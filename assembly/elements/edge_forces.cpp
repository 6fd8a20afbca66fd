#include "assembly/elements/edge_forces.hpp"

#include <array>

#include "support/wide.hpp"

namespace airybench {

template <typename Scalar>
EdgeForcesIn<Scalar> edge_forces(const Eigen::Vector2<Data<Scalar>>& a,
                                 const Eigen::Vector2<Data<Scalar>>& b, Data<Scalar> outward) {
  const EdgeFrameIn<Scalar> frame = edge_frame<Scalar>(a, b);
  const Eigen::Vector2<Scalar>& s = frame.tangent;

  // Hermite: φ'(L/2) = 3 (φ_b − φ_a)/(2L) − (φ'_a + φ'_b)/4.
  const Scalar chord = Scalar(1.5) / frame.length_mm, quarter = Scalar(0.25);
  const std::array<Scalar, 7> slope = {
      -chord, -quarter * s.x(), -quarter * s.y(), chord, -quarter * s.x(), -quarter * s.y(), 0};
  EdgeForcesIn<Scalar> forces;
  for (int dof = 0; dof < 7; ++dof) {
    Scalar at_a[2], at_b[2];  // −3 g_a + 4 g_m − g_b and g_a − 4 g_m + 3 g_b
    for (int k = 0; k < 2; ++k) {
      const Scalar a_k = dof == 1 + k, b_k = dof == 4 + k;
      const Scalar middle = dof == 6 ? Scalar(outward) * frame.normal(k) : s(k) * slope[dof];
      at_a[k] = -3 * a_k + 4 * middle - b_k;
      at_b[k] = a_k - 4 * middle + 3 * b_k;
    }
    forces.col(dof) << at_a[1] / 2, -at_a[0] / 2, at_b[1] / 2, -at_b[0] / 2;
  }
  return forces;
}

template EdgeForcesIn<double> edge_forces<double>(const Eigen::Vector2d&, const Eigen::Vector2d&,
                                                  double);
template EdgeForcesIn<Wide> edge_forces<Wide>(const Eigen::Vector2d&, const Eigen::Vector2d&,
                                              double);

}  // namespace airybench
