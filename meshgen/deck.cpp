#include "meshgen/deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "meshgen/announced_counts.hpp"
#include "support/errors.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

using Kind = DeckElement::Kind;

// Without nodes. None: not of a plane body.
std::optional<DeckElement> element_of(const std::string& type) {
  DeckElement element{type, Kind::plane_stress, 0, 0, false, {}};
  const auto of = [&](Kind kind, std::size_t nodes, std::size_t corners, bool is_shell) {
    element.kind = kind;
    element.node_count = nodes;
    element.corner_count = corners;
    element.is_shell = is_shell;
    return std::optional(element);
  };
  if (type.starts_with("STRI65")) return of(Kind::plane_stress, 6, 3, true);
  if (type.starts_with("SC")) return {};
  const auto digit_at = [&](std::size_t at) {
    return at < type.size() ? static_cast<std::size_t>(std::max(0, type[at] - '0')) : 0;
  };
  for (const char* line : {"T2D", "T3D", "R2D"})
    if (type.starts_with(line)) return of(Kind::line, digit_at(3), 2, false);
  for (const char* beam : {"B2", "B3"})  // B21 has two nodes, B22 three
    if (type.starts_with(beam)) return of(Kind::line, digit_at(2) + 1, 2, false);
  for (const std::string_view prefix : {"R3D", "M3D", "SFM3D", "CPS", "CPE", "STRI", "S"}) {
    if (!type.starts_with(prefix)) continue;
    const std::size_t nodes = digit_at(prefix.size());
    if (nodes != 3 && nodes != 4 && nodes != 6 && nodes != 8) return {};
    // Integration, hybrid pressure, small strains; others have temperatures or pores.
    constexpr std::array<std::string_view, 11> variants = {"",   "R",  "I",  "H",   "M", "RH",
                                                           "IH", "MH", "RS", "RSW", "R5"};
    if (std::ranges::find(variants, type.substr(prefix.size() + 1)) == variants.end()) return {};
    return of(prefix == "CPE" ? Kind::plane_strain : Kind::plane_stress, nodes,
              nodes % 3 == 0 ? 3 : 4, !type.starts_with("C"));
  }
  return {};
}

// Read without these, the body would be another.
void refuse_what_moves_or_adds(const DeckBlock& block) {
  const auto fail = [&](const std::string& what) { block.line.fail(what); };
  if ((block.keyword == "NODE" || block.keyword == "ELEMENT") && block.has("INPUT"))
    fail(fmt::format("*{}, INPUT (allowed: its lines here, or *INCLUDE)", block.keyword));
  for (const char* made : {"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY"})
    if (block.keyword == made)
      fail(fmt::format("*{} (allowed: each node and element is written)", block.keyword));
  const std::string system = in_capitals(block.value("SYSTEM"));
  if (block.keyword == "SYSTEM" || (block.keyword == "NODE" && !system.empty() && system != "R"))
    fail("coordinates of a system of their own (allowed: x and y of the model)");
}

class DeckReader {
 public:
  DeckReader(const std::string& text, const std::filesystem::path& folder) {
    deck_.file = read_deck_file(text, folder);
  }

  Deck read() {
    set_instance_step();
    find_shadowed_names();
    each("NODE", [&](const DeckBlock& b, const DeckLine& line) { add_node(b, line); });
    for (DeckBlock& block : deck_.file.blocks) {
      refuse_what_moves_or_adds(block);
      if (block.keyword == "ELEMENT") add_elements(block);
      if (block.keyword == "ELEMENT" || block.keyword == "NODE") block.data = {};  // most of a deck
      if (block.keyword == "SOLID SECTION" || block.keyword == "SHELL SECTION" ||
          block.keyword == "MEMBRANE SECTION")
        sections_.insert(deck_.full_name(block.value("ELSET"), block));
    }
    if (deck_.elements.empty()) throw InputError("it has no elements");
    each("NSET", [&](const DeckBlock& b, const DeckLine& line) {
      add_to_set(b, line, deck_.nodes, deck_.node_sets, "NSET");
    });
    each("ELSET", [&](const DeckBlock& b, const DeckLine& line) {
      given_sets_.insert(deck_.full_name(b.value("ELSET"), b));
      add_to_set(b, line, deck_.elements, deck_.element_sets, "ELSET");
    });
    for (Deck::Sets* sets : {&deck_.node_sets, &deck_.element_sets})
      for (auto& [name, members] : *sets) {
        std::ranges::sort(members);
        members.erase(std::unique(members.begin(), members.end()), members.end());
      }
    each("SURFACE", [&](const DeckBlock& b, const DeckLine& line) { add_to_surface(b, line); });
    set_boundary();
    for (const auto& [name, nodes] : node_surfaces_) add_edges_between(nodes, deck_.surfaces[name]);
    name_edges();
    deck_.body = bodies();
    return std::move(deck_);
  }

