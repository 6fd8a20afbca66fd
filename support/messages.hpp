// What is shown of names and messages that others have chosen.
#pragma once

#include <string>
#include <string_view>

namespace airybench {

// Escapes what a terminal would obey or reorder, or does not show: control characters except line
// end and tab (\x1b), marks of writing direction and other characters without a glyph (\u202e,
// \ufeff), and bytes that are not UTF-8 (\xff).
std::string escaped(std::string_view text);

// What is written to standard output and standard error from here on is escaped; of words above 400
// bytes and lines above 4000 the rest is "…".
void show_messages_escaped();

// A message as it is shown so, for what is written in another way.
std::string shown_message(std::string_view text);

// On one line, but for those of a table, which are indented.
std::string one_line(std::string message);

// Writes to standard output what programs read: as it is, unless that is a terminal. Throws
// UsageError if it was closed at the start.
void print_data(std::string_view text);

}  // namespace airybench
