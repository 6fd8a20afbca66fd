// Reads the keys of a JSON file, and writes them. A value that does not fit throws FileError, one
// line: file, key, value, allowed values.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <concepts>
#include <functional>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "bench/records/json.hpp"

namespace airybench {

class JsonValue;

struct JsonKey {
  std::string name;
  std::function<void(const JsonValue&)> take;
  bool is_required = false;         // a missing value is passed to take, which must fail
  std::function<Json()> give = {};  // what take() would take; discarded: nothing is set
};

class JsonValue {
 public:
  // key: "boundary: force: pressure_MPa"; empty for the whole file.
  JsonValue(std::string file, std::string key, const Json& value)
      : json(value), file_(std::move(file)), key_(std::move(key)) {}

  const Json& json;  // discarded if the key is missing

  JsonValue at(const std::string& key, const Json& value) const {
    return {file_, key_.empty() ? key : key_ + ": " + key, value};
  }
  JsonValue item(std::size_t k) const { return {file_, key_, json[k]}; }
  JsonValue operator[](const std::string& key) const;

  // Calls the takers of the keys that are present, in the order of `keys`.
  void take(const std::vector<JsonKey>& keys) const;
  // The same, and refuses other keys. If `all` is not empty, every key is required, and `all` names
  // the allowed values.
  void object(const std::vector<JsonKey>& keys, const std::string& all = "") const;
  void each(const std::string& allowed,
            const std::function<void(const std::string&, const JsonValue&)>& take) const;

  template <typename T>
  T as(const std::string& allowed) const {
    try {
      return json.get<T>();
    } catch (const Json::exception&) {
      fail(allowed);
    }
  }
  // The item that this value names.
  template <typename Items, typename Name = std::identity>
  const auto& one_of(const Items& items, Name name = {}, const std::string& condition = "") const {
    const auto found = std::ranges::find_if(
        items, [&](const auto& item) { return json == std::invoke(name, item); });
    if (found != std::ranges::end(items)) return *found;
    std::vector<std::string_view> names;
    for (const auto& item : items) names.emplace_back(std::invoke(name, item));
    fail(fmt::format("{}{}", fmt::join(names, ", "), condition));
  }
  [[noreturn]] void fail(const std::string& allowed) const { refuse(json, allowed); }
  [[noreturn]] void refuse(const Json& value, const std::string& allowed) const;

 private:
  std::string file_, key_;
};

// Throws FileError, also for a key that is given twice.
Json json_of_file(const std::string& name, const std::string& text);

inline void read(const JsonValue& value, double& number) { number = value.as<double>("a number"); }
inline void read(const JsonValue& value, bool& flag) { flag = value.as<bool>("true, false"); }
inline void read(const JsonValue& value, std::string& text) {
  text = value.as<std::string>("a text");
}
template <typename T>
void read(const JsonValue& value, std::optional<T>& target) {
  read(value, target.emplace());
}
template <typename T>
void read(const JsonValue& value, std::array<T, 2>& pair) {
  if (!value.json.is_array() || value.json.size() != 2) value.fail("a list of two");
  for (std::size_t k = 0; k < 2; ++k) read(value.item(k), pair[k]);
}

// The counterparts of read(). A class of this namespace, so that the overloads for types of other
// namespaces are found.
struct JsonSlot {
  Json json = Json(Json::value_t::discarded);  // nothing to write
};
template <typename T>
requires std::is_arithmetic_v<T> || std::same_as<T, std::string>
void put(JsonSlot& slot, const T& value) { slot.json = value; }
template <typename T>
void put(JsonSlot& slot, const std::optional<T>& value) {
  if (value) put(slot, *value);
}
template <typename Items>
Json json_list(const Items& items) {
  Json list = Json::array();
  for (const auto& item : items) {
    JsonSlot slot;
    put(slot, item);
    list.push_back(std::move(slot.json));
  }
  return list;
}
template <typename T>
void put(JsonSlot& slot, const std::array<T, 2>& pair) {
  slot.json = json_list(pair);
}
template <typename T>
Json written(const T& value) {
  JsonSlot slot;
  put(slot, value);
  return std::move(slot.json);
}
// An object of the keys that are set.
Json written(const std::vector<JsonKey>& keys);
// Only of those whose values are not the presets', and of required ones. presets: the same keys.
Json changes(const std::vector<JsonKey>& keys, const std::vector<JsonKey>& presets);

// Each keeps a reference to its target.
template <typename T>
JsonKey key(const char* name, T& target) {
  return {.name = name,
          .take = [&target](const JsonValue& value) { read(value, target); },
          .give = [&target] { return written(target); }};
}
inline JsonKey required(JsonKey key) {
  key.is_required = true;
  return key;
}
template <typename T>
JsonKey positive(const char* name, T& target) {
  const auto take = [&target](const JsonValue& value) {
    if (!value.json.is_number() || !(value.json > 0)) value.fail("a number > 0");
    target = value.json.get<double>();
  };
  return {.name = name, .take = take, .give = [&target] { return written(target); }};
}
template <typename Int>
JsonKey whole(const char* name, Int& target, std::type_identity_t<Int> least,
              std::type_identity_t<Int> most) {
  const auto take = [&target, least, most](const JsonValue& value) {
    const Json& json = value.json;
    if (!json.is_number_integer() || json < least || json > most)
      value.fail(fmt::format("a whole number from {} to {}", least, most));
    target = json.get<Int>();
  };
  return {.name = name, .take = take, .give = [&target] { return written(target); }};
}
template <typename Int>
JsonKey whole(const char* name, std::optional<Int>& target, std::type_identity_t<Int> least,
              std::type_identity_t<Int> most = std::numeric_limits<Int>::max()) {
  const auto take = [name, &target, least, most](const JsonValue& value) {
    whole(name, target.emplace(), least, most).take(value);
  };
  return {.name = name, .take = take, .give = [&target] { return written(target); }};
}
template <typename Word>
JsonKey choice(const char* name, Word& target,
               const std::vector<std::pair<std::string_view, Word>>& words) {
  using Named = std::pair<std::string_view, Word>;
  const auto take = [&target, words](const JsonValue& value) {
    target = value.one_of(words, &Named::first).second;
  };
  const auto give = [&target, words] {
    const auto found = std::ranges::find(words, target, &Named::second);
    return found == words.end() ? Json(Json::value_t::discarded) : Json(found->first);
  };
  return {.name = name, .take = take, .give = give};
}

}  // namespace airybench
