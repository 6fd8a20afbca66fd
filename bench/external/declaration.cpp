#include "bench/external/declaration.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "bench/problems/problem_files.hpp"
#include "bench/records/json_value.hpp"
#include "support/errors.hpp"
#include "support/file_text.hpp"
#include "support/shortened.hpp"
#include "support/temporary_folder.hpp"

namespace airybench {
namespace {

using Returns = Declaration::Returns;
struct Kind {
  Returns returns;
  std::string_view name, reads;
};
constexpr std::array<Kind, 4> kinds = {{
    {Returns::airy_function, "airy_function", "airy"},
    {Returns::displacement, "displacement", "body"},
    {Returns::edge_displacements, "edge_displacements", "body"},
    {Returns::contact_forces, "contact_forces", "condensed"},
}};

void read_text(const JsonValue& value, std::string& text) {
  read(value, text);
  if (text.empty()) value.fail("a text");
}

JsonKey command_key(const char* name, std::vector<std::string>& command) {
  return {name, [&command](const JsonValue& value) {
            const auto is_text = [](const Json& word) { return word.is_string(); };
            const Json& json = value.json;
            if (!json.is_array() || json.empty() || !std::ranges::all_of(json, is_text) ||
                json.front() == "")
              value.fail("a list of texts, the program first");
            command = json.get<std::vector<std::string>>();
          }};
}

bool has_word(const std::vector<std::string>& command, std::string_view part) {
  return std::ranges::any_of(command,
                             [&](const std::string& word) { return word.find(part) != word.npos; });
}

// own: also allowed.
const std::string* unknown_placeholder(const std::vector<std::string>& command,
                                       const std::string& own) {
  for (const std::string& word : command)
    for (std::size_t open = word.find('{'); open != word.npos; open = word.find('{', open + 1)) {
      const std::size_t end = word.find_first_not_of("abcdefghijklmnopqrstuvwxyz_", open + 1);
      if (end == word.npos || end == open + 1 || word[end] != '}') continue;  // other braces
      const auto& all = placeholder::all;
      const std::string found = word.substr(open, end + 1 - open);
      if (std::ranges::find(all, found) == all.end() && found != own) return &word;
    }
  return nullptr;
}

std::string version_of(const std::filesystem::path& file, const std::filesystem::path& folder,
                       const std::vector<std::string>& command) {
  constexpr double limit_s = 60;
  const TemporaryFolder work;
  const std::filesystem::path printed = work.path() / "version";
  const ChildEnd end = run_program(
      {.command = command, .folder = folder, .output = printed, .scratch = work.path()}, {limit_s});
  const std::vector<std::string> lines = printed_lines(printed);
  if (end.exit_code != 0 || lines.empty())
    throw FileError(fmt::format("{}: version: {}: {}", file.string(),
                                shortened(fmt::format("{}", fmt::join(command, " "))),
                                how_it_ended(end, limit_s, lines)));
  return lines.front();
}

std::string placeholder_of(const std::string& parameter) {
  return parameter.empty() ? "" : "{" + parameter + "}";
}

}  // namespace

bool is_plain_program_name(const std::string& name) {
  return std::ranges::all_of(name, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
  });
}

