// The JSON of records, nights and exports: keys stay in the order in which they were written.
#pragma once

#include <nlohmann/json.hpp>

namespace airybench {

using Json = nlohmann::ordered_json;

}  // namespace airybench
