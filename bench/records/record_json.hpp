// Records back from JSON: what to_json() (record.hpp) wrote, from another process or from a file.
#pragma once

#include <nlohmann/json.hpp>

#include "bench/records/record.hpp"

namespace airybench {

// to_json() of the result is the JSON again. Keys that are missing keep their defaults. Throws
// nlohmann::json::exception for a value of the wrong type.
Record record_from_json(const nlohmann::ordered_json& json);

nlohmann::ordered_json to_json(const TimedRun& run);
TimedRun timed_run_from_json(const nlohmann::ordered_json& json);

}  // namespace airybench
