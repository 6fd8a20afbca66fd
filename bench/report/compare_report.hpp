// A comparison of two runs as text, markdown or JSON.
#pragma once

#include <string>
#include <vector>

#include "bench/records/json.hpp"
#include "bench/report/compare.hpp"

namespace airybench {

// A table of the times, then what else has changed, a sentence a line.
std::string comparison_text(const Comparison& comparison);
std::string comparison_markdown(const Comparison& comparison);
Json comparison_json(const Comparison& comparison);

}  // namespace airybench
