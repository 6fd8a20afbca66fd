#include "assembly/elements/reference_element_templates.hpp"

namespace airybench {

template struct ReferenceElement<Wide>;
template const ReferenceMatrices<Wide>& reference_matrices(int k);
template <>
const ReferenceMatrices<double>& reference_matrices(int k) {
  return reference_formulas::rounded<double, Wide>(k);
}

}  // namespace airybench
