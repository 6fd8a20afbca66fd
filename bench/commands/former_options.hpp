// Options and commands of earlier versions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace airybench {

// Of 1.0. Throws UsageError: names what the option is now.
void refuse_replaced(int argc, const char* const* argv);

// Of 2.0, a command that is a script now. Throws UsageError: names it.
void refuse_former_command(std::string_view word);

// Of 2.0, for one version more, options that are commands now: "bench --check=mine.json" becomes
// "bench check mine.json", and a note says so. words: argv.
std::vector<std::string> with_command(std::vector<std::string> words);

}  // namespace airybench
