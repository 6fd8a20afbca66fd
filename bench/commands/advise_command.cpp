#include "bench/commands/commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <numeric>

#include "bench/commands/command_line.hpp"
#include "bench/commands/run_parts.hpp"
#include "bench/measure/environment.hpp"
#include "bench/plan/mesh_files.hpp"
#include "bench/records/csv.hpp"
#include "bench/records/record_files.hpp"
#include "bench/records/summary.hpp"
#include "bench/report/prediction.hpp"
#include "bench/run/adapted_scenes.hpp"
#include "bench/run/runner.hpp"
#include "bench/run/threads_at_hand.hpp"
#include "solvers/methods.hpp"
#include "support/atomic_file.hpp"
#include "support/called_as.hpp"
#include "support/shortened.hpp"
#include "support/text_table.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

constexpr const char* advise_footer = R"(
The mesh is adapted until the error is met; on what it becomes, methods are measured, as far as the budget goes.
Next to it is what refining everywhere would take: measured on the mesh as it is and refined once, forecast beyond by
power laws. The fastest row that meets the error is run again, with its fields. In OUT: advice.csv, records, meshes,
fields.

Exit status  0  a measured row meets the error
             1  none does
             2  wrong usage, or a file that cannot be used: one line on standard error

Examples
  {bench} advise --mesh=Mesh0 --error=0.5%
  {bench} advise --mesh=part.geo --scene=load.json --error=1% --out=results/part
)";

constexpr const char* candidates = "HYBRID,P2,BLIND:SCHUR,BLIND:SCHUR:REFINED,3STEPD";
constexpr const char* what_p2_lacks =
    "P2 gives displacements. Its stresses are not in equilibrium, within triangles and across "
    "their\n"
    "edges; those of the other methods are.\n\n";
constexpr const char* uniform_candidate = "HYBRID";

Options parse_advise(int argc, const char* const* argv, double& budget_s) {
  Options options;
  options.methods = candidates;
  options.out = "results/advice";
  options.timeout_s = 20;
  options.repetitions = 3;
  std::string error;
  CLI::App app("Which mesh and method give a total error, how long they take, in how much memory.",
               "{bench} advise");
  app.footer(advise_footer);
  add_one_body(app, options);
  app.add_option("--error", error, "total error, relative: 1%")->required();
  app.add_option("--method", options.methods, "to compare, by names or globs")
      ->capture_default_str();
  add_number(app, "--timeout", Least::above_zero, most_of_a_limit, options.timeout_s,
             "seconds that one solve may take");
  add_number(
      app, "--budget", Least::above_zero, most_of_a_limit, budget_s,
      "seconds for measuring methods; leaves out those that do not fit in by earlier records");
  add_memory_limit(app, options);
  app.add_option("--out", options.out, "folder of the output files")->capture_default_str();
  parse_command_line(app, argc, argv);
  const std::optional<AdaptGoal> goal = adapt_goal_of(error);
  if (!goal || !goal->error)
    throw UsageError(
        fmt::format("--error: {} (allowed: above 0% and below 100%, as 1%)", shortened(error)));
  options.adapt = {*goal};
  return options;
}

struct Advice {
  Record record;
  std::string basis, command;

  bool meets(double error) const {
    return record.status == Status::ok && record.error_total && *record.error_total <= error;
  }
  double whole_time_s() const {
    return record.time_s.value_or(INFINITY) + record.adapt_time_s.value_or(0);
  }
};

// The command reads the level's mesh file or, if is_adapted, adapts the given mesh again.
std::string command_of(const Options& options, const Record& r, bool is_adapted) {
  std::string text = called_as("bench") + " --mesh=";
  if (is_adapted || r.adapt_level == 0) {
    text += shell_word(options.meshes);
    for (const std::string& setting : options.model_settings) text += " " + shell_word(setting);
    if (!options.scenes.empty()) text += " --scene=" + shell_word(options.scenes.front().string());
  } else {
    const std::filesystem::path file = recorded_file(r.mesh_file, options.out);
    text += shell_word(file.string()) +
            " --scene=" + shell_word((file.parent_path() / (r.scene + ".json")).string());
  }
  if (is_adapted) text += fmt::format(" --adapt={},levels=last", text_of(options.adapt));
  return text + " --method=" + shell_word(r.method);
}

Advice advice_of(const Record& r, const Options& options, bool is_adapted) {
  Advice advice = {r, r.status == Status::skipped ? r.status_reason : "measured",
                   command_of(options, r, is_adapted)};
  if (!is_adapted) advice.record.adapt_time_s.reset();
  return advice;
}

