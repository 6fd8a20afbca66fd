#include "meshgen/deck_scene.hpp"
#include "tests/fuzz/readers.hpp"

namespace airybench::fuzz {

void deck(const std::string& text) {
  const Deck deck = read_deck(text, "/nowhere");
  msh_of(deck, curves_by_names(deck));
  scene_of(deck);
}

}  // namespace airybench::fuzz
