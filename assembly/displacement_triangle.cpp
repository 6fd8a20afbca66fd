#include "assembly/displacement_triangle.hpp"

#include "assembly/bernstein.hpp"

namespace airybench {
namespace {

// Coefficients of one polynomial of degree k on the third t, by de Casteljau's steps to the
// centroid: ring c of the third has those after c steps, on its edge V_t V_(t+1).
Eigen::RowVectorXd on_third(int k, int t, Eigen::RowVectorXd c) {
  Eigen::RowVectorXd result(c.size());
  const auto place = [](int d, std::array<int, 3> alpha) {
    return ring_place(d, alpha[1], alpha[2]);
  };
  for (int ring = 0; ring <= k; ++ring) {
    const int d = k - ring;
    for (int b = 0; b <= d; ++b) {
      std::array<int, 3> alpha = {0, 0, 0};
      alpha[t] = d - b;
      alpha[(t + 1) % 3] = b;
      result(ring_place(k, b, ring)) = c(place(d, alpha));
    }
    Eigen::RowVectorXd next = c;
    for (int second = 0; second < d; ++second)
      for (int first = 0; first < d - second; ++first)
        next(ring_place(d - 1, first, second)) =
            (c(ring_place(d, first, second)) + c(ring_place(d, first + 1, second)) +
             c(ring_place(d, first, second + 1))) /
            3;
    c = next;
  }
  return result;
}

template <int p>
typename DisplacementTriangle<p>::Constants computed() {
  using Triangle = DisplacementTriangle<p>;
  typename Triangle::Constants result;
  result.mass = bernstein_mass<double>(p - 1, 1);
  for (int s = 0; s < Triangle::strains; ++s)
    for (int t = 0; t < 3; ++t)
      result.on_thirds.row(s).segment(Triangle::strains * t, Triangle::strains) =
          on_third(p - 1, t, Eigen::RowVectorXd::Unit(Triangle::strains, s));
  Eigen::Matrix<double, Triangle::strains, Triangle::nodes> derivative[2];
  for (int a = 0; a < 2; ++a) {
    derivative[a].setZero();
    for (int s = 0; s < Triangle::strains; ++s) {
      derivative[a](s, Triangle::node[s][a + 1]) = p;
      derivative[a](s, Triangle::node[s][0]) = -p;
    }
  }
  constexpr int pairs[3][2] = {{0, 0}, {1, 1}, {0, 1}};
  for (int i = 0; i < 3; ++i)
    result.stiffness[i] = derivative[pairs[i][0]].transpose().lazyProduct(
        result.mass.lazyProduct(derivative[pairs[i][1]]).eval());
  return result;
}

}  // namespace

template <int p>
const typename DisplacementTriangle<p>::Constants& DisplacementTriangle<p>::constants() {
  static const Constants constants = computed<p>();
  return constants;
}

#define AIRYBENCH_INSTANTIATE(k)                           \
  template const DisplacementTriangle<(k) + 1>::Constants& \
  DisplacementTriangle<(k) + 1>::constants();
AIRYBENCH_STRESS_DEGREES(AIRYBENCH_INSTANTIATE)
#undef AIRYBENCH_INSTANTIATE

}  // namespace airybench
