// The process's resident set, from Linux's /proc. Includes everything: code, heap, mapped buffers.
#pragma once

#include <cstdint>
#include <optional>

namespace airybench::rss {

// Sets the kernel's high-water mark to the present resident set; false where that is not allowed.
bool reset_peak();
// The high-water mark (VmHWM), bytes.
std::optional<std::int64_t> peak_bytes();

}  // namespace airybench::rss
