// Lists on the command line, "a,b". A backslash escapes a separator or a backslash in an item.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace airybench {

std::vector<std::string> split_list(std::string_view list, char separator = ',');

// rest: the raw text after the separator; empty if there is no separator.
struct FirstItem {
  std::string item;
  std::optional<std::string_view> rest;
};
FirstItem first_item(std::string_view list, char separator);

}  // namespace airybench
