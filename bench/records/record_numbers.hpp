// The parts of a record that the formats of other tools use.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/records/record.hpp"
#include "bench/records/robust.hpp"

namespace airybench {

std::vector<std::pair<std::string, double>> numbers_of(const Record& record);

// The stored interval of time_s, else median ± median absolute deviation; zeros without a time.
Interval time_interval(const Record& record);

std::string variant_of(const Record& record);  // "ALM/stop=paper"

}  // namespace airybench
