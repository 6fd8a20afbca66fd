#include "bench/records/json_value.hpp"

#include <set>

#include "support/errors.hpp"
#include "support/lists.hpp"
#include "support/shortened.hpp"

namespace airybench {

void JsonValue::object(const std::vector<JsonKey>& keys, const std::string& all) const {
  if (!json.is_object()) fail("a JSON object");
  for (const auto& [name, value] : json.items()) {
    if (std::ranges::find(keys, name, &JsonKey::name) != keys.end()) continue;
    std::vector<std::string> names;
    for (const JsonKey& known : keys) names.push_back(known.name);
    throw FileError(fmt::format("{}: {}{}: unknown key{} (allowed: {})", file_,
                                key_.empty() ? "" : shortened(key_ + ": "), shortened(name),
                                perhaps(name, names), fmt::join(names, ", ")));
  }
  take(keys);
  if (!all.empty() && json.size() < keys.size()) fail(all);
}

JsonValue JsonValue::operator[](const std::string& key) const {
  static const Json missing(Json::value_t::discarded);
  if (!json.is_object()) fail("a JSON object");
  const auto found = json.find(key);
  return at(key, found == json.end() ? missing : *found);
}

void JsonValue::take(const std::vector<JsonKey>& keys) const {
  for (const JsonKey& known : keys)
    if (const JsonValue value = (*this)[known.name];
        known.is_required || !value.json.is_discarded())
      known.take(value);
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

Json written(const std::vector<JsonKey>& keys) {
  Json json = Json::object();
  for (const JsonKey& key : keys)
    if (Json value = key.give(); !value.is_discarded()) json[key.name] = std::move(value);
  return json;
}

Json changes(const std::vector<JsonKey>& keys, const std::vector<JsonKey>& presets) {
  Json json = written(keys);
  const Json preset = written(presets);
  for (const JsonKey& key : keys)
    if (!key.is_required && json.contains(key.name) && preset.contains(key.name) &&
        json[key.name] == preset[key.name])
      json.erase(key.name);
  return json;
}

Json json_of_file(const std::string& name, const std::string& text) {
  constexpr std::size_t max_keys = 1000;
  std::vector<std::set<std::string>> keys;
  const auto refuse = [&](const std::string& what) { throw FileError(name + ": " + what); };
  const auto watch = [&](int depth, Json::parse_event_t event, Json& value) {
    if (depth > 10) refuse("nested more than 10 deep");
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event != Json::parse_event_t::key) return true;
    if (keys.back().size() == max_keys)
      refuse(fmt::format("more than {} keys in one object", max_keys));
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

}  // namespace airybench
