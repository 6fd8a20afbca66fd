#include "meshgen/abaqus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <vector>

#include "support/errors.hpp"
#include "support/numbers.hpp"

namespace airybench {
namespace {

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) {
    const std::size_t first = field.find_first_not_of(" \t\r\""),
                      last = field.find_last_not_of(" \t\r\"");
    fields.push_back(first == field.npos ? "" : field.substr(first, last - first + 1));
  }
  return fields;
}

// Abaqus and CalculiX do not tell capitals in names apart.
struct WithoutCase {
  bool operator()(const std::string& a, const std::string& b) const { return upper(a) < upper(b); }
};
using Names = std::set<std::string, WithoutCase>;

using Numbers = std::vector<long>;
using Sets = std::map<std::string, Numbers, WithoutCase>;
using Edge = std::array<long, 2>;
Edge edge_of(long a, long b) { return {std::min(a, b), std::max(a, b)}; }

// Of an element type: how many nodes, how many of them are corners (2: a line).
struct Shape {
  std::size_t nodes, corners;
  bool is_shell = false;  // its sides S1 and S2 are its faces
};

struct Element {
  Shape shape;
  Numbers nodes;

  bool is_plane() const { return shape.corners > 2; }
};

std::optional<Shape> shape_of(const std::string& type) {
  if (type.starts_with("STRI65")) return Shape{6, 3, true};
  for (const char* solid : {"C3D", "SC"})
    if (type.starts_with(solid)) return {};
  const bool is_line = type.starts_with("T2D") || type.starts_with("T3D") ||
                       type.starts_with("R2D") || type.starts_with("B2") || type.starts_with("B3");
  std::size_t at = type.starts_with("B") ? 1 : 0;
  for (const char* prefix :
       {"T2D", "T3D", "R2D", "R3D", "M3D", "SFM3D", "CPS", "CPE", "CAX", "STRI", "S"})
    if (at == 0 && type.starts_with(prefix)) at = std::string_view(prefix).size();
  if (type.starts_with("B")) at = 2;  // B21: a beam in the plane with two nodes, B22 with three
  const char digit = at < type.size() ? type[at] : '0';
  const auto count = static_cast<std::size_t>(std::max(0, digit - '0'));
  if (is_line) return Shape{type.starts_with("B") ? count + 1 : count, 2};
  if (at == 0 || (count != 3 && count != 4 && count != 6 && count != 8)) return {};
  const bool is_shell = !type.starts_with("C");
  return Shape{count, count % 3 == 0 ? 3U : 4U, is_shell};
}

class AbaqusReader {
 public:
  explicit AbaqusReader(const std::string& text) : in_(text) {}

