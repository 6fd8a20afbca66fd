// Records in the formats of build servers and other trackers.
#pragma once

#include <string>
#include <vector>

#include "bench/records/record.hpp"

namespace airybench {

// JUnit XML for build servers: a testsuite per mesh and scene with the context as properties, a
// testcase per method. ok passes; crashed, machine_fault, timeout and out_of_memory are errors;
// skipped and unstressed are skipped; any other status is a failure with its reason. `time` is the
// median of one solve, s.
std::string junit_xml(const std::vector<Record>& cases);

// github-action-benchmark, tool customSmallerIsBetter: a list of {name, unit, value, range, extra}
// with time (ms), peak heap (B) and the errors of stress and force of each case that has them.
std::string github_action_json(const std::vector<Record>& cases);

// Bencher Metric Format, bencher.dev/bmf.json: case → measure → {value, lower_value, upper_value};
// latency in ns, peak-heap in B, error-stress and error-force relative. Omits cases without any.
std::string bencher_json(const std::vector<Record>& cases);

}  // namespace airybench
