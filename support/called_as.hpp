// How this user starts the project's commands, for lines that are printed to be copied.
#pragma once

#include <string>
#include <string_view>

namespace airybench {

// "./run bench": as the script was typed ($AIRYBENCH_CALLED_AS), which starts this program; else
// the program as it was typed, or the name of another. "run": the script itself.
std::string called_as(std::string_view command);

// The text with "{bench}", "{meshgen}" and "{run}" replaced by these.
std::string with_commands(std::string text);

// The word as a shell reads it, in quotes where it needs them.
std::string shell_word(const std::string& word);
// The same of a file that follows the options: no option, whatever its name.
std::string file_operand(const std::string& file);

}  // namespace airybench
