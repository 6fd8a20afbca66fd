// What the formats of other tools take of a record.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/records/record.hpp"
#include "bench/records/robust.hpp"

namespace airybench {

// Every field that is a number, in the order of record_fields.def.
std::vector<std::pair<std::string, double>> numbers_of(const Record& record);

// Of time_s: the stored interval, else median ± median absolute deviation; zeros without a time.
Interval time_interval(const Record& record);

// The method with what tells its cases apart: "ALM/stop=paper".
std::string variant_of(const Record& record);

}  // namespace airybench