  std::string msh() {
    while (std::getline(in_, line_)) {
      ++number_;
      if (line_.starts_with("**") || line_.find_first_not_of(" \t\r") == line_.npos) continue;
      if (line_.starts_with("*"))
        begin_keyword();
      else
        take(fields_of(line_));
    }
    if (elements_.empty()) fail("it has no elements");
    return written();
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("line {}: {}", number_, what));
  }
  long whole(const std::string& text) const {
    const auto number = parse_whole(text);
    if (!number) fail(fmt::format("'{}' (allowed: a whole number)", text));
    return static_cast<long>(*number);
  }
  std::string parameter(const std::string& name) const {
    const auto found = parameters_.find(name);
    return found == parameters_.end() ? "" : found->second;
  }

  void begin_keyword() {
    std::vector<std::string> fields = fields_of(line_.substr(1));
    keyword_ = upper(fields[0]);
    parameters_.clear();
    pending_.clear();
    for (std::size_t k = 1; k < fields.size(); ++k) {
      const std::size_t equals = std::min(fields[k].find('='), fields[k].size());
      const auto name = fields_of(fields[k].substr(0, equals));
      const auto value = fields_of(fields[k].substr(std::min(equals + 1, fields[k].size())));
      if (!name.empty()) parameters_[upper(name[0])] = value.empty() ? "" : value[0];
    }
    refuse_what_moves_or_adds();
    has_instance_ |= keyword_ == "INSTANCE";
    if (keyword_ == "SOLID SECTION" || keyword_ == "SHELL SECTION")
      sections_.push_back(parameter("ELSET"));
    if (keyword_ != "ELEMENT") return;
    const std::string type = upper(parameter("TYPE"));
    const std::optional<Shape> shape = shape_of(type);
    if (!shape)
      fail(
          fmt::format("elements of type {} (allowed: of a plane body, as CPE3, CPS4, CPE6, S8, and "
                      "lines, as T2D2)",
                      type));
    shape_ = *shape;
  }

  // Read without these, the body would be another.
  void refuse_what_moves_or_adds() const {
    const bool adds = keyword_ == "NODE" || keyword_ == "ELEMENT";
    if (keyword_ == "INCLUDE" || (adds && parameters_.contains("INPUT")))
      fail(fmt::format("*{} of another file (allowed: one file)", keyword_));
    for (const char* made : {"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY"})
      if (keyword_ == made)
        fail(fmt::format("*{} (allowed: each node and element is written)", keyword_));
    const std::string system = upper(parameter("SYSTEM"));
    if (keyword_ == "SYSTEM" || (keyword_ == "NODE" && !system.empty() && system != "R"))
      fail("coordinates of a system of their own (allowed: x and y of the model)");
    if (keyword_ == "INSTANCE" && has_instance_)
      fail(
          "a second *INSTANCE (allowed: one; Abaqus writes files without parts and assemblies "
          "too)");
  }

  void take(std::vector<std::string> fields) {
    if (keyword_ == "NODE") {
      if (fields.size() < 3) fail("a node has a number, x and y");
      std::array<double, 3> place = {};
      for (std::size_t k = 0; k < 3 && k + 1 < fields.size(); ++k) {
        const auto number = fields[k + 1].empty() ? std::optional(0.) : parse_number(fields[k + 1]);
        if (!number) fail(fmt::format("'{}' (allowed: a number)", fields[k + 1]));
        place[k] = *number;
      }
      const long node = whole(fields[0]);
      if (!nodes_.emplace(node, place).second) fail(fmt::format("node {} is given twice", node));
      if (!parameter("NSET").empty()) node_sets_[parameter("NSET")].push_back(node);
    } else if (keyword_ == "ELEMENT") {
      for (const std::string& field : fields)
        if (!field.empty()) pending_.push_back(whole(field));
      if (pending_.size() < shape_.nodes + 1) return;  // goes on in the next line
      const long number = pending_[0];
      for (std::size_t k = 1; k < pending_.size(); ++k)
        if (!nodes_.contains(pending_[k])) fail(fmt::format("node {} does not exist", pending_[k]));
      const bool is_new =
          elements_.emplace(number, Element{shape_, {pending_.begin() + 1, pending_.end()}}).second;
      if (!is_new) fail(fmt::format("element {} is given twice", number));
      if (shape_.corners == 2 && pending_.size() == 4)  // its middle comes second
        std::swap(elements_[number].nodes[1], elements_[number].nodes[2]);
      of_element_keyword_[number] = parameter("ELSET");
      if (!parameter("ELSET").empty()) element_sets_[parameter("ELSET")].push_back(number);
      pending_.clear();
    } else if (keyword_ == "ELSET" || keyword_ == "NSET") {
      auto& sets = keyword_ == "ELSET" ? element_sets_ : node_sets_;
      if (keyword_ == "ELSET") given_sets_.insert(parameter("ELSET"));
      add(fields, sets, sets[parameter(keyword_)]);
    } else if (keyword_ == "SURFACE") {
      add_to_surface(fields);
    } else if (keyword_ == "INSTANCE") {
      for (const std::string& field : fields)
        if (!field.empty() && parse_number(field) != 0)
          fail("*INSTANCE is moved (allowed: it lies where its *PART does)");
    }
  }

  void add_to_surface(const std::vector<std::string>& fields) {
    if (upper(parameter("TYPE")) == "NODE")
      return add({fields[0]}, node_sets_, node_sets_[parameter("NAME")]);
    const std::string side = fields.size() > 1 ? upper(fields[1]) : "";
    if (side.empty()) fail("a surface without a side (allowed: as 'Eleft, S1')");
    Numbers of;
    add({fields[0]}, element_sets_, of);
    for (const long element : of) add_side(element, side);
  }

  void add(const std::vector<std::string>& fields, const Sets& sets, Numbers& to) {
    if (parameters_.contains("GENERATE") && keyword_ != "SURFACE") {
      if (fields.size() < 2) fail("GENERATE needs a first and a last number");
      const long first = whole(fields[0]), last = whole(fields[1]),
                 step = fields.size() > 2 && !fields[2].empty() ? whole(fields[2]) : 1;
      constexpr long most = 100'000'000;
      if (step < 1 || last - first > most) fail("GENERATE: allowed: a step of 1 or more");
      for (long k = first; k <= last; k += step) to.push_back(k);
      return;
    }
    for (const std::string& field : fields) {
      if (field.empty()) continue;
      if (const auto set = sets.find(field); set != sets.end()) {
        const Numbers copy = set->second;
        to.insert(to.end(), copy.begin(), copy.end());
      } else {
        to.push_back(whole(field));
      }
    }
  }

  void add_side(long number, const std::string& side) {
    const auto found = elements_.find(number);
    const bool is_edge = side.size() == 2 && (side[0] == 'S' || side[0] == 'E');
    if (found == elements_.end() || !is_edge)
      fail(fmt::format("side {} of element {} does not exist", side, number));
    const auto& [shape, n] = found->second;
    const char first = shape.is_shell && side[0] == 'S' ? '3' : '1';
    const auto k = static_cast<std::size_t>(side[1] - first);  // huge if negative
    if (k >= shape.corners)
      fail(fmt::format("side {} of element {} is no edge (allowed: {}{} to {}{})", side, number,
                       side[0], first, side[0], shape.corners + (first - '1')));
    names_of_edge_[edge_of(n[k], n[(k + 1) % shape.corners])].insert(parameter("NAME"));
  }

  // Each plane element's body.
  std::map<long, std::string> bodies() const {
    const auto share_out = [&](const Names& sets) {
      std::map<long, std::string> body;
      for (const std::string& set : sets)
        if (const auto found = element_sets_.find(set); found != element_sets_.end())
          for (const long element : found->second)
            if (const auto it = elements_.find(element); it != elements_.end() &&
                                                         it->second.is_plane() &&
                                                         !body.emplace(element, set).second)
              return std::map<long, std::string>();
      for (const auto& [number, element] : elements_)
        if (element.is_plane() && !body.contains(number)) return std::map<long, std::string>();
      return body;
    };
    std::map<long, std::string> body = share_out({sections_.begin(), sections_.end()});
    if (body.empty()) body = share_out(given_sets_);
    if (!body.empty()) return body;
    for (const auto& [number, set] : of_element_keyword_) body[number] = set.empty() ? "body" : set;
    return body;
  }

  void name_edges_by_sets() {
    for (const auto& [name, numbers] : element_sets_)
      for (const long number : numbers)
        if (const auto found = elements_.find(number);
            found != elements_.end() && !found->second.is_plane())
          names_of_edge_[edge_of(found->second.nodes[0], found->second.nodes[1])].insert(name);
    std::map<Edge, int> triangles;
    for (const auto& [number, element] : elements_)
      for (std::size_t k = 0; element.is_plane() && k < element.shape.corners; ++k)
        ++triangles[edge_of(element.nodes[k], element.nodes[(k + 1) % element.shape.corners])];
    for (const auto& [name, numbers] : node_sets_) {
      const std::set<long> set(numbers.begin(), numbers.end());
      for (const auto& [edge, count] : triangles)
        if (count == 1 && set.contains(edge[0]) && set.contains(edge[1]))
          names_of_edge_[edge].insert(name);
    }
  }

  std::string written() {
    name_edges_by_sets();
    std::map<std::string, int> groups;
    const auto group_of = [&](const std::string& name) {
      return groups.emplace(name, static_cast<int>(groups.size()) + 1).first->second;
    };
    std::string names, nodes, lines;
    std::size_t count = 0;
    // Edges of the same names are one curve.
    std::map<std::set<std::string>, int> curves;
    for (const auto& [edge, of_edge] : names_of_edge_) {
      const int curve = curves.emplace(of_edge, static_cast<int>(curves.size()) + 1).first->second;
      for (const std::string& name : of_edge)
        lines += fmt::format("{} 1 2 {} {} {} {}\n", ++count, group_of("1 " + name), curve, edge[0],
                             edge[1]);
    }
    constexpr std::array<int, 9> gmsh_types = {0, 0, 0, 2, 3, 0, 9, 0, 16};  // by nodes
    const std::map<long, std::string> body = bodies();
    for (const auto& [number, element] : elements_) {
      if (!element.is_plane()) continue;
      const int group = group_of("2 " + body.at(number));
      lines +=
          fmt::format("{} {} 2 {} {}", ++count, gmsh_types.at(element.nodes.size()), group, group);
      for (const long node : element.nodes) lines += fmt::format(" {}", node);
      lines += "\n";
    }
    for (const auto& [name, group] : groups)
      names += fmt::format("{} {} \"{}\"\n", name[0], group, name.substr(2));
    for (const auto& [node, p] : nodes_)
      nodes += fmt::format("{} {} {} {}\n", node, p[0], p[1], p[2]);
    return fmt::format(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n{}"
        "$EndPhysicalNames\n$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n",
        groups.size(), names, nodes_.size(), nodes, count, lines);
  }

  std::istringstream in_;
  std::string line_, keyword_;
  int number_ = 0;
  std::map<std::string, std::string> parameters_;  // of the keyword
  Numbers pending_;                                // of an element over several lines
  Shape shape_ = {0, 0};
  std::map<long, std::array<double, 3>> nodes_;
  std::map<long, Element> elements_;
  std::map<long, std::string> of_element_keyword_;
  Sets element_sets_, node_sets_;
  Names given_sets_;  // of *ELSET
  bool has_instance_ = false;
  std::vector<std::string> sections_;
  std::map<Edge, std::set<std::string>> names_of_edge_;
};

}  // namespace

std::string msh_of_abaqus(const std::string& text) { return AbaqusReader(text).msh(); }

}  // namespace airybench
