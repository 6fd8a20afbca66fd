#include "assembly/elements/curved_element_templates.hpp"

namespace airybench {

template class CurvedElement<double>;
template class CurvedElement<Wide>;

}  // namespace airybench
