// Comma-separated values, RFC 4180.
#pragma once

#include <string>
#include <vector>

#include "bench/records/record.hpp"

namespace airybench {

// results.csv: a header and a row per record; a cell is empty if the field does not apply.
std::string csv_header();
std::string csv_row(const Record& record);

// A cell in quotation marks, always or if necessary; no spreadsheet evaluates it as a formula.
std::string csv_quoted(const std::string& text);
std::string csv_cell(const std::string& text);

std::string series_csv(const std::vector<Record>& records);  // a row per record and number

}  // namespace airybench
