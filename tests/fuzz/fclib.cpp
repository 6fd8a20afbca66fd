#include "bench/problems/fclib.hpp"

#include "tests/fuzz/given_file.hpp"
#include "tests/fuzz/readers.hpp"

namespace airybench::fuzz {

void fclib(const std::string& text) { read_fclib(given_file(".hdf5", text)); }

}  // namespace airybench::fuzz
