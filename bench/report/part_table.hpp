// What `bench solve` prints: a part's forces, pressure, stress and displacement.
#pragma once

#include <string>

#include "bench/records/json.hpp"
#include "bench/records/record.hpp"

namespace airybench {

// part: NAME.answer.json (part_answer.hpp); null: there is none.
std::string part_table(const Record& record, const Json& part);

}  // namespace airybench
