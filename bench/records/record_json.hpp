// Records back from JSON: what to_json() (record.hpp) wrote, from another process or from a file.
#pragma once

#include "bench/records/json.hpp"
#include "bench/records/record.hpp"

namespace airybench {

// to_json() of the result is the JSON again. Keys that are missing keep their defaults. Throws
// Json::exception for a value of the wrong type.
Record record_from_json(const Json& json);

Json to_json(const TimedRun& run);
TimedRun timed_run_from_json(const Json& json);

}  // namespace airybench
