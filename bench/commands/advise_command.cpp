#include "bench/commands/advise_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "bench/adapting/adapted_scenes.hpp"
#include "bench/cases/mesh_files.hpp"
#include "bench/commands/command_line.hpp"
#include "bench/commands/posed_scenes.hpp"
#include "bench/exports/csv.hpp"
#include "bench/isolation/isolated_scene.hpp"
#include "bench/isolation/threads_at_hand.hpp"
#include "bench/measuring/environment.hpp"
#include "bench/running/runner.hpp"
#include "support/atomic_file.hpp"
#include "support/shortened.hpp"
#include "support/text_table.hpp"

namespace airybench {
namespace {

constexpr const char* advise_footer = R"(
The mesh is adapted until the error is met; on what it becomes, methods are measured. Beside it is what refining
everywhere would take: measured on the mesh as it is and refined once, forecast beyond by power laws. The fastest
row that meets the error is run again, with its fields. In OUT: advice.csv, records, meshes, fields.

Exit status  0  a measured row meets the error
             1  none does
             2  wrong usage, or a file that cannot be used: one line on standard error

Examples
  bench advise --mesh=Mesh0 --error=0.5%
  bench advise --mesh=part.msh --scene=load.json --error=1% --out=results/part
)";

constexpr const char* candidates = "HYBRID,P2,BLIND:SCHUR,BLIND:SCHUR:REFINED,3STEPD";
constexpr const char* uniform_candidate = "HYBRID";

Options parse_advise(int argc, const char* const* argv) {
  Options options;
  options.meshes.clear();
  options.out = "results/advice";
  options.timeout_s = 20;
  options.repetitions = 3;
  std::string error, scene;
  CLI::App app("Which mesh and method give a total error, how long they take, in how much memory.",
               "bench advise");
  app.footer(advise_footer);
  app.add_option("--mesh", options.meshes, "of the catalogue, or a file")->required();
  app.add_option("--scene", scene, "scene file; default: the documented tooth or rack");
  app.add_option("--error", error, "total error, relative: 1%")->required();
  app.add_option("--method", options.methods, "to compare, by names or globs")
      ->default_str(candidates);
  add_number(app, "--timeout", Least::above_zero, 1e9, options.timeout_s,
             "seconds that one solve may take");
  add_whole(
      app, "--memory-limit", 1, std::int64_t{1} << 40, 0,
      [&](std::int64_t MiB) { options.memory_limit_bytes = MiB * 1024 * 1024; },
      "MiB of heap that one solve may use");
  app.add_option("--out", options.out, "folder of the output files")->capture_default_str();
  app.add_option("--then", options.then, "as for a run");
  parse_command_line(app, argc, argv);
  options.adapt = adapt_goal_of(error);
  if (!options.adapt || !options.adapt->error)
    throw UsageError(
        fmt::format("--error: {} (allowed: above 0% and below 100%, as 1%)", shortened(error)));
  if (options.methods.empty()) options.methods = candidates;
  if (!scene.empty()) options.scenes = {scene};
  return options;
}

// A row of the advice.
struct Advice {
  std::string mesh, method, basis, command;
  std::int64_t n_phi = 0;
  std::optional<double> error_total, time_s, adapt_time_s;
  std::optional<std::int64_t> peak_heap_bytes;
  Status status = Status::ok;

