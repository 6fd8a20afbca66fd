// Records as JUnit XML, which build servers show as test results.
#pragma once

#include <string>
#include <vector>

#include "bench/records/record.hpp"

namespace airybench {

// A testsuite per mesh and scene with the context as properties, a testcase per method: ok passes;
// crashed, machine_fault, timeout and out_of_memory are errors, skipped is skipped, every other
// status is a failure with its reason. `time` is the median of one solve in s.
std::string junit_xml(const std::vector<Record>& cases);

}  // namespace airybench
