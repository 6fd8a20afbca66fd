#include "tests/fuzz/readers.hpp"

namespace airybench::fuzz {

std::vector<Reader> readers() { return {{"deck", deck}, {"model", model}}; }

}  // namespace airybench::fuzz
