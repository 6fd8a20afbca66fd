// `bench advise --mesh=… --error=1%`: which mesh and which method for an error that one chooses.
#pragma once

namespace airybench {

// As run_command().
int advise_command(int argc, const char* const* argv);

}  // namespace airybench
