// `bench claims DIR`: the paper's sentences against the records of a results folder.
#pragma once

#include <string>

#include "bench/report/claims.hpp"

namespace airybench {

// argv[0] is "claims". Returns the exit code. Prints, and writes --out where asked. Throws
// HelpRequested, UsageError, FileError.
int claims_command(int argc, const char* const* argv);

// A verdict and its sentence on a line, what it rests on below.
std::string claims_text(const std::vector<Claim>& claims);
// The same as a table in markdown.
std::string claims_markdown(const std::vector<Claim>& claims);

}  // namespace airybench
