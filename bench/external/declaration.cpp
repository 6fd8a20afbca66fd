#include "bench/external/declaration.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "bench/external/process_tree.hpp"
#include "bench/external/work_folder.hpp"
#include "bench/problems/problem_files.hpp"
#include "bench/records/case_name.hpp"
#include "bench/records/json.hpp"
#include "support/errors.hpp"
#include "support/file_text.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

using Reads = Declaration::Reads;
using Returns = Declaration::Returns;
const std::map<std::string, Reads> all_that_is_read = {
    {"airy", Reads::airy}, {"body", Reads::body}, {"condensed", Reads::condensed}};
const std::map<Reads, std::map<std::string, Returns>> all_that_is_returned = {
    {Reads::airy, {{"airy_function", Returns::airy_function}}},
    {Reads::body,
     {{"displacement", Returns::displacement},
      {"edge_displacements", Returns::edge_displacements}}},
    {Reads::condensed, {{"contact_forces", Returns::contact_forces}}},
};

template <typename Value>
std::string names_in(const std::map<std::string, Value>& values) {
  std::vector<std::string> names;
  for (const auto& [name, value] : values) names.push_back(name);
  return fmt::format("{}", fmt::join(names, ", "));
}

// The values of one file's keys; what does not fit is a FileError.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : file_(file.string()) {
    try {
      json_ = parse_json(file_text(file));
    } catch (const Json::exception& wrong) {
      throw FileError(fmt::format("{}: {}", file_, shortened(without_prefix(wrong), 200)));
    }
    if (!json_.is_object()) fail("the file", json_, "a JSON object");
    constexpr std::array<std::string_view, 8> keys = {
        "name", "summary", "reads", "format", "returns", "command", "version", "first_tolerance"};
    for (const auto& [key, value] : json_.items())
      if (std::ranges::find(keys, key) == keys.end())
        throw FileError(fmt::format("{}: {}: unknown key (allowed: {})", file_, shortened(key),
                                    fmt::join(keys, ", ")));
  }

  bool has(const char* key) const { return json_.contains(key); }
  [[noreturn]] void fail(const std::string& key, const Json& value,
                         const std::string& allowed) const {
    throw FileError(
        fmt::format("{}: {}: {} (allowed: {})", file_, key, shortened(json_text(value)), allowed));
  }
  std::string text(const char* key, const std::string& allowed = "a text") const {
    const Json& value = at(key, allowed);
    if (!value.is_string() || value.get<std::string>().empty()) fail(key, value, allowed);
    return value.get<std::string>();
  }
  std::vector<std::string> texts(const char* key) const {
    constexpr const char* allowed = "a list of texts, the program first";
    const Json& value = at(key, allowed);
    const auto is_text = [](const Json& item) { return item.is_string(); };
    if (!value.is_array() || value.empty() || !std::ranges::all_of(value, is_text) ||
        value.front().get<std::string>().empty())
      fail(key, value, allowed);
    return value.get<std::vector<std::string>>();
  }
  double number(const char* key, const char* allowed) const {
    const Json& value = at(key, allowed);
    if (!value.is_number() || !(value.get<double>() > 0)) fail(key, value, allowed);
    return value.get<double>();
  }

 private:
  const Json& at(const char* key, const std::string& allowed) const {
    if (!json_.contains(key))
      throw FileError(fmt::format("{}: {}: is missing (allowed: {})", file_, key, allowed));
    return json_.at(key);
  }

  std::string file_;
  Json json_;
};

// A name that can be asked for: no glob, no list, no part of a path.
bool is_plain(const std::string& name) {
  return std::ranges::all_of(name, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
  });
}

void check_placeholders(const Reader& file, const std::vector<std::string>& command) {
  for (const std::string& word : command)
    for (std::size_t open = word.find('{'); open != word.npos; open = word.find('{', open + 1)) {
      const std::size_t end = word.find_first_not_of("abcdefghijklmnopqrstuvwxyz_", open + 1);
      if (end == word.npos || end == open + 1 || word[end] != '}') continue;  // other braces
      const auto& all = placeholder::all;
      if (std::ranges::find(all, word.substr(open, end + 1 - open)) == all.end())
        file.fail("command", word, fmt::format("{}", fmt::join(all, ", ")));
    }
}

std::string version_of(const std::filesystem::path& file, const Declaration& declaration,
                       const std::vector<std::string>& command) {
  constexpr double limit_s = 60;
  const WorkFolder work;
  const std::filesystem::path printed = work.path() / "version";
  const ProcessTreeEnd end =
      run_process_tree({command, declaration.folder, {}, printed, work.path()}, {limit_s});
  const std::vector<std::string> lines = printed_lines(printed);
  if (end.exit_code != 0 || lines.empty())
    throw FileError(fmt::format("{}: version: {}: {}{}", file.string(),
                                shortened(fmt::format("{}", fmt::join(command, " "))),
                                how_it_ended(end, limit_s),
                                lines.empty() ? "" : ": " + lines.back()));
  return lines.front();
}

}  // namespace

Declaration read_declaration(const std::filesystem::path& file) {
  const Reader reader(file);
  Declaration declaration;
  declaration.folder = std::filesystem::absolute(file).parent_path();
  declaration.name = reader.text("name");
  if (!is_plain(declaration.name))
    reader.fail("name", declaration.name, "letters, digits, '-', '_' and '.'");
  if (reader.has("summary")) declaration.summary = reader.text("summary");

  const std::string allowed = names_in(all_that_is_read);
  const std::string reads = reader.text("reads", allowed);
  const auto found = all_that_is_read.find(reads);
  if (found == all_that_is_read.end()) reader.fail("reads", reads, allowed);
  declaration.reads = found->second;
  const auto& possible = all_that_is_returned.at(declaration.reads);
  const std::string returns = reader.text("returns", names_in(possible));
  const auto returned = possible.find(returns);
  if (returned == possible.end())
    reader.fail("returns", returns, fmt::format("{}, as it reads {}", names_in(possible), reads));
  declaration.returns = returned->second;

  const bool condensed = declaration.reads == Declaration::Reads::condensed;
  std::vector<std::string_view> formats = problem_formats();
  if (!condensed) std::erase(formats, "fclib");
  const std::string formats_allowed = fmt::format("{}", fmt::join(formats, ", "));
  declaration.format = reader.text("format", formats_allowed);
  if (std::ranges::find(formats, declaration.format) == formats.end())
    reader.fail("format", declaration.format, formats_allowed);

  declaration.command = reader.texts("command");
  check_placeholders(reader, declaration.command);
  if (reader.has("first_tolerance")) {
    declaration.first_tolerance = reader.number("first_tolerance", "a number > 0");
    const auto uses = [](const std::string& word) {
      return word.find(placeholder::tolerance) != word.npos;
    };
    if (std::ranges::none_of(declaration.command, uses))
      reader.fail("first_tolerance", declaration.first_tolerance,
                  "with {tolerance} in the command");
  }
  if (reader.has("version"))
    declaration.version = version_of(file, declaration, reader.texts("version"));
  return declaration;
}

}  // namespace airybench