  bool meets(double error) const {
    return status == Status::ok && error_total && *error_total <= error;
  }
  // With the adaptive loop, where there is one.
  double whole_time_s() const { return time_s.value_or(INFINITY) + adapt_time_s.value_or(0); }
};

// Of a level or of the refined mesh, as a file; of the best one from the start.
std::string command_of(const Options& options, const Record& r, bool is_adapted) {
  std::string text = "bench --mesh=";
  if (is_adapted || r.adapt_level == 0) {
    text += shell_word(options.meshes);
    if (!options.scenes.empty()) text += " --scene=" + shell_word(options.scenes.front().string());
  } else {
    const std::filesystem::path file = recorded_file(r.mesh_file, options.out);
    text += shell_word(file.string()) +
            " --scene=" + shell_word((file.parent_path() / (r.scene + ".json")).string());
  }
  if (is_adapted) text += fmt::format(" --adapt={} --levels=last", text_of(*options.adapt));
  return text + " --method=" + shell_word(r.method);
}

Advice advice_of(const Record& r, const Options& options, bool is_adapted) {
  return {.mesh = r.mesh,
          .method = r.method,
          .basis = "measured",
          .command = command_of(options, r, is_adapted),
          .n_phi = r.n_phi.value_or(0),
          .error_total = r.error_total,
          .time_s = r.time_s,
          .adapt_time_s = is_adapted ? r.adapt_time_s : std::nullopt,
          .peak_heap_bytes = r.peak_heap_bytes,
          .status = r.status};
}

// What refining everywhere takes, from the coarse mesh and the one refined once.
std::optional<Advice> forecast_uniform(const Record& coarse, const Record& fine, double error) {
  constexpr int most_steps = 12;
  if (!coarse.error_total || !fine.error_total || !coarse.time_s || !fine.time_s ||
      !coarse.peak_heap_bytes || !fine.peak_heap_bytes || *fine.error_total >= *coarse.error_total)
    return {};
  const double per_step = *fine.error_total / *coarse.error_total;
  const int steps =
      static_cast<int>(std::ceil(std::log(error / *fine.error_total) / std::log(per_step)));
  if (steps < 1 || steps > most_steps) return {};
  const double growth = std::pow(static_cast<double>(*fine.n_phi) / *coarse.n_phi, steps);
  // Small meshes are dear for their size: what grows less than in proportion there will not further
  // on.
  const auto at = [&](double of_coarse, double of_fine) {
    const double exponent =
        std::log(of_fine / of_coarse) / std::log(static_cast<double>(*fine.n_phi) / *coarse.n_phi);
    return of_fine * std::pow(growth, std::max(exponent, 1.0));
  };
  Advice advice;
  advice.mesh = fmt::format("refined {} times", steps + 1);
  advice.method = fine.method;
  advice.basis = "forecast";
  advice.n_phi = std::llround(static_cast<double>(*fine.n_phi) * growth);
  advice.error_total = *fine.error_total * std::pow(per_step, steps);
  advice.time_s = at(*coarse.time_s, *fine.time_s);
  advice.peak_heap_bytes = std::llround(
      at(static_cast<double>(*coarse.peak_heap_bytes), static_cast<double>(*fine.peak_heap_bytes)));
  return advice;
}

std::string table_of(const std::vector<Advice>& rows) {
  std::vector<std::vector<std::string>> cells = {
      {"mesh", "method", "n_phi", "error total", "time", "adapted in", "heap", "basis"}};
  for (const Advice& row : rows)
    cells.push_back({row.mesh, row.method, std::to_string(row.n_phi), show_error(row.error_total),
                     show_seconds(row.time_s), show_seconds(row.adapt_time_s),
                     show_bytes(row.peak_heap_bytes),
                     row.status == Status::ok ? row.basis : std::string(name_of(row.status))});
  return aligned_table(cells, 2);
}

std::string csv_of(const std::vector<Advice>& rows) {
  std::string text =
      "mesh,method,n_phi,error_total,time_s,adapt_time_s,peak_heap_bytes,basis,status,command\n";
  const auto number = [](const auto& value) {
    return value ? fmt::format("{}", *value) : std::string();
  };
  for (const Advice& row : rows)
    text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", csv_quoted(row.mesh),
                        csv_quoted(row.method), row.n_phi, number(row.error_total),
                        number(row.time_s), number(row.adapt_time_s), number(row.peak_heap_bytes),
                        row.basis, name_of(row.status), csv_quoted(row.command));
  return text;
}

}  // namespace

int advise_command(int argc, const char* const* argv) {
  const Options options = parse_advise(argc, argv);
  require_threads(options.threads);
  catch_interrupts();
  const std::vector<PosedScene> start = pose_all(options);
  if (start.size() != 1)
    throw UsageError(fmt::format("--mesh: {} (allowed: one mesh)", shortened(options.meshes)));
  const std::vector<Method> chosen = select_methods(options.methods);
  const AdaptedScenes adapted = adapted_scenes(start.front(), options);
  if (!adapted.why_not_reached.empty()) std::cerr << "note: " << adapted.why_not_reached << "\n";
  if (adapted.levels.empty()) return some_case_failed;

  const bool is_refined = adapted.levels.size() > 1;
  std::vector<Case> plan;
  if (is_refined)
    plan = plan_cases({adapted.levels.front(), refined_scene(adapted.levels.front(), options)},
                      select_methods(uniform_candidate));
  const std::size_t uniform = plan.size();
  for (Case& c : plan_cases({adapted.levels.back()}, chosen)) {
    c.number += static_cast<int>(uniform);
    plan.push_back(std::move(c));
  }
  set_threads(options.threads);
  const Context context = context_of_run(options);
  const std::vector<Record> records = run_cases(plan, options, context).records;

  const double goal = *options.adapt->error;
  std::vector<Advice> rows;
  for (std::size_t k = uniform; k < records.size(); ++k)
    rows.push_back(advice_of(records[k], options, is_refined));
  std::ranges::stable_sort(
      rows, {}, [&](const Advice& row) { return std::pair(!row.meets(goal), row.whole_time_s()); });
  const bool met = rows.front().meets(goal);
  for (std::size_t k = 0; k < uniform; ++k) rows.push_back(advice_of(records[k], options, false));
  if (is_refined)
    if (const auto forecast = forecast_uniform(records[0], records[1], goal))
      rows.push_back(*forecast);
  fmt::print("\n{}\n", table_of(rows));
  write_file_atomically(options.out / "advice.csv", csv_of(rows));
  if (!met) {
    fmt::print("no measured method meets {}\n", text_of(*options.adapt));
    return some_case_failed;
  }
  fmt::print("best: {}, {}:\n  {}\nalso in {}\n", rows.front().mesh, rows.front().method,
             rows.front().command, (options.out / "advice.csv").string());

  const auto best = std::ranges::find_if(plan, [&](const Case& c) {
    return c.method.name == rows.front().method && c.posed.problem->mesh.name == rows.front().mesh;
  });
  Options with_fields = options;
  with_fields.fields = with_fields.append = true;
  with_fields.repetitions = 1;
  run_cases({*best}, with_fields, context);
  run_after(options.then, options.out);
  return all_ok;
}

}  // namespace airybench
