// Reads the values of a scene file's keys. What does not fit throws SceneError, one line: file,
// key, value, what is allowed.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "assembly/scene.hpp"
#include "bench/records/json.hpp"
#include "support/shortened.hpp"

namespace airybench {

class SceneReader {
 public:
  explicit SceneReader(std::string file) : file_(std::move(file)) {}

  using Setter = std::function<void(const std::string& key, const Json& value)>;

  // Hands every key to its setter; unknown keys are refused. prefix: empty, or "key: ".
  void object(const std::string& prefix, const Json& json,
              const std::vector<std::pair<std::string, Setter>>& keys) const {
    if (!json.is_object())
      fail(prefix.empty() ? "the scene" : prefix.substr(0, prefix.size() - 2), json,
           "a JSON object");
    for (const auto& [key, value] : json.items()) {
      const auto found = std::ranges::find(keys, key, &std::pair<std::string, Setter>::first);
      if (found == keys.end()) {
        std::string valid;
        for (const auto& known : keys) valid += (valid.empty() ? "" : ", ") + known.first;
        throw SceneError(fmt::format("{}: {}{}: unknown key (allowed: {})", file_,
                                     shortened(prefix), shortened(key), valid));
      }
      found->second(prefix + key, value);
    }
  }
  double number(const std::string& key, const Json& value) const {
    if (!value.is_number()) fail(key, value, "a number");
    return value.get<double>();
  }
  double positive(const std::string& key, const Json& value) const {
    const double number = this->number(key, value);
    if (!(number > 0)) fail(key, value, "a number > 0");
    return number;
  }
  int whole(const std::string& key, const Json& value, int least, int most) const {
    if (!value.is_number_integer() || value < least || value > most)
      fail(key, value, fmt::format("a whole number from {} to {}", least, most).c_str());
    return value.get<int>();
  }
  std::string text(const std::string& key, const Json& value) const {
    if (!value.is_string()) fail(key, value, "a text");
    return value.get<std::string>();
  }
  Eigen::Vector2d vector(const std::string& key, const Json& value) const {
    if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number())
      fail(key, value, "two numbers [x, y]");
    return {value[0].get<double>(), value[1].get<double>()};
  }
  [[noreturn]] void fail(const std::string& key, const Json& value, const char* allowed) const {
    throw SceneError(
        fmt::format("{}: {}: {} (allowed: {})", file_, key, shortened(json_text(value)), allowed));
  }

 private:
  std::string file_;
};

}  // namespace airybench
