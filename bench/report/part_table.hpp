// What `bench solve` prints: a part's forces, pressure, stress and displacement.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "bench/records/json.hpp"
#include "bench/records/record.hpp"

namespace airybench {

// Lines, and tables as aligned_table() takes them, flush right from the second column on.
using PartReport = std::vector<std::variant<std::string, std::vector<std::vector<std::string>>>>;

// part: NAME.answer.json (part_answer.hpp); null: there is none.
PartReport part_report(const Record& record, const Json& part);
std::string text_of(const PartReport& report);
Json to_json(const PartReport& report);  // texts, and lists of rows

}  // namespace airybench
