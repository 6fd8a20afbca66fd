// The JSON of records, nights and exports: keys stay in the order in which they were written.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace airybench {

using Json = nlohmann::ordered_json;

// Here and not in every file, because parsing and dumping take long to compile.

// Throws Json::exception, also where arrays and objects are nested more than 32 deep.
Json parse_json(const std::string& text);
// Hands each value to sax instead of keeping all.
void parse_json(const std::string& text, Json::json_sax_t& sax);
bool is_utf8(std::string_view text);
// On one line; invalid UTF-8, as in a file's name, is replaced.
std::string json_text(const Json& json);
std::string indented_json_text(const Json& json, int indent);

// "parse error at line 1, column 2: …" of "[json.exception.parse_error.101] parse error at …".
std::string without_prefix(const Json::exception& wrong);

}  // namespace airybench
