#include "bench/problems/siconos_text.hpp"

#include "tests/fuzz/given_file.hpp"
#include "tests/fuzz/readers.hpp"

namespace airybench::fuzz {

void siconos(const std::string& text) { read_siconos_text(given_file(".dat", text)); }

}  // namespace airybench::fuzz
