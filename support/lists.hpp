// Lists: on the command line, "a,b", and in messages, "a, b". A backslash escapes a separator or a
// backslash in an item.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace airybench {

std::vector<std::string> split_list(std::string_view list, char separator = ',');

// "a, b" of a range of texts.
template <typename Texts>
std::string joined(const Texts& texts, std::string_view separator = ", ") {
  std::string all;
  for (const auto& text : texts) {
    if (!all.empty()) all += separator;
    all += text;
  }
  return all;
}

// rest: the raw text after the separator; empty if there is no separator.
struct FirstItem {
  std::string item;
  std::optional<std::string_view> rest;
};
FirstItem first_item(std::string_view list, char separator);

// The name that becomes word with the fewest letters changed, added, left out or swapped with the
// next, at most a third of its own, capitals or not; empty if there is none, or several.
std::string nearest_of(std::string_view word, const std::vector<std::string>& names);
// ", perhaps NAME" with that name, or empty.
std::string perhaps(std::string_view word, const std::vector<std::string>& names);

}  // namespace airybench
