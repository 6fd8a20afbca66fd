// What an input deck says of its bodies and of contact between them.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "meshgen/deck.hpp"

namespace airybench {

struct DeckMaterial {
  double young_MPa = 0, poisson = 0;
  std::optional<double> density = {};  // t/mm³
};
struct DeckPair {
  std::array<std::string, 2> faces;  // as in Deck::names
  std::optional<double> friction;    // none: tied
};

struct DeckProperties {
  bool is_plane_stress = false;
  double thickness_mm = 1;
  std::map<std::string, DeckMaterial> materials;  // by body
  std::vector<DeckPair> pairs;
  std::vector<std::string> notes;  // what was not used, and what was taken for what
};

// Whether it says more than a mesh.
bool is_analysis(const Deck& deck);

// Throws InputError where a keyword makes the problem another than linear elasticity in the plane
// with supports, loads, contact pairs and friction in static steps: line, what it is.
DeckProperties read_properties(const Deck& deck);

}  // namespace airybench
