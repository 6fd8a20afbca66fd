// What an input deck prescribes, as a scene (docs/scenes.md): linear elasticity in the plane,
// sections, supports, loads, contact pairs with friction, static steps.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "meshgen/deck.hpp"

namespace airybench {

struct DeckScene {
  std::string json;
  // Edges of one curve have the same names and conditions; the scene gives roles to the numbers.
  std::map<DeckEdge, int> curve;
  std::vector<std::string> notes;  // what was not used, and what was taken for what
};

// None: the deck is a mesh only. Lengths are taken as mm, stresses as MPa. Throws InputError where
// the answer would be that of another problem: line, what it is.
std::optional<DeckScene> scene_of(const Deck& deck);

// The curves of the deck's scene where it has one, else those of its names.
std::map<DeckEdge, int> curves_of(const Deck& deck);

}  // namespace airybench
