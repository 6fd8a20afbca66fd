// What messages quote of what they were given.
#pragma once

#include <string>
#include <string_view>

namespace airybench {

// On one line and at most so many bytes long: control characters are '?', what is cut off is "…".
std::string shortened(std::string_view text, std::size_t most = 80);

}  // namespace airybench
