// An external program as a method of the harness. A program that reads the Airy system or the body
// solves the whole problem; one that reads the condensed problem replaces the contact law of
// HYBRID. The harness writes the files, reads the answer (answer.hpp) and computes the stresses
// from φ or u. Times are the program's own clock for its work and ours for the rest;
// Solution::program has our time and memory of the program as a whole; without an answer it is
// there where the status is the program's own word.
#pragma once

#include <cstdint>
#include <optional>

#include "bench/external/declaration.hpp"
#include "solvers/base/method.hpp"

namespace airybench {

// Its name is "EXTERNAL:name". memory_limit_bytes: of all its processes together.
Method external_method(const Declaration& declaration,
                       std::optional<std::int64_t> memory_limit_bytes);

}  // namespace airybench
