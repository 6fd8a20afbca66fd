#include "support/shortened.hpp"

#include <algorithm>

namespace airybench {

std::string shortened(std::string_view text, std::size_t most) {
  constexpr std::string_view ellipsis = "…";
  std::string line(text.substr(0, most));
  if (text.size() > most) {
    std::size_t end = most - ellipsis.size();
    while (end > 0 && (text[end] & 0xC0) == 0x80) --end;  // not in the middle of a character
    line.resize(end);
    line += ellipsis;
  }
  std::replace_if(
      line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, '?');
  return line;
}

}  // namespace airybench
