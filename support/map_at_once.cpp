#include "support/map_at_once.hpp"

#include <cstdint>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace airybench {

void map_at_once([[maybe_unused]] void* array, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
  constexpr std::uintptr_t page = 4096;
  const auto start = reinterpret_cast<std::uintptr_t>(array);
  const std::uintptr_t first = (start + page - 1) / page * page,
                       end = (start + bytes) / page * page;
  if (end <= first) return;
  ::madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
#ifdef MADV_POPULATE_WRITE
  ::madvise(reinterpret_cast<void*>(first), end - first, MADV_POPULATE_WRITE);
#endif
#endif
}

}  // namespace airybench
