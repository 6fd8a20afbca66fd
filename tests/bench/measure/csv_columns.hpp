// The columns of a table of ours, as texts and as numbers.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "support/lists.hpp"
#include "tests/support/test_folder.hpp"

namespace airybench::testing {

using Columns = std::map<std::string, std::vector<std::string>>;

inline Columns csv_columns(const std::string& csv) {
  const std::vector<std::string> lines = lines_of(csv), names = split_list(lines.at(0));
  Columns columns;
  for (const std::string& name : names) columns[name] = {};
  for (std::size_t row = 1; row < lines.size(); ++row) {
    const std::vector<std::string> cells = split_list(lines[row]);
    for (std::size_t k = 0; k < names.size(); ++k) columns[names[k]].push_back(cells.at(k));
  }
  return columns;
}

inline std::vector<double> numbers(const Columns& columns, const std::string& name) {
  std::vector<double> values;
  for (const std::string& cell : columns.at(name)) values.push_back(std::stod(cell));
  return values;
}

}  // namespace airybench::testing