 private:
  template <typename Take>
  void each(const char* keyword, const Take& take) const {
    for (const DeckBlock& block : deck_.file.blocks)
      if (block.keyword == keyword)
        for (const DeckLine& line : block.data) take(block, line);
  }

  void set_instance_step() {
    if (deck_.file.instances.size() < 2) return;
    long largest = 0;
    for (const DeckBlock& block : deck_.file.blocks)
      if (block.keyword == "NODE" || block.keyword == "ELEMENT")
        for (const DeckLine& line : block.data)
          if (const std::string number = line.fields()[0]; !number.empty())
            largest = std::max(largest, line.whole(number));
    deck_.instance_step = 1000;
    constexpr long most = 100'000'000;
    while (deck_.instance_step <= largest && deck_.instance_step < most) deck_.instance_step *= 10;
  }

  void find_shadowed_names() {
    if (deck_.file.instances.size() != 1) return;
    DeckNames of_instance, of_model;
    for (const DeckBlock& block : deck_.file.blocks)
      for (const char* parameter : {"NSET", "ELSET", "NAME"})
        if (block.has(parameter))
          (block.instance >= 0 ? of_instance : of_model).insert(block.value(parameter));
    for (const std::string& name : of_instance)
      if (of_model.contains(name)) deck_.shadowed.insert(name);
  }

  void add_node(const DeckBlock& block, const DeckLine& line) {
    const std::vector<std::string> fields = line.fields();
    if (fields.size() < 3) line.fail("a node has a number, x and y");
    Eigen::Vector3d place(0, 0, 0);
    for (std::size_t k = 1; k < std::min<std::size_t>(fields.size(), 4); ++k)
      if (!fields[k].empty()) place[static_cast<Eigen::Index>(k) - 1] = line.number(fields[k]);
    if (block.instance >= 0)
      place = deck_.file.instances[static_cast<std::size_t>(block.instance)].placed * place;
    const long node = deck_.full_number(fields[0], block, line);
    if (!deck_.nodes.emplace(node, place).second)
      line.fail(fmt::format("node {} is given twice", node));
    if (block.has("NSET"))
      deck_.node_sets[deck_.full_name(block.value("NSET"), block)].push_back(node);
  }

