// Where and with what a run was made, and the setting of its threads.
#pragma once

#include <map>
#include <string>

namespace airybench {

// Gives BLAS and OpenMP regions (CHOLMOD's) this many threads.
void set_threads(int threads);

// git revision and dirty flag, compiler and flags, library versions, BLAS, CPU, threads, load,
// date.
std::map<std::string, std::string> describe_environment(int threads);

}  // namespace airybench
