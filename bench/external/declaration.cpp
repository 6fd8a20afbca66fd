#include "bench/external/declaration.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "bench/external/json_file.hpp"
#include "bench/problems/problem_files.hpp"
#include "support/file_text.hpp"
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

template <typename Words>
std::string list_of(const Words& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

bool is_text(const Json& value) { return value.is_string() && !value.get<std::string>().empty(); }

bool is_command(const Json& value) {
  return value.is_array() && !value.empty() && is_text(value.front()) &&
         std::ranges::all_of(value, [](const Json& word) { return word.is_string(); });
}

// Excludes globs, lists and parts of paths, so that a user can select the name.
bool is_plain(const std::string& name) {
  return std::ranges::all_of(name, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
  });
}

const std::string* unknown_placeholder(const std::vector<std::string>& command) {
  for (const std::string& word : command)
    for (std::size_t open = word.find('{'); open != word.npos; open = word.find('{', open + 1)) {
      const std::size_t end = word.find_first_not_of("abcdefghijklmnopqrstuvwxyz_", open + 1);
      if (end == word.npos || end == open + 1 || word[end] != '}') continue;  // other braces
      const auto& all = placeholder::all;
      if (std::ranges::find(all, word.substr(open, end + 1 - open)) == all.end()) return &word;
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

}  // namespace

Declaration read_declaration(const std::filesystem::path& file) {
  constexpr auto needed = JsonFile::Need::must_be_there, optional = JsonFile::Need::may_be_left_out;
  constexpr const char* a_command = "a list of texts, the program first";
  JsonFile json(file.string(), file_text(file));
  Declaration declaration;
  declaration.folder = std::filesystem::absolute(file).parent_path();
  const auto into = [](std::string& text) {
    return [&text](const Json& value) {
      if (is_text(value)) text = value.get<std::string>();
      return is_text(value);
    };
  };
  json.read("name", needed, "a text", into(declaration.name));
  if (!is_plain(declaration.name))
    json.fail("name", declaration.name, "letters, digits, '-', '_' and '.'");
  json.read("summary", optional, "a text", into(declaration.summary));

  std::string reads;
  json.read("reads", needed, "airy, body, condensed", [&](const Json& value) {
    return into(reads)(value) && std::ranges::find(kinds, reads, &Kind::reads) != kinds.end();
  });
  std::vector<std::string_view> formats = problem_formats();
  if (reads != "condensed") std::erase(formats, "fclib");
  json.read("format", needed, list_of(formats), [&](const Json& value) {
    return into(declaration.format)(value) &&
           std::ranges::find(formats, declaration.format) != formats.end();
  });
  std::vector<std::string_view> returned;
  for (const Kind& kind : kinds)
    if (kind.reads == reads) returned.push_back(kind.name);
  json.read("returns", needed, list_of(returned) + ", as it reads " + reads,
            [&](const Json& value) {
              const auto kind = std::ranges::find_if(
                  kinds, [&](const Kind& k) { return k.reads == reads && value == k.name; });
              if (kind != kinds.end()) declaration.returns = kind->returns;
              return kind != kinds.end();
            });

  const auto command_into = [](std::vector<std::string>& command) {
    return [&command](const Json& value) {
      if (is_command(value)) command = value.get<std::vector<std::string>>();
      return is_command(value);
    };
  };
  json.read("command", needed, a_command, command_into(declaration.command));
  if (const std::string* word = unknown_placeholder(declaration.command))
    json.fail("command", *word, list_of(placeholder::all));
  std::vector<std::string> version;
  json.read("version", optional, a_command, command_into(version));
  json.read("first_tolerance", optional, "a number > 0", [&](const Json& value) {
    if (value.is_number()) declaration.first_tolerance = value;
    return declaration.first_tolerance > 0;
  });
  if (declaration.first_tolerance > 0 &&
      std::ranges::none_of(declaration.command, [](const std::string& word) {
        return word.find(placeholder::tolerance) != word.npos;
      }))
    json.fail("first_tolerance", declaration.first_tolerance, "with {tolerance} in the command");
  json.refuse_other_keys();
  if (!version.empty()) declaration.version = version_of(file, declaration.folder, version);
  return declaration;
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
