// `bench track`: measures the nightly selection and adds it to a history.
#pragma once

#include <string>
#include <vector>

namespace airybench {

// argv[0] is "track". 0, or 1 when something has become worse. Throws HelpRequested, UsageError,
// RecordError and what a run throws.
int track_command(int argc, const char* const* argv);

// The arguments of its run: `own` of the user, and the nightly selection for what they leave open.
std::vector<std::string> nightly_arguments(const std::vector<std::string>& own,
                                           const std::string& out);

}  // namespace airybench