  void add_elements(const DeckBlock& block) {
    const std::string type = in_capitals(block.value("TYPE"));
    if (type.starts_with("CAX") || type.starts_with("CGAX") || type.starts_with("SAX"))
      block.line.fail(fmt::format(
          "elements of type {}: an axisymmetric body (allowed: a plane one, as CPE4, CPS4)", type));
    const std::optional<DeckElement> model = element_of(type);
    if (!model)
      block.line.fail(
          fmt::format("elements of type {} (allowed: of a plane body, as CPE3, CPS4, CPE6, S8, and "
                      "lines, as T2D2)",
                      type));
    const std::string set = deck_.full_name(block.value("ELSET"), block);
    std::vector<std::string> pending;  // over several lines
    for (const DeckLine& line : block.data) {
      std::vector<std::string> fields = line.fields();
      if (fields.back().empty()) fields.pop_back();
      pending.insert(pending.end(), fields.begin(), fields.end());
      if (pending.size() < model->node_count + 1) continue;
      if (pending.size() > model->node_count + 1)
        line.fail(fmt::format("{} nodes (allowed: {} of a {})", pending.size() - 1,
                              model->node_count, type));
      const long number = deck_.full_number(pending[0], block, line);
      DeckElement element = *model;
      for (std::size_t k = 1; k < pending.size(); ++k) {
        element.nodes.push_back(deck_.full_number(pending[k], block, line));
        if (!deck_.nodes.contains(element.nodes.back()))
          line.fail(fmt::format("node {} does not exist", pending[k]));
      }
      for (std::size_t k = 0; k < element.corner_count; ++k)
        if (std::ranges::count(element.nodes, element.nodes[k]) > 1)
          line.fail(fmt::format("element {} has node {} twice", number, element.nodes[k]));
      if (!element.is_plane() && element.nodes.size() == 3)  // its middle comes second
        std::swap(element.nodes[1], element.nodes[2]);
      if (!deck_.elements.emplace(number, std::move(element)).second)
        line.fail(fmt::format("element {} is given twice", number));
      set_of_keyword_[number] = set;
      if (!set.empty()) deck_.element_sets[set].push_back(number);
      pending.clear();
    }
    if (!pending.empty())
      block.data.back().fail(fmt::format("{} nodes (allowed: {} of a {})", pending.size() - 1,
                                         model->node_count, type));
  }

  // Of members that do not exist none is added by GENERATE.
  template <typename Members>
  void add_to_set(const DeckBlock& block, const DeckLine& line, const Members& members,
                  Deck::Sets& sets, const char* parameter) {
    const std::string name = deck_.full_name(block.value(parameter), block);
    if (name.empty()) block.line.fail(fmt::format("*{} without a name", block.keyword));
    std::vector<long>& set = sets[name];
    const std::vector<std::string> fields = line.fields();
    if (!block.has("GENERATE")) {
      for (const std::string& field : fields) {
        if (field.empty()) continue;
        if (in_capitals(deck_.full_name(field, block)) == in_capitals(name))
          line.fail(fmt::format("set {} holds itself", name));
        const std::vector<long> more = deck_.members(sets, field, block, line);
        count_members(more.size(), line);
        set.insert(set.end(), more.begin(), more.end());
      }
      return;
    }
    if (fields.size() < 2) line.fail("GENERATE needs a first and a last number");
    const long first = deck_.full_number(fields[0], block, line),
               last = deck_.full_number(fields[1], block, line),
               step = fields.size() > 2 && !fields[2].empty() ? line.whole(fields[2]) : 1;
    if (step < 1) line.fail("GENERATE: allowed: a step of 1 or more");
    for (auto at = members.lower_bound(first); at != members.end() && at->first <= last; ++at)
      if ((at->first - first) % step == 0) {
        count_members(1, line);
        set.push_back(at->first);
      }
  }

  void count_members(std::size_t more, const DeckLine& line) {
    members_ += more;
    if (members_ > max_entries)
      line.fail("all sets together have more than 1e7 members (allowed: up to that)");
  }

  void add_to_surface(const DeckBlock& block, const DeckLine& line) {
    const std::vector<std::string> fields = line.fields();
    const std::string name = deck_.full_name(block.value("NAME"), block);
    if (in_capitals(block.value("TYPE")) == "NODE") {
      std::set<long>& set = node_surfaces_[name];
      const std::vector<long> more = deck_.members(deck_.node_sets, fields[0], block, line);
      set.insert(more.begin(), more.end());
      return;
    }
    if (fields.size() < 2 || fields[1].empty())
      line.fail("a surface without a side (allowed: as 'Eleft, S1')");
    for (const long element : deck_.members(deck_.element_sets, fields[0], block, line))
      deck_.surfaces[name].insert(deck_.side(element, fields[1], line));
  }

  void set_boundary() {
    std::map<DeckEdge, std::vector<long>> elements;
    for (const auto& [number, element] : deck_.elements)
      for (std::size_t k = 0; element.is_plane() && k < element.corner_count; ++k)
        elements[deck_edge(element.nodes[k], element.nodes[(k + 1) % element.corner_count])]
            .push_back(number);
    for (const auto& [edge, of] : elements)
      if (of.size() == 1) deck_.boundary.emplace(edge, of.front());
  }

