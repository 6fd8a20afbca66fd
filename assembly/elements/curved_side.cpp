#include "assembly/elements/curved_element_templates.hpp"

namespace airybench {

template struct CurvePoint<double>;
template struct CurvePoint<Wide>;
template class CurvedThird<double>;
template class CurvedThird<Wide>;
template class CurvedSide<double>;
template class CurvedSide<Wide>;

}  // namespace airybench
