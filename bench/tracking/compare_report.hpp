// A comparison of two runs as text, markdown or JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "bench/tracking/compare.hpp"

namespace airybench {

// A table of the times, then what else has changed, a sentence a line.
std::string comparison_text(const Comparison& comparison);
std::string comparison_markdown(const Comparison& comparison);
nlohmann::ordered_json comparison_json(const Comparison& comparison);

}  // namespace airybench
