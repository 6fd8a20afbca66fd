#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>

#include "bench/commands/command_line.hpp"
#include "bench/commands/commands.hpp"
#include "bench/commands/part_solution.hpp"
#include "bench/commands/run_parts.hpp"
#include "bench/measure/environment.hpp"
#include "bench/records/case_name.hpp"
#include "bench/records/summary.hpp"
#include "bench/report/part_table.hpp"
#include "bench/run/runner.hpp"
#include "bench/run/threads_at_hand.hpp"
#include "support/atomic_file.hpp"
#include "support/called_as.hpp"
#include "support/folder_lock.hpp"
#include "support/shortened.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

constexpr const char* solve_footer = R"(
MODEL is a mesh or a Gmsh model; an input deck (.inp) contains its scene. The mesh is adapted to the total error (relative, in energy). Then
it is refined at the largest stress, if that is bounded, until its uncertainty is below twice the error, a finer mesh reduces it by less
than a tenth, or five more meshes are done. With :force or :pressure half the interval of F_n or of the largest pressure must be that
narrow, of all faces together and of each that carries more than 1 % of the load; it ends after five rounds of finer meshes, or where
two hardly narrow it. Where faces slip, and eight load steps change the stresses by more than the error, the load is applied
in eight; --steps fixes their number.
In OUT: the picture figures/part.png, fields (NAME.faces.csv, NAME.vtu, NAME.answer.json), meshes and
records; with --html also part.html, one self-contained page with the picture and all that is printed.

Exit status  0  the error is met
             1  it is not, or the case is not ok
             2  wrong usage, or a file that cannot be used: one line on standard error

Examples
  {bench} solve part.inp
  {bench} solve part.geo load.json --error=0.5%
  {bench} solve part.geo load.json --error=1%:pressure --steps=10 --html
)";

PartGoal goal_of(const std::string& text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const std::string word = colon == text.size() ? "energy" : text.substr(colon + 1);
  const std::optional<AdaptGoal> goal = adapt_goal_of(text.substr(0, colon));
  if (goal && goal->error)
    for (const auto& [name, quantity] : {std::pair("energy", PartQuantity::energy),
                                         {"force", PartQuantity::force},
                                         {"pressure", PartQuantity::pressure}})
      if (word == name) return {*goal->error, quantity};
  throw UsageError(
      fmt::format("--error: {} (allowed: above 0% and below 100%, as 1%, 1%:force, 1%:pressure)",
                  shortened(text)));
}

Options parse_solve(int argc, const char* const* argv, PartGoal& goal, bool& html) {
  Options options = options_of_part();
  options.output.folder = "results/solve";
  options.run.cases.picture = options.run.cases.in_eight_steps = options.run.needs_scene = true;
  std::string error = "1%", degree = "auto";
  CLI::App app("Forces, pressure, stress and displacement of a part, each with its possible error.",
               "{bench} solve");
  app.footer(solve_footer);
  add_part(app, options.run);
  app.add_option("--error", error, "total error, relative: 1%, 1%:force, 1%:pressure")
      ->capture_default_str();
  app.add_option("--degree", degree, "degree of the stresses: 1 to 4, auto")->capture_default_str();
  add_number(app, "--timeout", Least::above_zero, max_limit, options.limits.timeout_s,
             "limit of one solve in seconds");
  add_memory_limit(app, options.limits);
  app.add_flag("--html", html, "also write a page, OUT/part.html");
  app.add_option("--out", options.output.folder, "folder of the output files")
      ->capture_default_str();
  parse_command_line(app, argc, argv);
  goal = goal_of(error);
  ask_for(goal, degree, options);
  return options;
}

