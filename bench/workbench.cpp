#include "bench/workbench.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <chrono>
#include <new>

#include "bench/fields.hpp"
#include "bench/heap_probe.hpp"
#include "bench/rss_probe.hpp"

namespace airybench {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::optional<std::int64_t> if_probed(std::int64_t bytes) {
  return heap::is_active() ? std::optional(bytes) : std::nullopt;
}

AssembledBlocks assemble_and_measure(const std::shared_ptr<const Problem>& problem, Blocks which,
                                     int repetitions) {
  AssembledBlocks blocks;
  for (int i = 0; i < repetitions; ++i) {
    blocks.system.reset();
    heap::reset_peak();
    const std::int64_t before = heap::live_bytes();
    const auto start = std::chrono::steady_clock::now();
    blocks.system.reset(new DualSystem(assemble(problem, which)));  // in place: no copy
    blocks.samples_s.push_back(seconds_since(start));
    blocks.heap_bytes = if_probed(heap::live_bytes() - before);
    blocks.peak_heap_bytes = if_probed(heap::peak_bytes() - before);
  }
  return blocks;
}

}  // namespace

Workbench::Workbench(std::shared_ptr<const Problem> problem, const Options& options)
    : problem_(std::move(problem)), options_(options) {}

const AssembledBlocks& Workbench::blocks(Blocks which) {
  auto found = blocks_.find(which);
  if (found == blocks_.end())
    found =
        blocks_.emplace(which, assemble_and_measure(problem_, which, options_.repetitions)).first;
  return found->second;
}

const Reference* Workbench::reference() {
  if (!reference_ && no_reference_.empty()) {
    try {
      const DualSystem system = assemble(problem_, Blocks::contact_points);
      reference_ = compute_reference(system);
      Solution as_solution;
      as_solution.F_C = reference_->F_C;
      as_solution.stress = reference_->stress;
      const double residual = verify(system, as_solution, nullptr).equilibrium_residual;
      if (!(residual <= options_.target_error / 10)) {
        reference_.reset();
        no_reference_ = fmt::format("no reference: its equilibrium residual is {:.1e}", residual);
      }
    } catch (const Breakdown& breakdown) {
      no_reference_ = breakdown.what();
    } catch (const std::bad_alloc&) {
      no_reference_ = "no reference: out of memory";
    }
  }
  return reference_ ? &*reference_ : nullptr;
}

Solution Workbench::solve(const Method& method, const AssembledBlocks& blocks, bool histories) {
  RunControl control;
  control.deadline = Deadline::after(options_.timeout_s);
  control.histories = histories;
  try {
    std::optional<heap::Limit> limit;
    if (options_.memory_limit_bytes)
      limit.emplace(heap::live_bytes() - blocks.heap_bytes.value_or(0) +
                    *options_.memory_limit_bytes);
    Solution solution = run(method, *blocks.system, control);
    if (!limit || !limit->exceeded()) return solution;
  } catch (const std::bad_alloc&) {  // so little that not even a message could be written
  }
  Solution solution;
  solution.status = Status::out_of_memory;
  solution.message = "the memory limit was reached";
  return solution;
}

void Workbench::judge(const AssembledBlocks& blocks, const Solution& solution, Record& record) {
  record.verification = verify(*blocks.system, solution, reference());
  if (record.status != Status::ok) return;
  const WorstMeasure worst = worst_measure(*record.verification);
  if (!(worst.value <= options_.target_error)) {
    record.status = Status::inaccurate;
    record.status_reason = fmt::format("{} {:.2e} is above the target {:.0e}", worst.name,
                                       worst.value, options_.target_error);
  } else if (reference() == nullptr) {
    record.status = Status::inaccurate;
    record.status_reason = "its error is not known: " + no_reference_;
  } else if (record.verification->relative_to_loads) {
    record.status_reason = "next to no stress: errors are relative to the loads";
  }
}

Record Workbench::examine(const Method& method, const std::filesystem::path& fields) {
  const MeshSizes sizes = solved_sizes(*problem_);
  Record record;
  record.mesh = problem_->mesh.name;
  record.method = method.name;
  record.threads = options_.threads;
  record.n_phi = sizes.n_phi;
  record.n_f = sizes.n_f;
  record.n_c = sizes.n_c;
  record.stages = decide_stages(*problem_, method, !fields.empty());
  try {
    blocks(method.blocks);
  } catch (const std::exception& error) {
    record.status = Status::breakdown;
    record.status_reason = fmt::format("assembly: {}", error.what());
    return record;
  }
  const AssembledBlocks& assembled = blocks(method.blocks);
  record.assembly_samples_s = assembled.samples_s;
  record.blocks_heap_bytes = assembled.heap_bytes;
  record.assembly_peak_heap_bytes = assembled.peak_heap_bytes;

  Solution solution = solve(method, assembled, true);
  record.status = solution.status;
  record.status_reason = solution.message;
  record.storage_bytes = solution.storage_bytes;
  record.linear_iterations = solution.linear_iterations;
  record.contact_iterations = solution.contact_iterations;
  record.uzawa_iterations = solution.uzawa_iterations;
  if (options_.histories) record.histories = std::move(solution.histories);
  if (!solution.stress.empty()) {
    judge(assembled, solution, record);
    if (!fields.empty())
      write_fields(fields.parent_path(), fields.filename(), *assembled.system, solution);
  }
  return record;
}

void Workbench::measure_memory(const Method& method, Record& record) {
  const AssembledBlocks& assembled = blocks(method.blocks);
  malloc_trim(0);  // what earlier cases freed shall not count
  const bool rss_is_reset = rss::reset_peak();
  heap::reset_peak();
  const std::int64_t before = heap::live_bytes();
  const Solution solution = solve(method, assembled, false);
  const std::int64_t peak = heap::peak_bytes();
  if (rss_is_reset) record.peak_rss_bytes = rss::peak_bytes();
  record.peak_heap_bytes = if_probed(peak - before + assembled.heap_bytes.value_or(0));
  record.process_peak_heap_bytes = if_probed(heap::peak_ever_bytes());
}

double Workbench::measure_time(const Method& method, Record& record) {
  const AssembledBlocks& assembled = blocks(method.blocks);
  const auto start = std::chrono::steady_clock::now();
  const Solution solution = solve(method, assembled, false);
  const double spent = seconds_since(start);
  if (solution.status != Status::ok) {
    record.status = solution.status;
    record.status_reason = "in a timed run: " + solution.message;
    return spent;  // the time of a failure is no sample
  }
  record.samples_s.push_back(spent);
  record.stage_samples.push_back(solution.times);
  return spent;
}

}  // namespace airybench
