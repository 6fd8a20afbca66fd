// Plane bodies of Abaqus' and CalculiX' input decks: nodes, elements, sets and surfaces.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "meshgen/deck_blocks.hpp"

namespace airybench {

// Abaqus and CalculiX do not tell capitals in names apart.
struct WithoutCase {
  bool operator()(const std::string& a, const std::string& b) const {
    return in_capitals(a) < in_capitals(b);
  }
};
using DeckNames = std::set<std::string, WithoutCase>;

struct DeckElement {
  enum class Kind { plane_strain, plane_stress, line };
  std::string type;
  Kind kind;
  std::size_t node_count, corner_count;
  bool is_shell;            // its sides S1 and S2 are its faces
  std::vector<long> nodes;  // corners first

  bool is_plane() const { return kind != Kind::line; }
};

using DeckEdge = std::array<long, 2>;  // nodes in ascending order
inline DeckEdge deck_edge(long a, long b) { return {std::min(a, b), std::max(a, b)}; }

// Nodes and elements of one instance among several have numbers, and its sets names, of their own:
// a million and 5, "bolt-1.head".
struct Deck {
  using Sets = std::map<std::string, std::vector<long>, WithoutCase>;
  DeckFile file;
  std::map<long, Eigen::Vector3d> nodes;
  std::map<long, DeckElement> elements;
  Sets node_sets, element_sets;
  std::map<std::string, std::set<DeckEdge>, WithoutCase> surfaces;
  std::map<DeckEdge, std::set<std::string>> names;  // of node sets, sets of lines and surfaces
  std::map<DeckEdge, long> boundary;                // edges of one plane element, and that
  std::map<long, std::string> body;                 // of plane elements

  // A set's members, or the one of that number; block: where it is written.
  std::vector<long> members(const Sets& sets, const std::string& name, const DeckBlock& block,
                            const DeckLine& line) const;
  // The edge of an element's side "S2", "P2" or "E2".
  DeckEdge side(long element, const std::string& side, const DeckLine& line) const;
  std::string full_name(const std::string& name, const DeckBlock& block) const;
  long full_number(const std::string& number, const DeckBlock& block, const DeckLine& line) const;

  Eigen::Vector2d place(long node) const { return nodes.at(node).head<2>(); }
  std::string shown(long node) const;  // "node 5 at (0, 1)"
  // A surface, of whose edges some are on the boundary, as it was first written.
  std::string face(const std::string& name, const DeckLine& line) const;

  DeckNames shadowed;      // of the only instance and of the whole model: there "bolt-1.Set-1"
  long instance_step = 0;  // between numbers of instances; 0: there is one at most
};

// A body is the set of a *SOLID SECTION or *SHELL SECTION; without one the sets of *ELSET that
// share out the elements, or of *ELEMENT. Throws InputError: line, what is wrong.
Deck read_deck(const std::string& text, const std::filesystem::path& folder);

// The plane mesh as MSH 2.2. Edges of a node set, an element set of lines or a *SURFACE are a
// physical curve of its name; curve: numbers of their curves.
std::string msh_of(const Deck& deck, const std::map<DeckEdge, int>& curve);
// Edges of the same names are one curve.
std::map<DeckEdge, int> curves_by_names(const Deck& deck);

}  // namespace airybench
