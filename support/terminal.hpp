// What terminals show of names and messages that others have chosen.
#pragma once

#include <string>
#include <string_view>

namespace airybench {

// Escapes what a terminal would obey or reorder: control characters except line end and tab (\x1b),
// marks of writing direction (\u202e), and bytes that are not UTF-8 (\xff).
std::string escaped_for_terminal(std::string_view text);

// Escapes standard output and standard error where they are terminals; files and pipes get the text
// as it is.
void escape_on_terminals();

}  // namespace airybench
