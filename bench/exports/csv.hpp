// Comma-separated values, RFC 4180.
#pragma once

#include <string>
#include <vector>

#include "bench/records/record.hpp"

namespace airybench {

// results.csv: a header and a row per record, of the fields that are columns; empty: does not
// apply.
std::string csv_text(const std::vector<Record>& records);

// date,revision,mesh,scene,method,stop,quantity,value: a row per record and number.
std::string series_csv(const std::vector<Record>& records);

}  // namespace airybench
