#pragma once

#include <functional>
#include <string>

namespace airybench {

inline constexpr int exit_failure = 1, exit_usage = 2;

// Writes "meshgen: what" to standard error, on one line but for a table's lines, which are
// indented; returns the exit code.
int complain(const std::string& what, int exit_code);

// The exit code of act, or that of its complaint: exit_usage for std::invalid_argument.
int complained(const std::function<int()>& act);

}  // namespace airybench