Declaration read_declaration(const std::filesystem::path& file) {
  const Json json = json_of_file(file.string(), file_text(file));
  Declaration declaration;
  declaration.folder = std::filesystem::absolute(file).parent_path();
  std::string reads;
  std::vector<std::string> version;
  const auto read_name = [&](const JsonValue& value) {
    read_text(value, declaration.name);
    if (!is_plain_program_name(declaration.name)) value.fail("letters, digits, '-', '_' and '.'");
  };
  const auto read_format = [&](const JsonValue& value) {
    std::vector<std::string_view> formats = problem_formats();
    if (reads != "condensed") std::erase(formats, "fclib");
    declaration.format = value.one_of(formats);
  };
  const auto read_returns = [&](const JsonValue& value) {
    std::vector<Kind> of_it;
    std::ranges::copy_if(kinds, std::back_inserter(of_it),
                         [&](const Kind& kind) { return kind.reads == reads; });
    declaration.returns = value.one_of(of_it, &Kind::name, ", as it reads " + reads).returns;
  };
  const auto read_command = [&](const JsonValue& value) {
    command_key("command", declaration.command).take(value);
    const std::string own = placeholder_of(declaration.parameter);
    if (const std::string* word = unknown_placeholder(declaration.command, own))
      value.refuse(*word, fmt::format("{}{}{}", fmt::join(placeholder::all, ", "),
                                      own.empty() ? "" : ", ", own));
    if (!has_word(declaration.command, own)) value.fail("with " + own + ", the parameter");
  };
  const auto read_tolerance = [&](const JsonValue& value) {
    positive("first_tolerance", declaration.first_tolerance).take(value);
    if (!has_word(declaration.command, placeholder::tolerance))
      value.fail("with {tolerance} in the command");
  };
  const auto read_components = [&](const JsonValue& value) {
    const Json& given = value.json;
    if (reads != "condensed" || !given.is_array() || given.empty() ||
        std::ranges::any_of(
            given, [](const Json& one) { return !one.is_number_integer() || one < 1 || one > 3; }))
      value.fail("with \"reads\": \"condensed\", a list of 1, 2 and 3");
    declaration.components = given.get<std::vector<int>>();
  };
  const auto read_print_precision = [&](const JsonValue& value) {
    constexpr double fewest_digits = 5e-6;  // six
    const double given = value.json.is_number() ? value.json.get<double>() : 0;
    if (declaration.returns != Returns::displacement || !(given > 0 && given <= fewest_digits))
      value.fail("with \"returns\": \"displacement\", above 0, up to 5e-6: six digits");
    declaration.tolerances.print_precision = given;
  };
  const auto read_allowed_penetration = [&](const JsonValue& value) {
    const double given = value.json.is_number() ? value.json.get<double>() : 0;
    if (declaration.returns != Returns::displacement || !(given > 0 && given <= 1))
      value.fail("with \"returns\": \"displacement\", above 0, up to 1");
    declaration.tolerances.allowed_penetration = given;
  };
  const auto flag_of_displacement = [&](bool& flag) {
    return [&](const JsonValue& value) {
      if (declaration.returns != Returns::displacement || !value.json.is_boolean())
        value.fail("with \"returns\": \"displacement\", true or false");
      flag = value.json.get<bool>();
    };
  };
  const auto read_parameter = [&](const JsonValue& value) {
    const auto is_positive = [](const Json& one) { return one.is_number() && one > 0; };
    const Json& given = value.json;
    const std::string name = given.is_object() && given.size() == 1 ? given.begin().key() : "";
    const auto& all = placeholder::all;
    if (name.empty() || name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_") != name.npos ||
        std::ranges::find(all, placeholder_of(name)) != all.end() || !given[name].is_array() ||
        given[name].empty() || !std::ranges::all_of(given[name], is_positive))
      value.fail("one name of a to z and _ that is no other placeholder, a list of numbers > 0");
    declaration.parameter = name;
    for (const Json& one : given[name])
      declaration.values.push_back(fmt::format("{}", one.get<double>()));
    for (auto it = declaration.values.begin(); it != declaration.values.end(); ++it)
      if (std::find(declaration.values.begin(), it, *it) != it)
        value.refuse(*it, "every value once");
  };
  // A key comes after those that its reader uses.
  JsonValue(file.string(), "", json)
      .object({required({"name", read_name}),
               {"summary", [&](const JsonValue& value) { read_text(value, declaration.summary); }},
               required({"reads",
                         [&](const JsonValue& value) {
                           reads = value.one_of(std::array{"airy", "body", "condensed"});
                         }}),
               required({"format", read_format}),
               {"components", read_components},
               required({"returns", read_returns}),
               {"parameter", read_parameter},
               required({"command", read_command}),
               command_key("version", version),
               {"first_tolerance", read_tolerance},
               {"print_precision", read_print_precision},
               {"allowed_penetration", read_allowed_penetration},
               {"weak_contact", flag_of_displacement(declaration.tolerances.weak_contact)},
               {"other_elements", flag_of_displacement(declaration.tolerances.other_elements)},
               {"joins_bodies", flag_of_displacement(declaration.joins_bodies)},
               {"load_steps", flag_of_displacement(declaration.load_steps)}});
  if (!version.empty()) declaration.version = version_of(file, declaration.folder, version);
  return declaration;
}

std::vector<Declaration> for_every_value(const Declaration& declaration) {
  if (declaration.values.empty()) return {declaration};
  const std::string own = placeholder_of(declaration.parameter);
  std::vector<Declaration> all;
  for (const std::string& value : declaration.values) {
    Declaration one = declaration;
    one.values = {value};
    for (std::string& word : one.command)
      for (std::size_t at = 0; (at = word.find(own, at)) != word.npos; at += value.size())
        word.replace(at, own.size(), value);
    if (!all.empty()) one.name += fmt::format(":{}={}", one.parameter, value);
    all.push_back(std::move(one));
  }
  return all;
}

std::vector<std::string> printed_lines(const std::filesystem::path& file) {
  constexpr std::size_t part = 1 << 16;  // of its beginning, and of its end
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(symlink_status(file, unknown))) return {};
  std::ifstream bytes(file, std::ios::binary);
  std::string text(2 * part, '\0');
  bytes.read(text.data(), part);
  const auto end = static_cast<std::size_t>(file_size(file));
  auto read = static_cast<std::size_t>(bytes.gcount());
  if (end > part) {
    bytes.seekg(static_cast<std::streamoff>(std::max(part, end - part)));
    bytes.read(text.data() + part, part);
    read += static_cast<std::size_t>(bytes.gcount());
  }
  text.resize(read);
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    if (line.find_first_not_of(" \t\r") == line.npos) continue;
    if (lines.size() < 2) lines.emplace_back();
    lines.back() = shortened(line, 200);
  }
  return lines;
}

std::string how_it_ended(const ChildEnd& end, double limit_s,
                         const std::vector<std::string>& printed) {
  return how_it_ended(end, limit_s) + (printed.empty() ? "" : ": " + printed.back());
}

}  // namespace airybench
