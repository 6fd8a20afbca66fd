#include "assembly/reference_element_templates.hpp"

namespace airybench {

template struct ReferenceElement<long double>;
template const ReferenceMatrices<long double>& reference_matrices(int k);
template <>
const ReferenceMatrices<double>& reference_matrices(int k) {
  return reference_formulas::rounded<double, long double>(k);
}

}  // namespace airybench
