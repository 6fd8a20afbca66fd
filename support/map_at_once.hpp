// A hint that a large array will soon be written in full: maps it at once, by pages of 2 MiB if the
// system has them, instead of page by page on the first touch.
#pragma once

#include <cstddef>

namespace airybench {

void map_at_once(void* array, std::size_t bytes);

}  // namespace airybench
