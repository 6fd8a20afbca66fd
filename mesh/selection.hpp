// The argument of --mesh: which meshes of the catalogue Mesh0..Mesh7, and which files.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace airybench {

inline constexpr std::array<std::string_view, 8> catalogue_mesh_names = {
    "Mesh0", "Mesh1", "Mesh2", "Mesh3", "Mesh4", "Mesh5", "Mesh6", "Mesh7"};

// A comma-separated list of
//   names    Mesh3              ranges  Mesh0..Mesh7 (both ends included)
//   globs    Mesh[0-3], Mesh*   files   anything with a '/' or ending as one of
//                                        model_format.hpp, kept as it is
// and behind names, ranges and globs +refine1 … +refine6: refined uniformly so many times.
// Order as written, without duplicates. Throws std::invalid_argument, one line with the bad item
// and what is valid.
std::vector<std::string> expand_mesh_selection(std::string_view argument);

// "Mesh3+refine2" parted: "Mesh3", 2. Without a suffix, or with another one, none.
inline constexpr int max_named_refinements = 6;
struct RefinedName {
  std::string_view name;
  int times;
};
std::optional<RefinedName> parse_refined_name(std::string_view name);

// Is this selected item a file, rather than a mesh of the catalogue?
bool is_mesh_file(std::string_view item);

}  // namespace airybench
