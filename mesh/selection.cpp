#include "mesh/selection.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <stdexcept>

#include "mesh/model_format.hpp"
#include "support/lists.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

[[noreturn]] void refuse_item(std::string_view item, const std::string& why) {
  throw std::invalid_argument("mesh '" + shortened(item) + "': " + why +
                              " (valid: Mesh0..Mesh7, a list Mesh0,Mesh3, a range Mesh1..Mesh4, "
                              "a glob Mesh[0-3], any of these with +refine1 … +refine" +
                              std::to_string(max_named_refinements) + ", or files *.msh, " +
                              std::string(model_extensions) + ")");
}

std::size_t catalogue_row(std::string_view name, std::string_view item) {
  const auto found = std::find(catalogue_mesh_names.begin(), catalogue_mesh_names.end(), name);
  if (found == catalogue_mesh_names.end())
    refuse_item(item, "not in the catalogue" + perhaps(name, {catalogue_mesh_names.begin(),
                                                              catalogue_mesh_names.end()}));
  return static_cast<std::size_t>(found - catalogue_mesh_names.begin());
}

std::vector<std::string> expand_item(std::string_view item) {
  if (item.empty()) refuse_item(item, "empty");
  if (is_mesh_file(item)) return {std::string(item)};
  if (const auto plus = item.find('+'); plus != item.npos) {
    const std::optional<RefinedName> refined = parse_refined_name(item);
    if (!refined) refuse_item(item, "no such suffix");
    std::vector<std::string> names = expand_item(refined->name);
    for (std::string& name : names) name += item.substr(plus);
    return names;
  }

  std::size_t first = 0, last = 0;
  if (const auto dots = item.find(".."); dots != item.npos) {
    first = catalogue_row(item.substr(0, dots), item);
    last = catalogue_row(item.substr(dots + 2), item);
    if (first > last) refuse_item(item, "a range runs from the lower to the higher name");
  } else if (item.find_first_of("*?[") != item.npos) {
    const std::string pattern(item);
    std::vector<std::string> names;
    for (const std::string_view name : catalogue_mesh_names)
      if (fnmatch(pattern.c_str(), name.data(), 0) == 0) names.emplace_back(name);
    if (names.empty()) refuse_item(item, "matches no mesh");
    return names;
  } else {
    first = last = catalogue_row(item, item);
  }
  return {catalogue_mesh_names.begin() + static_cast<std::ptrdiff_t>(first),
          catalogue_mesh_names.begin() + static_cast<std::ptrdiff_t>(last) + 1};
}

}  // namespace

std::optional<RefinedName> parse_refined_name(std::string_view name) {
  constexpr std::string_view suffix = "+refine";
  const auto at = name.find('+');
  if (at == 0 || at == name.npos || name.size() != at + suffix.size() + 1) return {};
  const int times = name.back() - '0';
  if (name.substr(at, suffix.size()) != suffix || times < 1 || times > max_named_refinements)
    return {};
  return RefinedName{name.substr(0, at), times};
}

bool is_mesh_file(std::string_view item) {
  return item.find('/') != item.npos || format_of(item) != ModelFormat::other;
}

std::vector<std::string> expand_mesh_selection(std::string_view argument) {
  std::vector<std::string> selected;
  for (const std::string& item : split_list(argument))
    for (std::string& name : expand_item(item))
      if (std::find(selected.begin(), selected.end(), name) == selected.end())
        selected.push_back(std::move(name));
  return selected;
}

}  // namespace airybench
