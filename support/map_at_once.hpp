// Large arrays of which all is written soon are mapped at once, by pages of 2 MiB where the system
// has them, instead of page by page on the first touch. A hint, nothing else.
#pragma once

#include <cstddef>

namespace airybench {

void map_at_once(void* array, std::size_t bytes);

}  // namespace airybench
