// Scenes at random, each with two to four things taken to an extreme: a seed gives the same ones
// everywhere.
#pragma once

#include <string>

#include "assembly/problem/pose.hpp"

namespace airybench::testing {

// Number `number` of the sequence that `seed` begins. Its `about` says what was done to it. Some
// cannot be posed: pose() says so.
Scene random_scene(unsigned seed, int number);

// Which ones a test tries: its own, or AIRYBENCH_RANDOM_SCENES=FIRST,COUNT[,MESH].
struct Campaign {
  int first = 0, count = 0;
  std::string mesh = "Mesh0";
  bool is_asked_for = false;
};
Campaign campaign(int own_count);

}  // namespace airybench::testing
