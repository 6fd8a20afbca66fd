#include "support/messages.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <ext/stdio_sync_filebuf.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <optional>
#include <utility>

#include "support/atomic_file.hpp"
#include "support/this_process.hpp"

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

// Of no glyph: Unicode's categories Cc, Cf, Zl and Zp.
bool is_obeyed(std::uint32_t code) {
  constexpr std::uint32_t ranges[][2] = {
      {0x00, 0x08},       {0x0B, 0x1F},      {0x7F, 0x9F},     {0xAD, 0xAD},     {0x600, 0x605},
      {0x61C, 0x61C},     {0x6DD, 0x6DD},    {0x70F, 0x70F},   {0x180E, 0x180E}, {0x200B, 0x200F},
      {0x2028, 0x202E},   {0x2060, 0x206F},  {0xFEFF, 0xFEFF}, {0xFFF9, 0xFFFB}, {0x13430, 0x1343F},
      {0x1D173, 0x1D17A}, {0xE0000, 0xE007F}};
  return std::any_of(std::begin(ranges), std::end(ranges),
                     [&](auto& range) { return range[0] <= code && code <= range[1]; });
}

// A standard stream.
struct Messages {
  int descriptor;
  bool is_terminal = false, is_data = false;
  std::string rest = "";           // the start of a character whose end has not been written yet
  std::size_t word = 0, line = 0;  // bytes of these so far

  // Of the next character, escaped.
  std::string cut(const std::string& shown) {
    constexpr std::size_t max_of_word = 400, max_of_line = 4000;
    const auto is_over = [&] { return word > max_of_word || line > max_of_line; };
    const bool was_over = is_over();
    word = shown == " " || shown == "\t" || shown == "\n" ? 0 : word + shown.size();
    line = shown == "\n" ? 0 : line + shown.size();
    return !is_over() ? shown : was_over ? "" : "…";
  }
};

// Bytes at the end of the text that begin a character.
std::size_t unfinished(std::string_view text) {
  for (std::size_t back = 1; back <= std::min<std::size_t>(3, text.size()); ++back)
    if (const char byte = text[text.size() - back]; !continues(byte))
      return size_by_first_byte(byte) > back ? back : 0;
  return 0;
}

// Calls act() with each, escaped.
template <typename Act>
void for_each_character(std::string_view text, const Act& act) {
  while (!text.empty()) {
    std::string_view character =
        text.substr(0, std::max<std::size_t>(1, size_by_first_byte(text[0])));
    const std::optional<std::uint32_t> code = code_point(character);
    if (!code) character = text.substr(0, 1);
    if (!code || (*code < 0x80 && is_obeyed(*code)))
      act(fmt::format("\\x{:02x}", static_cast<unsigned char>(character[0])));
    else
      act(is_obeyed(*code) ? fmt::format("\\u{:04x}", *code) : std::string(character));
    text.remove_prefix(character.size());
  }
}

ssize_t write_shown(void* cookie, const char* bytes, std::size_t size) {
  Messages& stream = *static_cast<Messages*>(cookie);
  std::string shown;
  if (stream.is_data && !stream.is_terminal) {
    shown.assign(bytes, size);
  } else {
    std::string text = std::exchange(stream.rest, {});
    text.append(bytes, size);
    const std::size_t whole = text.size() - unfinished(text);
    stream.rest = text.substr(whole);
    for_each_character(std::string_view(text).substr(0, whole), [&](const std::string& character) {
      shown += stream.is_data ? character : stream.cut(character);
    });
  }
  errno = write_all(stream.descriptor, shown);
  return errno == 0 ? static_cast<ssize_t>(size) : 0;
}

void show(std::FILE*& stream, Messages& messages, int buffering, std::ostream& same) {
  messages.is_terminal = isatty(messages.descriptor) != 0;
  std::FILE* const shown = fopencookie(&messages, "w", {nullptr, write_shown, nullptr, nullptr});
  if (shown == nullptr) return;
  setvbuf(shown, nullptr, messages.is_terminal && buffering == _IOFBF ? _IOLBF : buffering, BUFSIZ);
  stream = shown;
  same.rdbuf(new __gnu_cxx::stdio_sync_filebuf<char>(shown));
}

// Never destroyed, because the C library flushes after the last destructor.
Messages& output() {
  static Messages* const out = new Messages{STDOUT_FILENO};
  return *out;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for_each_character(text, [&](const std::string& character) { result += character; });
  return result;
}

std::string shown_message(std::string_view text) {
  Messages stream{STDERR_FILENO};
  std::string shown;
  for_each_character(text, [&](const std::string& character) { shown += stream.cut(character); });
  return shown;
}

void show_messages_escaped() {
  static Messages* const err = new Messages{STDERR_FILENO};
  show(stdout, output(), _IOFBF, std::cout);
  show(stderr, *err, _IONBF, std::cerr);
}

std::string one_line(std::string message) {
  for (std::size_t at = 0; (at = message.find('\n', at)) != message.npos; ++at)
    if (message.compare(at + 1, 2, "  ") != 0) message[at] = ' ';
  return message;
}

void print_data(std::string_view text) {
  require_standard_output();
  std::fflush(stdout);
  output().is_data = true;
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
  output().is_data = false;
}

}  // namespace airybench
