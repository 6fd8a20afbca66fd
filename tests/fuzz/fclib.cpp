#include "bench/problems/fclib.hpp"

#include "tests/fuzz/given_file.hpp"
#include "tests/fuzz/readers.hpp"

namespace airybench::fuzz {

void fclib(const std::string& text) {
#ifdef AIRYBENCH_FUZZED  // a process for each would be slow, and nothing would be seen of it
  read_fclib_in_this_process(given_file(".hdf5", text));
#else
  read_fclib(given_file(".hdf5", text));
#endif
}

}  // namespace airybench::fuzz
