#include "support/lists.hpp"

#include <algorithm>
#include <cctype>

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

std::string nearest_of(std::string_view word, const std::vector<std::string>& names) {
  const auto are_alike = [](unsigned char a, unsigned char b) {
    return std::tolower(a) == std::tolower(b);
  };
  const auto distance_to = [&](std::string_view name) {
    // Levenshtein's rows, of the last three letters of word.
    std::vector<std::size_t> earlier(name.size() + 1), before(earlier), now(earlier);
    for (std::size_t k = 0; k <= name.size(); ++k) before[k] = k;
    for (std::size_t i = 1; i <= word.size(); ++i) {
      now[0] = i;
      for (std::size_t k = 1; k <= name.size(); ++k) {
        now[k] = std::min({before[k] + 1, now[k - 1] + 1,
                           before[k - 1] + (are_alike(word[i - 1], name[k - 1]) ? 0 : 1)});
        if (i > 1 && k > 1 && are_alike(word[i - 1], name[k - 2]) &&
            are_alike(word[i - 2], name[k - 1]))
          now[k] = std::min(now[k], earlier[k - 2] + 1);
      }
      earlier.swap(before);
      before.swap(now);
    }
    return before.back();
  };
  std::string nearest;
  std::size_t least = 0;
  bool is_only = true;
  for (const std::string& name : names) {
    const std::size_t distance = word.size() > 100 ? name.size() : distance_to(name);
    if (distance > std::max<std::size_t>(name.size() / 3, 1)) continue;
    if (nearest.empty() || distance < least) {
      nearest = name;
      least = distance;
      is_only = true;
    } else if (distance == least && name != nearest) {
      is_only = false;
    }
  }
  return is_only ? nearest : "";
}

std::string perhaps(std::string_view word, const std::vector<std::string>& names) {
  const std::string nearest = nearest_of(word, names);
  return nearest.empty() ? "" : ", perhaps " + nearest;
}

}  // namespace airybench
