// One mesh under one scene: its blocks, its reference, and the measuring of methods on them.
//
// Detail (errors, counts, histories), memory and time are taken in separate runs of the same solve,
// so that none disturbs the others.
#pragma once

#include <memory>

#include "bench/options.hpp"
#include "bench/record.hpp"
#include "bench/reference.hpp"
#include "solvers/methods.hpp"

namespace airybench {

struct AssembledBlocks {
  std::unique_ptr<const DualSystem> system;
  std::vector<double> samples_s;
  std::optional<std::int64_t> heap_bytes;       // live after assembly
  std::optional<std::int64_t> peak_heap_bytes;  // highest during it
};

class Workbench {
 public:
  Workbench(std::shared_ptr<const Problem> problem, const Options& options);

  const Problem& problem() const { return *problem_; }

  // A record with the sizes, assembly figures and the detail run's verdict: status, errors, counts.
  // fields: where to write the solution's fields, or empty.
  Record examine(const Method& method, const std::filesystem::path& fields);
  // The memory run: heap and resident set at their peak during one solve.
  void measure_memory(const Method& method, Record& record);
  // One timed run, added to the record's samples; its seconds. A run that ends otherwise than the
  // detail run did sets the record's status.
  double measure_time(const Method& method, Record& record);

 private:
  const AssembledBlocks& blocks(Blocks which);
  const Reference* reference();  // null when there is none; no_reference_ says why
  Solution solve(const Method& method, const AssembledBlocks& blocks, bool histories);
  void judge(const AssembledBlocks& blocks, const Solution& solution, Record& record);

  std::shared_ptr<const Problem> problem_;
  const Options& options_;
  std::map<Blocks, AssembledBlocks> blocks_;
  std::optional<Reference> reference_;
  std::string no_reference_;
};

}  // namespace airybench
