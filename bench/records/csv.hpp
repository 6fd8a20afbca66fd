// Comma-separated values, RFC 4180.
#pragma once

#include <string>
#include <vector>

#include "bench/records/record.hpp"

namespace airybench {

// results.csv: a header and a row per record, of the fields that are columns; empty: does not
// apply.
std::string csv_text(const std::vector<Record>& records);

// A text as a cell, in quotation marks or where it needs them; a spreadsheet takes it for no
// formula.
std::string csv_quoted(const std::string& text);
std::string csv_cell(const std::string& text);

// date,revision,mesh,scene,method,stop,quantity,value: a row per record and number.
std::string series_csv(const std::vector<Record>& records);

}  // namespace airybench
