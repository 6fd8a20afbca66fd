#include "bench/records/json.hpp"

namespace airybench {

Json parse_json(const std::string& text) { return Json::parse(text); }

std::string json_text(const Json& json) { return indented_json_text(json, -1); }

std::string indented_json_text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string without_prefix(const Json::exception& wrong) {
  const std::string what = wrong.what();
  return what.substr(what.find("] ") + 2);
}

}  // namespace airybench
