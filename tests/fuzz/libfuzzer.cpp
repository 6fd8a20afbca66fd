// libFuzzer's entry: AIRYBENCH_FUZZED is the reader's name.
#include <cstddef>
#include <cstdint>

#include "support/errors.hpp"
#include "tests/fuzz/readers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  try {
    airybench::fuzz::AIRYBENCH_FUZZED({reinterpret_cast<const char*>(bytes), size});
  } catch (const airybench::InputError&) {
  }
  return 0;
}
