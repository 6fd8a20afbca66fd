#include <fmt/format.h>

#include <utility>

#include "bench/commands/command_line.hpp"
#include "bench/commands/commands.hpp"
#include "bench/commands/planned_cases.hpp"
#include "bench/plan/stages.hpp"
#include "support/errors.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

void print_stages(const std::vector<Case>& plan) {
  for (const Case& c : plan) {
    const MeshSizes sizes = solved_sizes(c.posed.problem);
    const std::string of_body = body_of(c.posed.problem) == nullptr
                                    ? ""
                                    : fmt::format("n_phi {}, n_f {}, ", sizes.n_phi, sizes.n_f);
    fmt::print("[{}/{}] {}  {}n_c {}\n", c.number, plan.size(), c.name().text(), of_body,
               sizes.n_c);
    for (const StageDecision& decision : decide_stages(c.posed.problem, c.method, false))
      fmt::print("    {:<9} {}{}{}\n", decision.run ? "run" : "left out", decision.stage,
                 decision.run ? "" : ": ", decision.reason);
  }
}

}  // namespace

int explain_command(int argc, const char* const* argv) {
  Options options = parse_options(argc, argv, Asked::explanation);
  require_standard_output();
  const bool is_forecast = std::exchange(options.dry_run, true);
  const std::vector<Case> plan = planned_cases(options).part;
  print_stages(plan);
  if (is_forecast) print_forecast(plan, options);
  return all_ok;
}

}  // namespace airybench
