#include "bench/records/json_value.hpp"

#include <set>

#include "support/errors.hpp"
#include "support/shortened.hpp"

namespace airybench {

void JsonValue::object(const std::vector<JsonKey>& keys, const std::string& all) const {
  if (!json.is_object()) fail("a JSON object");
  for (const auto& [name, value] : json.items()) {
    if (std::ranges::find(keys, name, &JsonKey::name) != keys.end()) continue;
    std::vector<std::string_view> names;
    for (const JsonKey& known : keys) names.emplace_back(known.name);
    throw FileError(fmt::format("{}: {}{}: unknown key (allowed: {})", file_,
                                key_.empty() ? "" : shortened(key_ + ": "), shortened(name),
                                fmt::join(names, ", ")));
  }
  object_with_other_keys(keys);
  if (!all.empty() && json.size() < keys.size()) fail(all);
}

void JsonValue::object_with_other_keys(const std::vector<JsonKey>& keys) const {
  if (!json.is_object()) fail("a JSON object");
  for (const JsonKey& known : keys)
    if (const auto found = json.find(known.name); found != json.end())
      known.take(at(known.name, *found));
    else if (known.is_required)
      known.take(at(known.name, Json(Json::value_t::discarded)));
}

void JsonValue::each(const std::string& allowed,
                     const std::function<void(const std::string&, const JsonValue&)>& take) const {
  if (!json.is_object()) fail(allowed);
  for (const auto& [name, value] : json.items()) take(name, at(name, value));
}

void JsonValue::refuse(const Json& value, const std::string& allowed) const {
  throw FileError(fmt::format("{}: {}: {} (allowed: {})", file_, key_.empty() ? "the file" : key_,
                              value.is_discarded() ? "is missing" : shortened(json_text(value)),
                              allowed));
}

Json json_of_file(const std::string& name, const std::string& text) {
  constexpr std::size_t most_keys = 1000;
  std::vector<std::set<std::string>> keys;
  const auto refuse = [&](const std::string& what) { throw FileError(name + ": " + what); };
  const auto watch = [&](int depth, Json::parse_event_t event, Json& value) {
    if (depth > 8) refuse("nested more than 8 deep");
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event != Json::parse_event_t::key) return true;
    if (keys.back().size() == most_keys)
      refuse(fmt::format("more than {} keys in one object", most_keys));
    if (const auto key = value.get<std::string>(); !keys.back().insert(key).second)
      refuse(shortened(key) + ": given twice");
    return true;
  };
  if (text.find('\0') != text.npos) refuse("not JSON: a zero byte");  // the parser would stop there
  try {
    return Json::parse(text, watch);
  } catch (const Json::exception& wrong) {
    throw FileError(name + ": not JSON: " + without_prefix(wrong));
  }
}

void read(const JsonValue& value, double& number) {
  if (!value.json.is_number()) value.fail("a number");
  number = value.json.get<double>();
}

void read(const JsonValue& value, bool& flag) {
  if (!value.json.is_boolean()) value.fail("true, false");
  flag = value.json.get<bool>();
}

void read(const JsonValue& value, std::string& text) {
  if (!value.json.is_string()) value.fail("a text");
  text = value.json.get<std::string>();
}

}  // namespace airybench
