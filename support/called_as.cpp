#include "support/called_as.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace airybench {

std::string called_as(std::string_view command) {
  const char* const script = std::getenv("AIRYBENCH_CALLED_AS");
  const bool by_script = script != nullptr && *script != '\0';
  if (command == "run") return by_script ? script : "./run";
  if (by_script) return std::string(script) + " " + std::string(command);
  return command == program_invocation_short_name ? shell_word(program_invocation_name)
                                                  : std::string(command);
}

std::string with_commands(std::string text) {
  for (const std::string_view command : {"bench", "meshgen", "run"}) {
    const std::string mark = "{" + std::string(command) + "}", called = called_as(command);
    for (std::size_t at = 0; (at = text.find(mark, at)) != text.npos; at += called.size())
      text.replace(at, mark.size(), called);
  }
  return text;
}

std::string shell_word(const std::string& word) {
  const bool is_plain = !word.empty() && std::ranges::all_of(word, [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || std::strchr("_./+-=%@", c) != nullptr;
  });
  if (is_plain) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

std::string file_operand(const std::string& file) {
  return shell_word(file.starts_with('-') ? "./" + file : file);
}

}  // namespace airybench
