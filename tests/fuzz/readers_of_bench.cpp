#include "tests/fuzz/readers.hpp"

namespace airybench::fuzz {

std::vector<Reader> readers() {
  return {{"mesh", mesh},   {"scene", scene},     {"record", record},
          {"night", night}, {"siconos", siconos},
#ifdef AIRYBENCH_HAS_HDF5
          {"fclib", fclib}
#endif
  };
}

}  // namespace airybench::fuzz
