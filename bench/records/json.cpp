#include "bench/records/json.hpp"

#include <fmt/format.h>

#include "support/shortened.hpp"

namespace airybench {

namespace {

// Limits the depth, because reading and writing are recursive.
void check_text(const std::string& text) {
  constexpr int deepest = 32;
  int depth = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\0')  // the parser would stop there
      throw Json::parse_error::create(101, i + 1, "a zero byte", nullptr);
    if (c == '"') in_text = !in_text;
    if (in_text) {
      if (c == '\\') ++i;
    } else if (c == '[' || c == '{') {
      if (++depth > deepest)
        throw Json::parse_error::create(101, i + 1,
                                        fmt::format("nested more than {} deep", deepest), nullptr);
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
}

}  // namespace

Json parse_json(const std::string& text) {
  check_text(text);
  return Json::parse(text);
}

void parse_json(const std::string& text, Json::json_sax_t& sax) {
  check_text(text);
  Json::sax_parse(text.data(), text.data() + text.size(), &sax);
}

bool is_utf8(std::string_view text) {
  try {
    return !Json(text).dump().empty();
  } catch (const Json::type_error&) {
    return false;
  }
}

std::string json_text(const Json& json) { return indented_json_text(json, -1); }

std::string indented_json_text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string without_prefix(const Json::exception& wrong) {
  const std::string what = wrong.what();
  return shortened(what.substr(what.find("] ") + 2), 200);
}

}  // namespace airybench
