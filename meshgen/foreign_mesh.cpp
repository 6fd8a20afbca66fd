#include "meshgen/foreign_mesh.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <set>
#include <sstream>

#include "support/errors.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

// The lines of a text that are not empty.
class TextLines {
 public:
  explicit TextLines(const std::string& text) : text_(text) {}

  std::optional<std::istringstream> next() {
    while (std::getline(text_, line_)) {
      ++number_;
      if (line_.find_first_not_of(" \t\r") != line_.npos) return std::istringstream(line_);
    }
    return {};
  }
  // All of the next line.
  template <typename... Numbers>
  void read(const char* expected, Numbers&... numbers) {
    std::optional<std::istringstream> fields = next();
    if (!fields)
      throw InputError(fmt::format("it ends where '{}' should come; is it truncated?", expected));
    if (!(*fields >> ... >> numbers) || !(*fields >> std::ws).eof())
      fail(fmt::format("'{}' (expected: {})", shortened(line_), expected));
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("line {}: {}", number_, what));
  }
  const std::string& line() const { return line_; }

 private:
  std::istringstream text_;
  std::string line_;
  long number_ = 0;
};

}  // namespace

void add_plane_element(Deck& deck, std::vector<long> nodes, std::size_t corners,
                       const std::string& body) {
  const long number = static_cast<long>(deck.elements.size()) + 1;
  const std::size_t count = nodes.size();
  deck.elements[number] = {
      "", DeckElement::Kind::plane_strain, count, corners, false, std::move(nodes)};
  deck.body[number] = body;
}

bool is_of_freefem(const std::string& text) {
  std::istringstream first(text.substr(0, text.find('\n')));
  long vertices = 0, triangles = 0, edges = 0;
  return (first >> vertices >> triangles >> edges) && (first >> std::ws).eof();
}

std::string msh_of_freefem(const std::string& text) {
  TextLines lines(text);
  long vertices = 0, triangles = 0, edges = 0, label = 0, highest = 0;
  lines.read("vertices triangles edges", vertices, triangles, edges);
  if (vertices < 3 || triangles < 1 || edges < 0) lines.fail("no mesh of triangles");
  Deck deck;
  std::set<long> regions;
  for (long k = 1; k <= vertices; ++k) {
    double x = 0, y = 0;
    lines.read("x y label", x, y, label);
    deck.nodes[k] = {x, y, 0};
  }
  const auto check = [&](std::initializer_list<long> nodes) {
    for (const long node : nodes)
      if (node < 1 || node > vertices)
        lines.fail(fmt::format("vertex {} (allowed: 1 to {})", node, vertices));
  };
  for (long k = 1; k <= triangles; ++k) {
    long a = 0, b = 0, c = 0, region = 0;
    lines.read("vertex vertex vertex region", a, b, c, region);
    check({a, b, c});
    add_plane_element(deck, {a, b, c}, 3, fmt::format("body{}", region));
    regions.insert(region);
  }
  if (regions.size() == 1)
    for (auto& [element, body] : deck.body) body = "body";
  std::map<DeckEdge, long> labels;
  for (long k = 1; k <= edges; ++k) {
    long a = 0, b = 0;
    lines.read("vertex vertex label", a, b, label);
    check({a, b});
    labels[deck_edge(a, b)] = label;
    highest = std::max(highest, label);
    if (label != 0) deck.names[deck_edge(a, b)].insert(std::to_string(label));
  }
  if (lines.next()) lines.fail("more than its first line says");
  constexpr long most = 1'000'000'000;
  std::map<DeckEdge, int> curves;
  for (const auto& [edge, own] : labels) {
    const long number = own > 0 ? own : highest + 1 - own;
    if (own < -most || number > most)
      throw InputError(fmt::format("label {} (allowed: up to {})", own, most));
    curves[edge] = static_cast<int>(number);
  }
  return msh_of(deck, curves);
}

std::string msh_of_obj(const std::string& text) {
  TextLines lines(text);
  Deck deck;
  std::vector<long> node_of_vertex;
  std::map<std::array<double, 3>, long> node_at;
  while (std::optional<std::istringstream> fields = lines.next()) {
    std::string word;
    *fields >> word;
    if (word == "v") {
      std::array<double, 3> x{};
      if (!(*fields >> x[0] >> x[1] >> x[2]))
        lines.fail(fmt::format("'{}' (expected: v x y z)", shortened(lines.line())));
      const long node = node_at.try_emplace(x, static_cast<long>(node_at.size()) + 1).first->second;
      node_of_vertex.push_back(node);
      deck.nodes[node] = {x[0], x[1], x[2]};
    } else if (word == "f") {
      std::vector<long> nodes;
      const auto count = static_cast<long>(node_of_vertex.size());
      while (*fields >> word) {  // vertex, vertex/texture, vertex/texture/normal
        long vertex = 0;
        std::from_chars(word.data(), word.data() + word.size(), vertex);
        if (vertex < 0) vertex += count + 1;  // counted from the last
        if (vertex < 1 || vertex > count)
          lines.fail(fmt::format("vertex '{}' (allowed: 1 to {})", shortened(word), count));
        nodes.push_back(node_of_vertex[static_cast<std::size_t>(vertex) - 1]);
      }
      if (nodes.size() != 3 && nodes.size() != 4)
        lines.fail(fmt::format("a face of {} corners (allowed: 3 or 4)", nodes.size()));
      const std::size_t corners = nodes.size();
      add_plane_element(deck, std::move(nodes), corners, "body");
    }
  }
  if (deck.elements.empty()) throw InputError("no line f, a face");
  return msh_of(deck, {});
}

}  // namespace airybench
