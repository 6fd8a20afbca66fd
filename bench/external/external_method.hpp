// Another's program as a method of the harness.
//
// What reads the Airy system or the body solves all of it; what reads the condensed problem is the
// contact law of HYBRID, which makes D and G and recovers the stresses. The harness hands over
// files, takes the answer (answer.hpp) and makes of φ or u the stresses itself. Time is the
// program's own clock for what it does, ours for what we do; Solution::program has ours for the
// program as a whole, and its memory.
#pragma once

#include <cstdint>
#include <optional>

#include "bench/external/declaration.hpp"
#include "solvers/base/method.hpp"

namespace airybench {

// "EXTERNAL:name". memory_limit_bytes: of its processes together.
Method external_method(const Declaration& declaration,
                       std::optional<std::int64_t> memory_limit_bytes);

}  // namespace airybench
