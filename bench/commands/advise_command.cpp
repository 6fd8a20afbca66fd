#include "bench/commands/commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
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
#include "support/folder_lock.hpp"
#include "support/shortened.hpp"
#include "support/text_table.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

constexpr const char* advise_footer = R"(
The mesh is adapted until the error is met; then methods are measured on it, as far as the budget allows. Uniform refinement is
measured on the given mesh and on it refined once; beyond that time is scaled by n log n, and the error by a power law, which is
optimistic. On a body with curved sides HYBRID of the degree of --degree=auto is measured, too, on a mesh that it adapted. The fastest
row that meets the error is run again, with its fields. In OUT: advice.csv, records, meshes, fields.

Exit status  0  a measured row meets the error
             1  none does
             2  wrong usage, or a file that cannot be used: one line on standard error

Examples
  {bench} advise --mesh=Mesh0 --error=0.5%
  {bench} advise --mesh=part.geo --scene=load.json --error=1% --out=results/part
)";

constexpr const char* candidates = "HYBRID,P2,BLIND:SCHUR,BLIND:SCHUR:REFINED,3STEPD";
constexpr const char* what_displacements_lack =
    "{} gives displacements. Its stresses are not in equilibrium, within triangles and across "
    "their\n"
    "edges; those of the other methods are.\n\n";
constexpr const char* uniform_candidate = "HYBRID";

Options parse_advise(int argc, const char* const* argv, double& budget_s) {
  Options options;
  options.run.methods = candidates;
  options.output.folder = "results/advice";
  options.limits.timeout_s = 20;
  options.limits.repetitions = fewest_to_tell_apart;
  std::string error;
  CLI::App app("Which mesh and method give a total error, how long they take, in how much memory.",
               "{bench} advise");
  app.footer(advise_footer);
  add_one_body(app, options.run);
  app.add_option("--error", error, "total error, relative: 1%")->required();
  app.add_option("--method", options.run.methods, "methods to compare: names or globs")
      ->capture_default_str();
  add_number(app, "--timeout", Least::above_zero, max_limit, options.limits.timeout_s,
             "limit of one solve in seconds");
  add_number(
      app, "--budget", Least::above_zero, max_limit, budget_s,
      "seconds for measuring methods; leaves out those that do not fit in by earlier records");
  add_memory_limit(app, options.limits);
  app.add_option("--out", options.output.folder, "folder of the output files")
      ->capture_default_str();
  parse_command_line(app, argc, argv);
  const std::optional<AdaptGoal> goal = adapt_goal_of(error);
  if (!goal || !goal->error)
    throw UsageError(
        fmt::format("--error: {} (allowed: above 0% and below 100%, as 1%)", shortened(error)));
  options.run.adapt.goals = {*goal};
  return options;
}

struct Advice {
  Record record;
  std::string basis, command;

  bool meets(double error) const {
    return record.status == Status::ok && airybench::meets(record.error_total, error);
  }
  double whole_time_s() const {
    return record.time_s.value_or(INFINITY) + record.adapt_time_s.value_or(0);
  }
};

// The command reads the level's mesh file or, if is_adapted, adapts the given mesh again.
std::string command_of(const Options& options, const Record& r, bool is_adapted) {
  std::string text = called_as("bench") + " --mesh=";
  if (is_adapted || r.adapt_level == 0) {
    text += shell_word(options.run.meshes);
    for (const std::string& setting : options.run.model_settings) text += " " + shell_word(setting);
    if (!options.run.scenes.empty())
      text += " --scene=" + shell_word(options.run.scenes.front().string());
  } else {
    const std::filesystem::path file = recorded_file(r.mesh_file, options.output.folder);
    const std::string start = r.mesh.substr(0, r.mesh.rfind('+'));  // as adapted_scenes.hpp has it
    text += shell_word(file.string()) +
            " --scene=" + shell_word((file.parent_path() / start / (r.scene + ".json")).string());
  }
  if (is_adapted) {
    text += fmt::format(" --adapt={},levels=last", text_of(options.run.adapt.goals));
    if (options.run.adapt.by != Adaptation().by) text += ",by=" + options.run.adapt.by;
  }
  return text + " --method=" + shell_word(r.method);
}

Advice advice_of(const Record& r, const Options& options, bool is_adapted) {
  Advice advice = {r, r.status == Status::skipped ? r.status_reason : "measured",
                   command_of(options, r, is_adapted)};
  if (!is_adapted) advice.record.adapt_time_s.reset();
  return advice;
}

// Degree 1 takes curved sides for their chords and is of order 1.5 in energy there; higher degrees
// follow them.
struct OfCurves {
  Options options;
  AdaptedScenes adapted;
  std::vector<Case> cases;

  OfCurves(const PosedScene& start, const Options& asked) : options(asked) {
    const auto is_curved = [](const BoundaryEdge& edge) { return !edge.curve.is_straight(); };
    if (asked.run.methods != candidates ||
        std::ranges::none_of(start.body()->mesh.boundary, is_curved))
      return;
    read_degree("auto", false, options.run);
    adapted = adapted_scenes(start, options);
    if (!adapted.levels.empty())
      cases = plan_cases({adapted.levels.back()}, select_methods(options.run.methods), options.run);
  }
  bool is_refined() const { return adapted.levels.size() > 1; }
  bool has(const Record& record) const {
    return !cases.empty() && record.mesh == cases.front().posed.body()->mesh.name;
  }
};

