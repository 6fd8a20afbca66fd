// Which records may stand in one folder: those measured on the same kind of machine, with the same
// build, threads and tolerances.
#pragma once

#include <map>
#include <string>

namespace airybench {

using Context = std::map<std::string, std::string>;  // Record's `context`

std::string context_word(const Context& context, const std::string& key);  // "": it has none

// For going on with a run the program must be the same file; for joining shards, which other
// machines' compilers may have built, it is enough that the sources are (unless they were changed
// since the revision). Different runs may also differ in their plan and limits.
enum class Sameness { same_program, same_sources, different_runs };

// In what two contexts differ that must not; empty: in nothing. One line: "threads: 1 and 2;
// compiler: …".
std::string differences(const Context& a, const Context& b, Sameness sameness);

}  // namespace airybench
