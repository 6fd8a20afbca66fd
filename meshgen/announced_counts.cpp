#include "meshgen/announced_counts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <vector>

#include "support/errors.hpp"
#include "support/lists.hpp"

namespace airybench {
namespace {

// Behind which, or on whose next line, there are counts.
constexpr const char* keywords =
    "POINTS CELLS CELL_TYPES POLYGONS VERTICES LINES TRIANGLE_STRIPS CELL_DATA POINT_DATA "
    "Vertices Edges Triangles Quadrilaterals Tetrahedra Hexahedra Corners Ridges RequiredVertices "
    "RequiredEdges $PhysicalNames $Entities $Nodes $NOD $ParametricNodes $Elements $ELM "
    "$Periodic";

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view next_word(std::string_view& line) {
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  const std::string_view word = line.substr(0, line.find_first_of(" \t\r"));
  line.remove_prefix(word.size());
  return word;
}

// None: it is no whole number.
std::optional<std::uint64_t> count_of(std::string_view word) {
  std::uint64_t count = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
  if (end != word.data() + word.size() || word.empty()) return {};
  return error == std::errc::result_out_of_range ? UINT64_MAX : count;
}

// 80 bytes of text, the number of facets, and 50 bytes for each.
void refuse_stl_beyond(const std::string& text) {
  constexpr std::size_t header = 80, of_facet = 50;
  std::uint32_t facets = 0;
  if (text.size() < header + sizeof facets) return;
  std::memcpy(&facets, text.data() + header, sizeof facets);
  if (facets > (text.size() - header - sizeof facets) / of_facet)
    throw InputError(fmt::format("{} facets (allowed: up to {}, by its length)", facets,
                                 (text.size() - header - sizeof facets) / of_facet));
}

// A word on this line or a later one, and the number of its line.
std::string_view next_word(std::string_view& text, std::size_t& line) {
  for (; !text.empty() && (is_blank(text.front()) || text.front() == '\n'); text.remove_prefix(1))
    line += text.front() == '\n';
  const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n"));
  text.remove_prefix(word.size());
  return word;
}

}  // namespace

// An element is six numbers, of which the second is its type and the sixth the count of its nodes,
// three more of a beam's sections, and the nodes.
void refuse_unv_counts_beyond(const std::string& text) {
  constexpr std::string_view elements = "2412", end = "-1";
  std::string_view left = text, word, before;
  for (std::size_t line = 1; !(word = next_word(left, line)).empty(); before = word) {
    if (word != elements || before != end) continue;
    for (;;) {
      std::array<std::optional<std::uint64_t>, 6> element;
      for (auto& number : element)
        if (!(number = count_of(word = next_word(left, line)))) break;
      const auto [type, nodes] = std::pair(element[1], element[5]);
      if (!nodes) break;  // the section's end, or nothing that can be read
      if (*nodes > text.size())
        throw InputError(
            fmt::format("line {}: an element of {} nodes (allowed: up to {}, the "
                        "file's bytes)",
                        line, *nodes, text.size()));
      const bool is_beam = *type == 11 || (21 <= *type && *type <= 24);
      for (std::uint64_t k = 0; k < *nodes + (is_beam ? 3 : 0); ++k) next_word(left, line);
    }
  }
}

void refuse_counts_beyond(const std::string& text, bool is_stl) {
  if (is_stl) {
    if (text.find('\0') != text.npos) refuse_stl_beyond(text);
    return;
  }
  static const std::vector<std::string> known = split_list(keywords, ' ');
  std::string_view left = text, pending;  // a keyword whose counts are on the next line
  for (std::size_t number = 1; !left.empty(); ++number) {
    std::string_view line = left.substr(0, left.find('\n'));
    left.remove_prefix(std::min(line.size() + 1, left.size()));
    std::string_view keyword = pending;
    if (pending.empty()) keyword = next_word(line);
    if (keyword.empty() || (pending.empty() && std::ranges::find(known, keyword) == known.end()))
      continue;
    std::string_view word = next_word(line);
    if (word.empty()) {
      pending = keyword;
      continue;
    }
    pending = {};
    // Of MSH 4 the third and fourth are the numbers of nodes, which may be any.
    for (int k = 0; k < 2; ++k, word = next_word(line))
      if (const auto count = count_of(word); count && *count > text.size())
        throw InputError(fmt::format("line {}: {} {} (allowed: up to {}, the file's bytes)", number,
                                     keyword, word, text.size()));
  }
}

}  // namespace airybench
