#include "support/terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <ext/stdio_sync_filebuf.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <optional>
#include <utility>

#include "support/atomic_file.hpp"

namespace airybench {
namespace {

std::size_t size_by_first_byte(char first) {
  const auto byte = static_cast<unsigned char>(first);
  return byte < 0x80   ? 1
         : byte < 0xC2 ? 0
         : byte < 0xE0 ? 2
         : byte < 0xF0 ? 3
         : byte < 0xF5 ? 4
                       : 0;
}

bool continues(char byte) { return (byte & 0xC0) == 0x80; }

// The code point of a character in UTF-8; empty if it is none.
std::optional<std::uint32_t> code_point(std::string_view character) {
  constexpr std::array<std::uint32_t, 5> bits_of_first = {0, 0x7F, 0x1F, 0x0F, 0x07};
  if (character.empty() || character.size() != size_by_first_byte(character[0])) return {};
  std::uint32_t code = static_cast<unsigned char>(character[0]) & bits_of_first[character.size()];
  for (const char byte : character.substr(1)) {
    if (!continues(byte)) return {};
    code = code << 6 | (byte & 0x3F);
  }
  return code;
}

bool is_obeyed(std::uint32_t code) {
  const auto is_from = [&](std::uint32_t first, std::uint32_t last) {
    return first <= code && code <= last;
  };
  return (code < ' ' && code != '\n' && code != '\t') || is_from(0x7F, 0x9F) || code == 0x61C ||
         is_from(0x200E, 0x200F) || is_from(0x2028, 0x202E) || is_from(0x2066, 0x2069);
}

struct Terminal {
  int descriptor;
  std::string rest;  // the start of a character whose end has not been written yet
};

// Bytes at the end of the text that begin a character.
std::size_t unfinished(std::string_view text) {
  for (std::size_t back = 1; back <= std::min<std::size_t>(3, text.size()); ++back)
    if (const char byte = text[text.size() - back]; !continues(byte))
      return size_by_first_byte(byte) > back ? back : 0;
  return 0;
}

ssize_t write_escaped(void* cookie, const char* bytes, std::size_t size) {
  Terminal& terminal = *static_cast<Terminal*>(cookie);
  std::string text = std::exchange(terminal.rest, {});
  text.append(bytes, size);
  const std::size_t whole = text.size() - unfinished(text);
  terminal.rest = text.substr(whole);
  errno = write_all(terminal.descriptor, escaped_for_terminal(text.substr(0, whole)));
  return errno == 0 ? static_cast<ssize_t>(size) : 0;
}

void escape(std::FILE*& stream, Terminal* terminal, int buffering, std::ostream& same) {
  if (isatty(terminal->descriptor) == 0) return;
  std::FILE* const escaping =
      fopencookie(terminal, "w", {nullptr, write_escaped, nullptr, nullptr});
  if (escaping == nullptr) return;
  setvbuf(escaping, nullptr, buffering, BUFSIZ);
  stream = escaping;
  same.rdbuf(new __gnu_cxx::stdio_sync_filebuf<char>(escaping));
}

}  // namespace

std::string escaped_for_terminal(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t size = std::max<std::size_t>(1, size_by_first_byte(text[0]));
    const std::string_view character = text.substr(0, size);
    const std::optional<std::uint32_t> code = code_point(character);
    if (!code)
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[0]));
    else if (is_obeyed(*code))
      result += *code < 0x80 ? fmt::format("\\x{:02x}", *code) : fmt::format("\\u{:04x}", *code);
    else
      result += character;
    text.remove_prefix(code ? size : 1);
  }
  return result;
}

void escape_on_terminals() {
  // Never destroyed, because the C library flushes after the last destructor.
  static Terminal* const out = new Terminal{STDOUT_FILENO, ""};
  static Terminal* const err = new Terminal{STDERR_FILENO, ""};
  escape(stdout, out, _IOLBF, std::cout);
  escape(stderr, err, _IONBF, std::cerr);
}

}  // namespace airybench