std::optional<Advice> forecast_uniform(const Record& coarse, const Record& fine, double error) {
  constexpr double most_unknowns = 1e9;
  if (!coarse.error_total || !fine.error_total || !coarse.time_s || !fine.time_s ||
      !coarse.peak_heap_bytes || !fine.peak_heap_bytes || *fine.error_total >= *coarse.error_total)
    return {};
  const double per_step = static_cast<double>(*fine.n_phi) / static_cast<double>(*coarse.n_phi);
  const double gain = *fine.error_total / *coarse.error_total;
  const double steps = std::ceil(std::log(error / *fine.error_total) / std::log(gain));
  const double n_phi = static_cast<double>(*fine.n_phi) * std::pow(per_step, steps);
  if (steps < 1 || n_phi > most_unknowns) return {};
  const int n = static_cast<int>(n_phi);
  const auto at_n = [&](double of_coarse, double of_fine, double least_exponent) {
    const SizedValue first{static_cast<int>(*coarse.n_phi), of_coarse},
        second{static_cast<int>(*fine.n_phi), of_fine};
    const double exponent = std::max(*pooled_exponent({{first, second}}, n), least_exponent);
    return extrapolate({second}, n, exponent, 0).value;
  };
  // Small meshes cost more per unknown; beyond them, growth is at least proportional.
  const double proportional = 1, any = -std::numeric_limits<double>::infinity();
  Record forecast;
  forecast.status = Status::ok;
  forecast.mesh = fmt::format("refined {:g} times", steps + 1);
  forecast.method = fine.method;
  forecast.n_phi = n;
  forecast.error_total = at_n(*coarse.error_total, *fine.error_total, any);
  forecast.time_s = at_n(*coarse.time_s, *fine.time_s, proportional);
  forecast.peak_heap_bytes =
      std::llround(at_n(static_cast<double>(*coarse.peak_heap_bytes),
                        static_cast<double>(*fine.peak_heap_bytes), proportional));
  return Advice{forecast, "forecast", ""};
}

// Why a method is not worth a measurement next to the fastest one; empty: it is.
std::string why_hopeless(const Prediction& expected, const Prediction& fastest,
                         const Options& options) {
  constexpr double hopeless = 30;
  if (expected.timeout == LimitMark::above)
    return fmt::format("forecast: over --timeout={:g}", options.timeout_s);
  if (expected.memory_limit == LimitMark::above) return "forecast: over --memory-limit";
  if (!expected.time_s || !fastest.time_s) return "";
  const double ratio = expected.time_s->value / fastest.time_s->value;
  return ratio > hopeless ? fmt::format("forecast: {:.0f} times the fastest", ratio) : "";
}

// Removes hopeless cases, then the longest ones until earlier records say that the rest fits into
// the budget; keeps the shortest case and cases without records. Returns a row for each removed
// case.
std::vector<Advice> leave_out(std::vector<Case>& plan, const Options& options, double budget_s) {
  std::vector<Record> planned;
  for (const Case& c : plan) planned.push_back(blank_record(c, options));
  const std::vector<Record> past = read_committed_records(planned, options.out).records;
  const std::vector<Prediction> expected = forecast(planned, past, limits_of(options)).cases;
  std::vector<std::size_t> order(plan.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return expected[k].run_s.value_or(0); });
  std::vector<Advice> rows;
  std::vector<bool> stays(plan.size(), true);
  double spent_s = 0;
  for (const std::size_t k : order) {
    spent_s += expected[k].run_s.value_or(0);
    std::string why = why_hopeless(expected[k], expected[order.front()], options);
    if (why.empty() && spent_s > budget_s) why = "forecast: over --budget";
    stays[k] = why.empty() || k == order.front();
    if (stays[k]) continue;
    spent_s -= expected[k].run_s.value_or(0);
    Record& row = rows.emplace_back(Advice{planned[k], why, ""}).record;
    row.adapt_time_s.reset();
    if (expected[k].time_s) row.time_s = expected[k].time_s->value;
    row.status = Status::skipped;
  }
  std::size_t k = 0;
  std::erase_if(plan, [&](const Case&) { return !stays[k++]; });
  return rows;
}

