// Records in one folder are of the same kind of machine, build, threads and tolerances.
#pragma once

#include <map>
#include <string>

namespace airybench {

using Context = std::map<std::string, std::string>;  // Record's `context`

std::string context_word(const Context& context, const std::string& key);  // "": it has none

// To resume a run the program must be the same file; to join shards, which other compilers may have
// built, the same unchanged sources do. Different runs may also differ in their plan and limits.
enum class Sameness { same_program, same_sources, different_runs };

// Where two contexts differ that must not: "threads: 1 and 2; compiler: …"; empty: nowhere.
std::string differences(const Context& a, const Context& b, Sameness sameness);

}  // namespace airybench
