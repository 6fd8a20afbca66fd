// Large arrays that are written once and read many times are mapped by pages of 2 MiB where the
// system has them: fewer faults on the first touch. A hint, nothing else.
#pragma once

#include <cstddef>

namespace airybench {

void prefer_huge_pages(void* array, std::size_t bytes);

}  // namespace airybench
