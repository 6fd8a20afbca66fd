// From the options of a run to its cases.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/plan/options.hpp"
#include "bench/plan/plan.hpp"
#include "support/folder_lock.hpp"

namespace airybench {

// Methods of the declarations, a method for each value of a parameter. Throws UsageError,
// FileError.
std::vector<Method> other_programs(const std::vector<std::filesystem::path>& declarations,
                                   const Limits& limits = {});

struct PlannedCases {
  std::vector<Case> whole, part;      // of all shards, of this one
  std::vector<std::string> short_of;  // goals of --adapt that are not reached
  std::unique_ptr<FolderLock> lock;   // of --out, where the adapted meshes are
};
// Adapts the meshes unless the command only plans. There is a case, or a goal that is not reached.
// added: more methods, which the options may name. Throws UsageError and errors of reading.
PlannedCases planned_cases(Options options, const std::vector<Method>& added = {});

// What the cases will take, by earlier records, and which stages they leave out.
void print_forecast(const std::vector<Case>& plan, const Options& options);

}  // namespace airybench