// "plane stress; Eall: E 70000 MPa, ν 0.33".
std::string assumptions_of(const Problem& problem) {
  std::string bodies;
  bool is_strain = false;
  for (std::size_t k = 0; k < problem.compliance.size(); ++k) {
    const Eigen::Matrix3d& C = problem.compliance[k];
    const double across = problem.poisson_zz[k], poisson = across > 0 ? across : -C(0, 1) / C(0, 0);
    is_strain |= across > 0;
    bodies += fmt::format("; {}: E {:.6g} MPa, ν {:.4g}", problem.mesh.body_names[k],
                          (1 - across * across) / C(0, 0), poisson);
  }
  return fmt::format("{}: plane {}, forces for a thickness of 1 mm{}", problem.mesh.name,
                     is_strain ? "strain" : "stress", bodies);
}

// Passes on what is printed to a stream, and keeps its notes.
class KeptNotes : std::streambuf {
 public:
  explicit KeptNotes(std::ostream& stream) : stream_(stream), next_(stream.rdbuf(this)) {}
  ~KeptNotes() override { stream_.rdbuf(next_); }
  KeptNotes(const KeptNotes&) = delete;
  KeptNotes& operator=(const KeptNotes&) = delete;
  std::vector<std::string> notes() const {
    std::vector<std::string> notes;
    std::istringstream lines(printed_);
    const std::string start = "note: ";
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with(start)) notes.push_back(line.substr(start.size()));
    return notes;
  }

 private:
  int_type overflow(int_type c) override {
    printed_ += static_cast<char>(c);
    return next_->sputc(static_cast<char>(c));
  }
  int sync() override { return next_->pubsync(); }

  std::ostream& stream_;
  std::streambuf* next_;
  std::string printed_;
};

std::string text_of(const Reached& reached) {
  const std::string of = reached.of.empty() ? "" : " of " + reached.of;
  if (!reached.error) return fmt::format("this quantity{} has no interval", of);
  return fmt::format("{:.3g} %{}", 100 * *reached.error, of);
}

}  // namespace

int solve_command(int argc, const char* const* argv) {
  PartGoal goal;
  bool html = false;
  const Options options = parse_solve(argc, argv, goal, html);
  check_takes_records(options.output.folder);
  catch_interrupts();
  const KeptNotes said(std::cerr);
  const PosedScene start = one_posed_scene(options);
  make_folder(options.output.folder);
  const FolderLock lock(options.output.folder);  // its meshes and fields are read again
  set_threads(options.run.cases.threads);
  const std::optional<SolvedPart> answer = solved_part(start, options, goal);
  if (!answer) return some_case_failed;
  const Record& record = answer->record;
  const std::string assumptions = assumptions_of(*start.body());
  PartReport report = part_report(record, answer->part);
  const Reached now = reached(*answer, goal.of);
  const bool is_met = meets(now.error, goal.error) && record.status == Status::ok;
  if (!is_met && record.status == Status::ok)
    report.emplace_back(fmt::format("note: the error asked for, {:g} %, is not met: {}",
                                    100 * goal.error, text_of(now)));
  fmt::print("\n{}\n\n{}", assumptions, text_of(report));
  if (!answer->part.is_null()) {
    fmt::print("faces: {0}.faces.csv\nParaView: {0}.vtu\n", answer->fields.string());
    const Json shown = {{"name", start.body()->mesh.name},
                        {"case", answer->fields.filename().string()},
                        {"assumptions", assumptions},
                        {"notes", said.notes()},
                        {"largest_pressure_is", record.largest_pressure_is},
                        {"error_total", or_null(record.error_total)},
                        {"report", to_json(report)}};
    // After the records: where these are newer, a later run has written them.
    write_file_atomically(options.output.folder / "part.json", json_text(shown));
    const std::vector<std::string> drawn_with(html ? 1 : 0, "--html");
    if (!leave_to_draw(options.output.folder, drawn_with))
      fmt::print("a picture: {} figures {} {}\n", called_as("run"),
                 shell_word(options.output.folder.string()), fmt::join(drawn_with, " "));
  }
  return is_met ? all_ok : some_case_failed;
}

}  // namespace airybench
