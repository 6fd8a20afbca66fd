// Reads the values of a scene file's keys; the type of the target selects the overload of read(). A
// value that does not fit throws SceneError, one line: file, key, value, allowed values.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "assembly/scene.hpp"
#include "bench/records/json.hpp"
#include "support/lists.hpp"
#include "support/shortened.hpp"

namespace airybench {

class SceneValue;

struct SceneKey {
  std::string name;
  std::function<void(const SceneValue&)> take;
};

class SceneValue {
 public:
  // key: "boundary: force: pressure_MPa"; empty for the whole scene.
  SceneValue(std::string file, std::string key, const Json& value)
      : json(value), file_(std::move(file)), key_(std::move(key)) {}

  const Json& json;

  SceneValue at(const std::string& key, const Json& value) const {
    return {file_, key_.empty() ? key : key_ + ": " + key, value};
  }
  SceneValue item(std::size_t k) const { return {file_, key_, json[k]}; }

  // Calls the takers of the keys that are present, in the order of `keys`; refuses other keys. If
  // `all` is not empty, every key is required, and `all` names the allowed values.
  void object(const std::vector<SceneKey>& keys, const std::string& all = "") const {
    if (!json.is_object()) fail("a JSON object");
    for (const auto& [name, value] : json.items())
      if (std::ranges::find(keys, name, &SceneKey::name) == keys.end()) refuse(name, keys);
    bool is_complete = true;
    for (const SceneKey& key : keys)
      if (const auto found = json.find(key.name); found != json.end())
        key.take(at(key.name, *found));
      else
        is_complete = false;
    if (!all.empty() && !is_complete) fail(all);
  }
  void each(const std::string& allowed,
            const std::function<void(const std::string&, const SceneValue&)>& take) const {
    if (!json.is_object()) fail(allowed);
    for (const auto& [name, value] : json.items()) take(name, at(name, value));
  }
  [[noreturn]] void fail(const std::string& allowed) const {
    throw SceneError(fmt::format("{}: {}: {} (allowed: {})", file_,
                                 key_.empty() ? "the scene" : key_, shortened(json_text(json)),
                                 allowed));
  }

 private:
  [[noreturn]] void refuse(const std::string& name, const std::vector<SceneKey>& keys) const {
    std::string valid;
    std::vector<std::string> names;
    for (const SceneKey& key : keys) {
      valid += (valid.empty() ? "" : ", ") + key.name;
      names.push_back(key.name);
    }
    const std::string nearest = nearest_of(name, names);
    throw SceneError(fmt::format("{}: {}{}: unknown key{} (allowed: {})", file_,
                                 key_.empty() ? "" : shortened(key_ + ": "), shortened(name),
                                 nearest.empty() ? "" : ", perhaps " + nearest, valid));
  }

  std::string file_, key_;
};

inline void read(const SceneValue& value, double& number) {
  if (!value.json.is_number()) value.fail("a number");
  number = value.json.get<double>();
}
inline void read(const SceneValue& value, std::string& text) {
  if (!value.json.is_string()) value.fail("a text");
  text = value.json.get<std::string>();
}
inline void read(const SceneValue& value, Eigen::Vector2d& vector) {
  const Json& json = value.json;
  if (!json.is_array() || json.size() != 2 || !json[0].is_number() || !json[1].is_number())
    value.fail("two numbers [x, y]");
  vector = {json[0].get<double>(), json[1].get<double>()};
}
template <typename T>
void read(const SceneValue& value, std::optional<T>& target) {
  read(value, target.emplace());
}
template <typename T>
void read(const SceneValue& value, std::array<T, 2>& pair) {
  if (!value.json.is_array() || value.json.size() != 2) value.fail("a list of two");
  for (std::size_t k = 0; k < 2; ++k) read(value.item(k), pair[k]);
}

// Rows of the tables of keys. Each keeps a reference to its target.
template <typename T>
SceneKey key(const char* name, T& target) {
  return {name, [&target](const SceneValue& value) { read(value, target); }};
}
template <typename T>
SceneKey positive(const char* name, T& target) {
  return {name, [&target](const SceneValue& value) {
            double number = 0;
            read(value, number);
            if (!(number > 0)) value.fail("a number > 0");
            target = number;
          }};
}
template <typename T>
SceneKey whole(const char* name, T& target, int least, int most) {
  return {name, [&target, least, most](const SceneValue& value) {
            const Json& json = value.json;
            if (!json.is_number_integer() || json < least || json > most)
              value.fail(fmt::format("a whole number from {} to {}", least, most));
            target = json.get<int>();
          }};
}
template <typename T, typename Word>
SceneKey either(const char* name, T& target, const char* first_word, Word first,
                const char* second_word, Word second) {
  return {name, [=, &target](const SceneValue& value) {
            if (value.json != first_word && value.json != second_word)
              value.fail(fmt::format("\"{}\" or \"{}\"", first_word, second_word));
            target = value.json == first_word ? first : second;
          }};
}

// scene_keys.cpp
void read(const SceneValue& value, Scene& scene);
// Of a scene's roles and length_unit: options of `meshgen --convert`.
std::vector<std::string> read_model_settings(const SceneValue& scene);

}  // namespace airybench
