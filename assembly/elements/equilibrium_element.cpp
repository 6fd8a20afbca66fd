#include "assembly/elements/equilibrium_element_templates.hpp"

namespace airybench {

#define AIRYBENCH_INSTANTIATE(Scalar, k)        \
  template class EquilibriumElement<Scalar, k>; \
  template EquilibriumElement<Scalar, k>::Stress linear_stress<k>(const Eigen::Matrix3<Scalar>&);
#define AIRYBENCH_INSTANTIATE_DEGREE(k) \
  AIRYBENCH_INSTANTIATE(double, k)      \
  AIRYBENCH_INSTANTIATE(Wide, k)
AIRYBENCH_STRESS_DEGREES(AIRYBENCH_INSTANTIATE_DEGREE)

}  // namespace airybench
