// The steps of an input deck: supports and loads at the end of each.
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "meshgen/deck.hpp"
#include "meshgen/deck_properties.hpp"

namespace airybench {

using Held = std::array<std::optional<double>, 2>;  // displacements x and y, where they are given

struct StepState {
  std::map<long, Held> held;                // of nodes
  std::map<long, Eigen::Vector2d> force_N;  // of nodes
  struct Pressure {
    std::string name;
    double value_MPa = 0;
  };
  // Of *DLOAD and of *DSLOAD, per edge of the boundary.
  std::array<std::map<DeckEdge, Pressure>, 2> pressures;
  std::map<std::string, Eigen::Vector2d, WithoutCase> gravity;  // mm/s² per element set
  DeckNames sets;                                               // of nodes that are held or loaded
};

// One at least. Loads grow evenly in each step. Throws InputError: line, what is wrong.
std::vector<StepState> read_steps(const Deck& deck);

// Of GRAV, the same in all bodies.
Eigen::Vector2d weight_N_per_mm3(const Deck& deck, const DeckProperties& properties,
                                 const StepState& state);

}  // namespace airybench
