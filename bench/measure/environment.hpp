// The environment of a run, its threads, and warnings about uncertain figures.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "bench/plan/options.hpp"
#include "bench/records/context.hpp"

namespace airybench {

// Of the first processor in /proc/cpuinfo: its name, or what AArch64 has instead, the numbers of
// its maker and model.
std::string cpu_model(std::istream& cpuinfo);

void set_threads(int threads);

Context describe_environment(int threads);

// Adds the options and the user's own words. Throws UsageError if such a word is in use already.
Context context_of_run(const Options& options);

// A line per fault; missing or "unknown" words give none. noise_kernel_s may be empty.
std::vector<std::string> machine_warnings(const Context& environment, int repetitions,
                                          const std::vector<double>& noise_kernel_s);

}  // namespace airybench