// " (P2 ties with it: ...)" for methods whose times are not apart from the best row's; rows: it
// first.
std::string ties_of(const std::vector<Advice>& rows, double error) {
  const Record& best = rows.front().record;
  const auto shown = [](const Record& r) {
    return fmt::format("{} ± {}", show_seconds(r.time_s), show_seconds(r.time_mad_s));
  };
  std::string ties;
  for (const Advice& row : rows) {
    const Record& r = row.record;
    if (&row == &rows.front() || !row.meets(error) || r.mesh != best.mesh || !times_tie(best, r))
      continue;
    ties += fmt::format("{}{}, {}", ties.empty() ? "" : "; ", r.method, shown(r));
  }
  return ties.empty() ? "" : fmt::format(" ({}; ties with it: {})", shown(best), ties);
}

std::string table_of(const std::vector<Advice>& rows) {
  std::vector<std::vector<std::string>> cells = {
      {"mesh", "method", "n_phi", "error total", "time", "adapted in", "heap", "basis"}};
  for (const auto& [row, basis, command] : rows) {
    const bool has_basis = row.status == Status::ok || row.status == Status::skipped;
    cells.push_back({row.mesh, row.method, std::to_string(row.n_phi.value_or(0)),
                     show_error(row.error_total), show_seconds(row.time_s),
                     show_seconds(row.adapt_time_s), show_bytes(row.peak_heap_bytes),
                     has_basis ? basis : std::string(name_of(row.status))});
  }
  return aligned_table(cells, 2);
}

std::string csv_of(const std::vector<Advice>& rows) {
  std::string text =
      "mesh,method,n_phi,error_total,time_s,adapt_time_s,peak_heap_bytes,basis,status,command\n";
  const auto number = [](const auto& value) {
    return value ? fmt::format("{}", *value) : std::string();
  };
  for (const auto& [row, basis, command] : rows)
    text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", csv_quoted(row.mesh),
                        csv_quoted(row.method), row.n_phi.value_or(0), number(row.error_total),
                        number(row.time_s), number(row.adapt_time_s), number(row.peak_heap_bytes),
                        csv_cell(basis), name_of(row.status), csv_quoted(command));
  return text;
}

}  // namespace

int advise_command(int argc, const char* const* argv) {
  double budget_s = 60;
  const Options options = parse_advise(argc, argv, budget_s);
  require_threads(options.threads);
  check_takes_records(options.out);
  if (std::filesystem::exists(options.out)) check_can_write(options.out / "advice.csv");
  catch_interrupts();
  const PosedScene start = one_posed_scene(options);
  const std::vector<Method> chosen = select_methods(options.methods);
  const AdaptedScenes adapted = adapted_scenes(start, options);
  if (!adapted.why_not_reached.empty()) std::cerr << "note: " << adapted.why_not_reached << "\n";
  if (adapted.levels.empty()) return some_case_failed;

  const bool is_refined = adapted.levels.size() > 1;
  std::vector<Case> plan;
  if (is_refined)
    plan = plan_cases({adapted.levels.front(), refined_scene(adapted.levels.front(), options)},
                      select_methods(uniform_candidate));
  const std::size_t uniform = plan.size();
  std::vector<Case> compared = plan_cases({adapted.levels.back()}, chosen);
  const std::vector<Advice> left_out = leave_out(compared, options, budget_s);
  for (Case& c : compared) {
    c.number = static_cast<int>(plan.size()) + 1;
    plan.push_back(std::move(c));
  }
  set_threads(options.threads);
  const Context context = context_of_run(options);
  const std::vector<Record> records = run_cases(plan, options, context).records();

  const double goal = *options.adapt.front().error;
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
  rows.insert(rows.end(), left_out.begin(), left_out.end());
  fmt::print("\n{}\n", table_of(rows));
  if (std::ranges::any_of(rows, [](const Advice& row) { return row.record.method == "P2"; }))
    fmt::print("{}", what_p2_lacks);
  write_file_atomically(options.out / "advice.csv", csv_of(rows));
  if (!met) {
    fmt::print("no measured method meets {}\n", text_of(options.adapt));
    return some_case_failed;
  }
  const Record& best = rows.front().record;
  fmt::print("best: {}, {}{}:\n  {}\nalso in {}\n", best.mesh, best.method, ties_of(rows, goal),
             rows.front().command, (options.out / "advice.csv").string());

  const auto planned = std::ranges::find_if(plan, [&](const Case& c) {
    return c.method.name == best.method && mesh_name_of(c.posed.problem) == best.mesh;
  });
  Options with_fields = options;
  with_fields.fields = with_fields.append = true;
  with_fields.repetitions = 1;
  end_run(run_cases({*planned}, with_fields, context), options.out, true);
  return all_ok;
}

}  // namespace airybench