  void add_edges_between(const std::set<long>& nodes, std::set<DeckEdge>& edges) const {
    for (const auto& [edge, element] : deck_.boundary)
      if (nodes.contains(edge[0]) && nodes.contains(edge[1])) edges.insert(edge);
  }

  void name_edges() {
    for (const auto& [name, numbers] : deck_.element_sets)
      for (const long number : numbers)
        if (const auto found = deck_.elements.find(number);
            found != deck_.elements.end() && !found->second.is_plane())
          deck_.names[deck_edge(found->second.nodes[0], found->second.nodes[1])].insert(name);
    for (const auto& [name, numbers] : deck_.node_sets) {
      std::set<DeckEdge> edges;
      add_edges_between({numbers.begin(), numbers.end()}, edges);
      for (const DeckEdge& edge : edges) deck_.names[edge].insert(name);
    }
    for (const auto& [name, edges] : deck_.surfaces)
      for (const DeckEdge& edge : edges) deck_.names[edge].insert(name);
  }

  // Empty unless the sets share out the plane elements.
  std::map<long, std::string> shared_out(const DeckNames& sets) const {
    std::map<long, std::string> body;
    for (const std::string& set : sets)
      if (const auto found = deck_.element_sets.find(set); found != deck_.element_sets.end())
        for (const long number : found->second)
          if (const auto it = deck_.elements.find(number);
              it != deck_.elements.end() && it->second.is_plane() &&
              !body.emplace(number, found->first).second)
            return {};
    for (const auto& [number, element] : deck_.elements)
      if (element.is_plane() && !body.contains(number)) return {};
    return body;
  }

  std::map<long, std::string> bodies() const {
    std::map<long, std::string> body = shared_out(sections_);
    if (body.empty()) body = shared_out(given_sets_);
    if (body.empty())
      for (const auto& [number, set] : set_of_keyword_) body[number] = set.empty() ? "body" : set;
    return body;
  }

  Deck deck_;
  std::map<long, std::string> set_of_keyword_;  // of *ELEMENT
  std::size_t members_ = 0;                     // of sets, as often as they are named
  std::map<std::string, std::set<long>, WithoutCase> node_surfaces_;
  DeckNames given_sets_, sections_;  // of *ELSET, of *SOLID SECTION and its like
};

}  // namespace

std::string Deck::full_name(const std::string& name, const DeckBlock& block) const {
  if (name.empty()) return name;
  if (instance_step == 0) {
    if (file.instances.empty()) return name;
    const std::string prefix = file.instances.front().name + ".";
    const bool is_qualified = in_capitals(name).starts_with(in_capitals(prefix));
    const std::string own = is_qualified ? name.substr(prefix.size()) : name;
    return (is_qualified || block.instance >= 0) && shadowed.contains(own) ? prefix + own : own;
  }
  if (block.instance >= 0)
    return fmt::format("{}.{}", file.instances[static_cast<std::size_t>(block.instance)].name,
                       name);
  return name;
}

long Deck::full_number(const std::string& number, const DeckBlock& block,
                       const DeckLine& line) const {
  std::string of = block.value("INSTANCE"), own = number;
  if (const std::size_t dot = number.rfind('.'); dot != number.npos) {  // "plate-1.5"
    of = number.substr(0, dot);
    own = number.substr(dot + 1);
  }
  const long plain = line.whole(own);
  if (instance_step == 0) return plain;
  if (plain < 0 || plain >= instance_step)
    line.fail(fmt::format("number {} (allowed: from 0 to {})", plain, instance_step - 1));
  long instance = block.instance;
  for (std::size_t k = 0; k < file.instances.size() && !of.empty(); ++k)
    if (in_capitals(file.instances[k].name) == in_capitals(of)) instance = static_cast<long>(k);
  return plain + (instance + 1) * instance_step;
}