// Refining uniformly makes four triangles and four inner edges of each triangle, two of each edge:
//   n_φ(k) = a 4^k + b 2^k + constant.
double unknowns_after(const Record& coarse, const Record& fine, double steps) {
  const double n_0 = static_cast<double>(*coarse.n_phi), n_1 = static_cast<double>(*fine.n_phi);
  const double a = (n_1 - 2 * n_0) / 2, b = n_0 - a;
  return a * std::pow(4, steps) + b * std::pow(2, steps);
}

// What refining everywhere until the error is met would take. Its error is the power law of the
// two.
std::optional<Advice> scaled_uniform(const Record& coarse, const Record& fine, double error) {
  constexpr double max_unknowns = 1e9;
  if (!coarse.error_total || !fine.error_total || *fine.error_total >= *coarse.error_total)
    return {};
  const double gain = *fine.error_total / *coarse.error_total;
  const double more = std::ceil(std::log(error / *fine.error_total) / std::log(gain));
  const double n_phi = unknowns_after(coarse, fine, 1 + more);
  if (more < 1 || !(n_phi < max_unknowns)) return {};
  Advice advice{fine, fmt::format("{} scaled by n log n, the error at best", fine.mesh), ""};
  Record& scaled = advice.record;
  scaled.mesh =
      fmt::format("{}+refine{:g}", coarse.mesh.substr(0, coarse.mesh.rfind('+')), 1 + more);
  scaled.n_phi = std::llround(n_phi);
  scaled.error_total = *fine.error_total * std::pow(gain, more);
  scaled.adapt_time_s.reset();
  const double times = growth(*fine.n_phi, *scaled.n_phi);
  if (scaled.time_s) *scaled.time_s *= times;
  if (scaled.peak_heap_bytes)
    scaled.peak_heap_bytes = std::llround(times * static_cast<double>(*scaled.peak_heap_bytes));
  return advice;
}

// Why a method is not worth a measurement next to the fastest one; empty: it is.
std::string why_hopeless(const Prediction& expected, const Prediction& fastest, double timeout_s) {
  constexpr double hopeless = 30;
  if (expected.timeout == LimitMark::above)
    return fmt::format("forecast: over --timeout={:g}", timeout_s);
  if (expected.memory_limit == LimitMark::above) return "forecast: over --memory-limit";
  if (!expected.time_s || !fastest.time_s) return "";
  const double ratio = expected.time_s->value / fastest.time_s->value;
  return ratio > hopeless ? fmt::format("forecast: {:.0f} times the fastest", ratio) : "";
}

// Removes hopeless cases, then the longest ones until earlier records say that the rest fits into
// the budget; keeps the shortest case that is forecast, and cases without records. Returns a row
// for each removed case.
std::vector<Advice> leave_out(std::vector<Case>& plan, const Limits& limits, double budget_s,
                              const std::vector<Record>& past) {
  std::vector<Record> planned;
  for (const Case& c : plan) planned.push_back(blank_record(c, limits));
  const std::vector<Prediction> expected = forecast(planned, past, limits_of(limits, plan)).cases;
  std::vector<std::size_t> order(plan.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return expected[k].run_s.value_or(0); });
  const auto forecast_one =
      std::ranges::find_if(order, [&](std::size_t k) { return expected[k].time_s.has_value(); });
  const std::size_t shortest = forecast_one == order.end() ? order.front() : *forecast_one;
  std::vector<Advice> rows;
  std::vector<bool> stays(plan.size(), true);
  double spent_s = 0;
  for (const std::size_t k : order) {
    spent_s += expected[k].run_s.value_or(0);
    std::string why = why_hopeless(expected[k], expected[shortest], limits.timeout_s);
    if (why.empty() && spent_s > budget_s) why = "forecast: over --budget";
    stays[k] = why.empty() || k == shortest;
    if (stays[k]) continue;
    spent_s -= expected[k].run_s.value_or(0);
    Record& row = rows.emplace_back(Advice{planned[k], why, ""}).record;
    row.adapt_time_s.reset();
    if (expected[k].time_s) row.time_s = expected[k].time_s->value;
    row.conclude({Status::skipped, ""});
  }
  std::size_t k = 0;
  std::erase_if(plan, [&](const Case&) { return !stays[k++]; });
  return rows;
}

