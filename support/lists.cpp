#include "support/lists.hpp"

namespace airybench {

FirstItem first_item(std::string_view list, char separator) {
  FirstItem first;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const char next = i + 1 < list.size() ? list[i + 1] : '\0';
    if (list[i] == separator) {
      first.rest = list.substr(i + 1);
      break;
    }
    if (list[i] == '\\' && (next == separator || next == '\\')) ++i;
    first.item += list[i];
  }
  return first;
}

std::vector<std::string> split_list(std::string_view list, char separator) {
  std::vector<std::string> items;
  for (std::optional<std::string_view> rest = list; rest;) {
    FirstItem first = first_item(*rest, separator);
    items.push_back(std::move(first.item));
    rest = first.rest;
  }
  return items;
}

}  // namespace airybench
