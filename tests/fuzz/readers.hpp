// The readers of files that come from elsewhere. Each takes what is good, does with it what every
// run does, and throws InputError for the rest; anything else that happens is a finding.
#pragma once

#include <string>

namespace airybench::fuzz {

void mesh(const std::string& text);
void scene(const std::string& text);
void record(const std::string& text);  // a file of them
void night(const std::string& text);

}  // namespace airybench::fuzz