// " (...; ties with it: P2, ...)" for methods whose times are not apart from the best row's; rows:
// it first. Of few samples, times that overlap do not make a tie.
std::string ties_of(const std::vector<Advice>& rows, double error) {
  const Record& best = rows.front().record;
  const auto shown = [](const Record& r) {
    return fmt::format("{} ± {}", show_seconds(r.time_s), show_seconds(r.time_mad_s));
  };
  std::string ties, unclear;
  for (const Advice& row : rows) {
    const Record& r = row.record;
    if (&row == &rows.front() || !row.meets(error) || r.mesh != best.mesh) continue;
    if (has_few_samples(best) || has_few_samples(r))
      unclear += fmt::format("{}{}", unclear.empty() ? "" : ", ", r.method);
    else if (times_tie(best, r))
      ties += fmt::format("{}{}, {}", ties.empty() ? "" : "; ", r.method, shown(r));
  }
  if (!ties.empty()) ties = fmt::format(" ({}; ties with it: {})", shown(best), ties);
  if (!unclear.empty()) ties += fmt::format(" (too few samples to compare with: {})", unclear);
  return ties;
}

std::string table_of(const std::vector<Advice>& rows) {
  std::vector<std::vector<std::string>> cells = {
      {"mesh", "method", "n_phi", "error total", "time", "adaptive loop", "heap", "basis"}};
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
  require_threads(options.run.cases.threads);
  check_takes_records(options.output.folder);
  if (std::filesystem::exists(options.output.folder))
    check_can_write(options.output.folder / "advice.csv");
  catch_interrupts();
  const PosedScene start = one_posed_scene(options);
  make_folder(options.output.folder);
  const FolderLock lock(options.output.folder);  // its meshes are read again
  const std::vector<Method> chosen = select_methods(options.run.methods);
  const AdaptedScenes adapted = adapted_scenes(start, options);
  const OfCurves of_curves(start, options);
  for (const AdaptedScenes* scenes : {&adapted, &of_curves.adapted})
    if (!scenes->why_not_reached.empty()) std::cerr << "note: " << scenes->why_not_reached << "\n";
  if (adapted.levels.empty()) return some_case_failed;

  const bool is_refined = adapted.levels.size() > 1;
  set_threads(options.run.cases.threads);
  const Context context = context_of_run(options);
  std::vector<Case> compared = plan_cases({adapted.levels.back()}, chosen, options.run);
  compared.insert(compared.end(), of_curves.cases.begin(), of_curves.cases.end());
  std::vector<Record> past =
      read_committed_records({blank_record(compared.front(), options.limits)},
                             options.output.folder)
          .records;
  std::vector<Case> refined;
  std::vector<Record> uniform;
  Output next = options.output;
  if (is_refined) {
    refined = plan_cases({adapted.levels.front(), refined_scene(adapted.levels.front(), options)},
                         select_methods(uniform_candidate), options.run);
    uniform = run_cases(refined, options.limits, options.output, context).records();
    next.append = true;
    const double factor = time_of_machine(uniform.back(), past);
    for (Record& record : past)
      for (std::optional<double>* time : {&record.time_s, &record.extrapolated_time_s})
        if (*time) **time *= factor;
  }
  const std::vector<Advice> left_out = leave_out(compared, options.limits, budget_s, past);
  std::vector<Record> records = run_cases(compared, options.limits, next, context).records();

  const double goal = *options.run.adapt.goals.front().error;
  std::vector<Advice> rows;
  for (const Record& record : records)
    rows.push_back(of_curves.has(record)
                       ? advice_of(record, of_curves.options, of_curves.is_refined())
                       : advice_of(record, options, is_refined));
  std::ranges::stable_sort(rows, {}, &Advice::whole_time_s);
  for (const Record& record : uniform) rows.push_back(advice_of(record, options, false));
  std::ranges::stable_sort(rows, {}, [&](const Advice& row) {
    return std::pair(!row.meets(goal), row.meets(goal) ? row.whole_time_s() : 0);
  });
  const bool met = rows.front().meets(goal);
  if (is_refined)
    if (const auto scaled = scaled_uniform(uniform[0], uniform[1], goal)) rows.push_back(*scaled);
  rows.insert(rows.end(), left_out.begin(), left_out.end());
  fmt::print("\n{}\n", table_of(rows));
  const auto in_displacements = std::ranges::find_if(rows, [](const Advice& row) {
    return row.record.in_displacements && row.record.program.empty();
  });
  if (in_displacements != rows.end())
    fmt::print(what_displacements_lack, in_displacements->record.method);
  write_file_atomically(options.output.folder / "advice.csv", csv_of(rows));
  if (!met) {
    fmt::print("no measured method meets {}\n", text_of(options.run.adapt.goals));
    return some_case_failed;
  }
  const Record& best = rows.front().record;
  fmt::print("best: {}, {}{}:\n  {}\nalso in {}\n", best.mesh, best.method, ties_of(rows, goal),
             rows.front().command, (options.output.folder / "advice.csv").string());

  compared.insert(compared.end(), refined.begin(), refined.end());
  Case with_fields = *std::ranges::find_if(compared, [&](const Case& c) {
    return c.method.name == best.method && mesh_name_of(c.posed.problem) == best.mesh;
  });
  with_fields.settings.fields = true;
  Limits once = options.limits;
  once.repetitions = 1;
  next.append = true;
  end_run(run_cases({with_fields}, once, next, context), options.output.folder, true);
  return all_ok;
}

}  // namespace airybench
