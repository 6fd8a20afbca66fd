// The JSON of records, nights and exports. Keys keep their order.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace airybench {

using Json = nlohmann::ordered_json;

template <typename T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

// Compiled once, in json.cpp, because parsing and dumping take long to compile.

// Throws Json::exception, also for nesting deeper than 32.
Json parse_json(const std::string& text);
void parse_json(const std::string& text, Json::json_sax_t& sax);
bool is_utf8(std::string_view text);
// One line. Replaces invalid UTF-8, which file names may contain.
std::string json_text(const Json& json);
std::string indented_json_text(const Json& json, int indent);

// Removes "[json.exception.parse_error.101] " from what().
std::string without_prefix(const Json::exception& wrong);

}  // namespace airybench
