// Counts that a file announces, against its length: before Gmsh takes memory for so many.
#pragma once

#include <string>

namespace airybench {

// Most of what a file may ask for in few bytes: numbers of a list, lines and members of a deck.
inline constexpr std::size_t max_entries = 10'000'000;

// Of MSH, VTK, Medit, or STL files. Throws InputError: there cannot be so many.
void refuse_counts_beyond(const std::string& text, bool is_stl = false);
// Of the nodes that an element of a .unv has.
void refuse_unv_counts_beyond(const std::string& text);

}  // namespace airybench
