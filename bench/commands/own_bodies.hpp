// What a run on a body of one's own ends with.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/records/record.hpp"

namespace airybench {

// One line that names the picture to open, of the last mesh that is not of the catalogue, or says
// how to get one; empty: all are of the catalogue. out: the results folder; has_fields: the run has
// written fields there.
std::string picture_line(const std::vector<Record>& records, const std::filesystem::path& out,
                         bool has_fields);

}  // namespace airybench
