// The command line of a run.
#pragma once

#include "bench/plan/options.hpp"

namespace airybench {

// Throws UsageError, HelpRequested.
Options parse_options(int argc, const char* const* argv);

}  // namespace airybench
