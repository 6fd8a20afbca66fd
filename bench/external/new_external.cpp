#include "bench/external/new_external.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string_view>

#include "bench/external/declaration.hpp"
#include "bench/problems/problem_files.hpp"
#include "bench/records/json.hpp"
#include "support/atomic_file.hpp"
#include "support/data_folder.hpp"
#include "support/errors.hpp"
#include "support/file_text.hpp"
#include "support/shortened.hpp"
#include "support/temporary_folder.hpp"

namespace airybench {
namespace {

// The first python3 that has NumPy: Debian's may be hidden by another in PATH.
std::string python_with_numpy() {
  constexpr double limit_s = 60;
  for (const char* python : {"python3", "/usr/bin/python3"}) {
    const TemporaryFolder work;
    const ChildEnd end = run_program({.command = {python, "-c", "import numpy"},
                                      .folder = work.path(),
                                      .output = work.path() / "printed",
                                      .scratch = work.path()},
                                     {limit_s});
    if (end.exit_code == 0) return python;
  }
  throw FileError("new-external: no python3 has NumPy (Debian: python3-numpy)");
}

struct Language {
  const char* ending;
  const char* format;  // of the problem's files
};
Language language_of(const NewExternal& asked) {
  return asked.language == "c++" ? Language{".cpp", "matrix-market"} : Language{".py", "npz"};
}

// A template, with what it includes of the others in its place, so that a program is one file.
std::string program_text(const std::filesystem::path& file, const std::string& name) {
  constexpr std::string_view include = "#include \"", placeholder = "NAME";
  std::istringstream in(file_text(file));
  std::string text;
  for (std::string line; std::getline(in, line); text += line + "\n") {
    if (line.starts_with(include))
      line = program_text(
          file.parent_path() / line.substr(include.size(), line.size() - include.size() - 1), name);
    for (std::size_t at = 0; (at = line.find(placeholder, at)) != line.npos; at += name.size())
      line.replace(at, placeholder.size(), name);
  }
  return text;
}

std::string declaration_text(const NewExternal& asked, const std::string& name) {
  const bool is_body = asked.reads == "body";
  const auto line = [](const char* key, const Json& value) {
    return fmt::format("  {}: {}", json_text(key), json_text(value));
  };
  std::vector<std::string> command = {"./" + name}, version = {"./" + name, "--version"};
  if (asked.language == "python") {
    const std::string python = python_with_numpy();
    command = {python, name + ".py"};
    version = {python, "-c", "import numpy; print('NumPy', numpy.__version__)"};
  }
  command.insert(command.end(), {"{input}", "{output}"});
  return fmt::format("{{\n{},\n{},\n{},\n{},\n{},\n{},\n{}\n}}\n", line("name", name),
                     line("summary", is_body ? "quadratic triangles, Newton's method"
                                             : "Newton's method on the condensed contact law"),
                     line("reads", asked.reads), line("format", language_of(asked).format),
                     line("returns", is_body ? "displacement" : "contact_forces"),
                     line("command", command), line("version", version));
}

}  // namespace

std::vector<std::filesystem::path> write_new_external(const NewExternal& asked) {
  const std::filesystem::path& stem = asked.stem;
  const std::string name = stem.filename().string();
  if (name.empty() || !is_plain_program_name(name))
    throw UsageError(fmt::format("NAME: {} (allowed: letters, digits, '-', '_' and '.')",
                                 shortened(stem.string())));
  if (asked.reads == "body" && asked.language == "python")
    throw UsageError("--reads=body: with --language=c++ (in Python: docs/python.md)");
  const Language language = language_of(asked);
  check_problem_format(language.format);
  const auto with = [&](const char* ending) { return stem.parent_path() / (name + ending); };
  const std::vector<std::filesystem::path> files = {with(language.ending), with(".json")};
  for (const std::filesystem::path& file : files)
    if (std::error_code error; std::filesystem::exists(symlink_status(file, error)))
      throw FileError(file.string() + ": is there already (allowed: a name that is free)");
  const std::string declaration = declaration_text(asked, name);
  write_file_atomically(
      files[0], program_text(data_folder("templates") / (asked.reads + language.ending), name));
  try {
    write_file_atomically(files[1], declaration);
  } catch (...) {
    std::error_code error;
    std::filesystem::remove(files[0], error);
    throw;
  }
  return files;
}

}  // namespace airybench
