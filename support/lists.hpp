// Lists on the command line, "a,b". A separator or a backslash that is part of an item is written
// with a backslash before it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace airybench {

std::vector<std::string> split_list(std::string_view list, char separator = ',');

// The first item, and all behind its separator as it is written; no rest: there is no separator.
struct FirstItem {
  std::string item;
  std::optional<std::string_view> rest;
};
FirstItem first_item(std::string_view list, char separator);

}  // namespace airybench
