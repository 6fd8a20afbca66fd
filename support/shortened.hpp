#pragma once

#include <string>
#include <string_view>

namespace airybench {

// One line of at most `most` bytes: '?' for control characters, "…" for the rest of a cut text.
std::string shortened(std::string_view text, std::size_t most = 80);

}  // namespace airybench
