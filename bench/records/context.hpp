// Compares contexts: the records in one folder share machine type, build, threads and tolerances.
#pragma once

#include <map>
#include <string>

namespace airybench {

using Context = std::map<std::string, std::string>;  // Record's `context`

std::string context_word(const Context& context, const std::string& key);  // "" if missing

// same_program (to resume): one executable. same_sources (to join shards) allows two executables of
// one clean revision. different_runs also allows other plans and limits.
enum class Sameness { same_program, same_sources, different_runs };

// The forbidden differences, "threads: 1 and 2; compiler: …"; empty if there are none.
std::string differences(const Context& a, const Context& b, Sameness sameness);

}  // namespace airybench