std::vector<long> Deck::members(const Sets& sets, const std::string& name, const DeckBlock& block,
                                const DeckLine& line) const {
  const std::string of = block.value("INSTANCE");
  for (const std::string& full :
       {full_name(name, block), of.empty() ? name : fmt::format("{}.{}", of, name)})
    if (const auto set = sets.find(full); set != sets.end()) return set->second;
  const bool is_number = name.find_first_not_of("0123456789") == name.npos ||
                         (instance_step > 0 && name.rfind('.') != name.npos);
  if (!is_number)
    line.fail(fmt::format("'{}' is no set (allowed: one, or a whole number)", shortened(name)));
  return {full_number(name, block, line)};
}

DeckEdge Deck::side(long number, const std::string& text, const DeckLine& line) const {
  const std::string side = in_capitals(text);
  const auto found = elements.find(number);
  const bool is_edge = side.size() == 2 && (side[0] == 'S' || side[0] == 'E' || side[0] == 'P');
  if (found == elements.end() || !is_edge)
    line.fail(fmt::format("side {} of element {} does not exist", side, number));
  const DeckElement& element = found->second;
  const char first = element.is_shell && side[0] == 'S' ? '3' : '1';
  const auto k = static_cast<std::size_t>(side[1] - first);  // huge if negative
  const std::size_t corners = element.corner_count;
  if (k >= corners)
    line.fail(fmt::format("side {} of element {} is no edge (allowed: {}{} to {}{})", side, number,
                          side[0], first, side[0],
                          corners + static_cast<std::size_t>(first - '1')));
  return deck_edge(element.nodes[k], element.nodes[(k + 1) % corners]);
}

std::string Deck::shown(long node) const {
  const Eigen::Vector2d x = place(node);
  return fmt::format("node {} at ({:.6g}, {:.6g})", node, x.x(), x.y());
}

std::string Deck::face(const std::string& name, const DeckLine& line) const {
  const auto found = surfaces.find(name);
  if (found == surfaces.end() || std::ranges::none_of(found->second, [&](const auto& edge) {
        return boundary.contains(edge);
      }))
    line.fail(fmt::format("surface {} has no edge of the boundary", name));
  return found->first;
}

Deck read_deck(const std::string& text, const std::filesystem::path& folder) {
  return DeckReader(text, folder).read();
}

std::map<DeckEdge, int> curves_by_names(const Deck& deck) {
  std::map<std::set<std::string>, int> numbers;
  std::map<DeckEdge, int> curve;
  for (const auto& [edge, names] : deck.names)
    curve[edge] = numbers.emplace(names, static_cast<int>(numbers.size()) + 1).first->second;
  return curve;
}

std::string msh_of(const Deck& deck, const std::map<DeckEdge, int>& curve) {
  std::map<std::string, int> groups;
  const auto group_of = [&](const std::string& name) {
    return groups.emplace(name, static_cast<int>(groups.size()) + 1).first->second;
  };
  std::string names, nodes, lines;
  std::size_t count = 0;
  for (const auto& entry : curve) {
    const DeckEdge& edge = entry.first;
    const auto found = deck.names.find(edge);
    const auto add = [&](int group) {
      lines += fmt::format("{} 1 2 {} {} {} {}\n", ++count, group, entry.second, edge[0], edge[1]);
    };
    if (found == deck.names.end())
      add(0);
    else
      for (const std::string& name : found->second) add(group_of("1 " + name));
  }
  constexpr std::array<int, 9> gmsh_types = {0, 0, 0, 2, 3, 0, 9, 0, 16};  // by nodes
  for (const auto& [number, element] : deck.elements) {
    if (!element.is_plane()) continue;
    const int group = group_of("2 " + deck.body.at(number));
    lines +=
        fmt::format("{} {} 2 {} {}", ++count, gmsh_types.at(element.nodes.size()), group, group);
    for (const long node : element.nodes) lines += fmt::format(" {}", node);
    lines += "\n";
  }
  for (const auto& [name, group] : groups)
    names += fmt::format("{} {} \"{}\"\n", name[0], group, name.substr(2));
  for (const auto& [node, p] : deck.nodes)
    nodes += fmt::format("{} {} {} {}\n", node, p[0], p[1], p[2]);
  return fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n{}"
      "$EndPhysicalNames\n$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n",
      groups.size(), names, deck.nodes.size(), nodes, count, lines);
}

}  // namespace airybench
