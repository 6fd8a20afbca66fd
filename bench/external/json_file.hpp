// A JSON file with one object, read key by key. Unfit content throws FileError, one line: file,
// key, value, what is allowed.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "bench/records/json.hpp"
#include "support/errors.hpp"
#include "support/shortened.hpp"

namespace airybench {

class JsonFile {
 public:
  JsonFile(std::string name, const std::string& text) : name_(std::move(name)) {
    try {
      json_ = parse_json(text);
    } catch (const Json::exception& wrong) {
      throw FileError(fmt::format("{}: {}", name_, without_prefix(wrong)));
    }
    if (!json_.is_object()) fail("the file", json_, "a JSON object");
  }

  enum class Need { must_be_there, may_be_left_out };
  // take stores the value, or returns false if it is not allowed.
  void read(const char* key, Need need, const std::string& allowed,
            const std::function<bool(const Json& value)>& take) {
    keys_.emplace_back(key);
    if (json_.contains(key)) {
      if (!take(json_.at(key))) fail(key, json_.at(key), allowed);
    } else if (need == Need::must_be_there) {
      throw FileError(fmt::format("{}: {}: is missing (allowed: {})", name_, key, allowed));
    }
  }
  void refuse_other_keys() const {
    for (const auto& [key, value] : json_.items())
      if (std::ranges::find(keys_, key) == keys_.end())
        throw FileError(fmt::format("{}: {}: unknown key (allowed: {})", name_, shortened(key),
                                    fmt::join(keys_, ", ")));
  }
  [[noreturn]] void fail(const std::string& key, const Json& value,
                         const std::string& allowed) const {
    throw FileError(
        fmt::format("{}: {}: {} (allowed: {})", name_, key, shortened(json_text(value)), allowed));
  }

 private:
  std::string name_;
  Json json_;
  std::vector<std::string> keys_;
};

}  // namespace airybench
