// Scenes at random, each with two to four things taken to an extreme: a seed gives the same ones
// everywhere.
#pragma once

#include "assembly/scene.hpp"

namespace airybench::testing {

// Number `number` of the sequence that `seed` begins. Its `about` says what was done to it. Some
// cannot be posed: pose() says so.
Scene random_scene(unsigned seed, int number);

}  // namespace airybench::testing
