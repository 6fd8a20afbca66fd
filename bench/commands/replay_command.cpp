#include "bench/commands/commands.hpp"

#include <fmt/format.h>

#include "bench/commands/command_line.hpp"
#include "bench/measure/environment.hpp"
#include "bench/plan/mesh_files.hpp"
#include "bench/plan/plan.hpp"
#include "bench/plan/scene_file.hpp"
#include "bench/records/record_files.hpp"
#include "bench/run/runner.hpp"
#include "bench/run/threads_at_hand.hpp"
#include "solvers/methods.hpp"
#include "support/lists.hpp"
#include "support/numbers.hpp"
#include "support/shortened.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

constexpr const char* replay_footer = R"(
RECORD is FOLDER:CASE or FOLDER:LINE, as in results/latest:Mesh0/default/3STEPD; a colon in the folder's
name is written \:. The mesh must be the file that the record was measured on, and this program the one that measured it.

Exit status  0  the same status, iterations and contact states as recorded
             1  one of these differs
             2  wrong usage, another mesh, another program: one line on standard error
)";

struct ReplayOptions {
  std::string record;         // FOLDER:CASE or FOLDER:LINE
  std::string folder, which;  // its two parts
  std::filesystem::path out = "results/replay";
  bool other_program = false;
};

ReplayOptions parse_replay(int argc, const char* const* argv) {
  ReplayOptions options;
  CLI::App app("Runs one recorded case again, with its settings.", "{bench} replay");
  app.footer(replay_footer);
  app.add_option("RECORD", options.record, "record of the case")->required();
  app.add_option("--out", options.out, "folder of the new record")->capture_default_str();
  app.add_flag("--other-program", options.other_program,
               "run it even if program, machine or settings differ from the record's");
  parse_command_line(app, argc, argv);
  const FirstItem folder = first_item(options.record, ':');
  options.folder = folder.item;
  options.which = folder.rest.value_or("");
  if (options.which.empty())
    throw UsageError(fmt::format("{}: which case? (allowed: FOLDER:CASE, FOLDER:LINE)",
                                 shortened(options.record)));
  return options;
}

Record find_record(const ReplayOptions& asked) {
  const std::vector<RecordLine> lines = lines_in(asked.folder);
  if (const std::optional<std::int64_t> line = parse_whole(asked.which)) {
    if (*line < 1 || *line > std::ssize(lines))
      throw UsageError(
          fmt::format("{}: line {} (allowed: 1 to {})", asked.record, *line, lines.size()));
    return lines[static_cast<std::size_t>(*line - 1)].record;
  }
  if (!case_name_of(asked.which))
    throw UsageError(fmt::format(
        "{}: '{}' is no case's name (allowed: MESH/SCENE/METHOD[/study=STUDY][/KNOB=VALUE]"
        "[/stop=paper], or a line's number)",
        shortened(asked.record), shortened(asked.which)));
  for (const RecordLine& one : lines)
    if (name_of(one.record).text() == asked.which) return one.record;
  throw UsageError(fmt::format("{}: no such case (the first is {})", asked.record,
                               lines.empty() ? "missing" : name_of(lines.front().record).text()));
}

void refuse_what_is_not_at_hand(const Record& record, const std::string& place) {
  if (!record.program.empty())
    throw UsageError(fmt::format("{}: {} is another program (allowed: bench's own methods)", place,
                                 record.method));
  if (!record.n_phi)
    throw UsageError(
        fmt::format("{}: a contact problem of --problem (allowed: cases with a mesh)", place));
}

template <typename Number>
void take(const Context& context, const std::string& key, Number& number) {
  const std::string word = context_word(context, key);
  if (word.empty()) return;
  const std::optional<double> value = parse_number(word);
  if (!value || !(*value > 0 && *value <= 1e18))
    throw FileError(fmt::format("context: {}: {} (allowed: a number above 0, up to 1e18)", key,
                                shortened(word)));
  number = static_cast<Number>(*value);
}

std::vector<int> thread_counts_of(const Context& context) {
  std::vector<int> counts;
  for (const std::string& word : split_list(context_word(context, "threads"))) {
    const std::int64_t count = parse_whole(word).value_or(0);
    if (count < 1 || count > max_threads)
      throw FileError(fmt::format("context: threads: {} (allowed: whole numbers from 1 to {})",
                                  shortened(word), max_threads));
    counts.push_back(static_cast<int>(count));
  }
  return counts;
}

Options options_of(const Record& record, const Context& context, std::filesystem::path out) {
  Options options;
  RunSettings& run = options.run;
  CaseSettings& asked = run.cases;
  Limits& limits = options.limits;
  options.output.folder = std::move(out);
  asked.threads = static_cast<int>(record.threads.value_or(1));
  asked.target_error = record.target_error.value_or(asked.target_error);
  if (!record.study.empty()) {
    const std::optional<Study> study = study_named(record.study);
    if (!study)
      throw FileError(fmt::format("the record's study {} is not there (bench/scenes/{}.json)",
                                  shortened(record.study), shortened(record.study)));
    run.study = *study;
  }
  // Each point of an accuracy study sets its stop.
  if (run.study.points != Study::Points::accuracy) asked.stop = record.stop;
  if (run.study.points == Study::Points::threads) {
    run.thread_counts = thread_counts_of(context);
    asked.threads = run.thread_counts.back();
  }
  if (run.study.name.empty()) asked.contact = record.contact_solver;
  limits.retry_noisy = record.retry_noisy;
  limits.tuning_budget_s = record.tuning_budget_s;
  limits.interleave = context_word(context, "interleaved") == "yes";
  take(context, "repetitions", limits.repetitions);
  take(context, "max_repetitions", limits.max_repetitions);
  take(context, "timeout_s", limits.timeout_s);
  take(context, "long_case_s", limits.long_case_s);
  if (!context_word(context, "others_s").empty())
    take(context, "others_s", limits.others_s.emplace());
  if (!context_word(context, "precision").empty())
    take(context, "precision", limits.precision.emplace());
  if (context_word(context, "memory_limit_bytes") != "none") {
    std::int64_t limit = 0;
    take(context, "memory_limit_bytes", limit);
    if (limit > 0) limits.memory_limit_bytes = limit;
  }
  return options;
}

// Older records have no mesh_file for meshes of the catalogue.
MeshFile mesh_of(const Record& record, const std::filesystem::path& folder) {
  const std::string recorded = record.mesh_file.empty() ? record.mesh + ".msh" : record.mesh_file;
  const std::filesystem::path file = recorded_file(recorded, folder);
  MeshFile mesh = read_mesh_file(file);
  if (mesh.sha256 != record.mesh_sha256)
    throw FileError(fmt::format("{}: is not the mesh of the record: its SHA-256 is {}, not {}",
                                file.string(), mesh.sha256, record.mesh_sha256));
  return mesh;
}

Case case_of(const Record& record, const std::string& place, const std::filesystem::path& folder,
             const Options& options) {
  MeshFile mesh = mesh_of(record, folder);
  const std::string definition = json_text(record.scene_definition);
  PosedScene posed{
      record.scene, record.scene_group, recorded_path(mesh.path, options.output.folder),
      mesh.sha256,  definition,         {}};
  Scene scene;
  if (definition != "{}") {
    scene = scene_of(definition, place + ": scene_definition");
    scene.name = record.scene;
  }
  posed.problem = pose_in_time(scene, record.scene, std::move(mesh.mesh), options.limits);
  for (const Case& c : plan_cases({posed}, select_methods(record.method), options.run))
    if (c.knob.name == record.knob && c.knob.value == record.knob_value &&
        c.settings.stop == record.stop &&
        (!record.contact_solver || c.settings.contact == record.contact_solver))
      return c;
  throw FileError(fmt::format("{}: this program has no such point of the study", record.method));
}

std::string text_of(const Record& record, const char* key) {
  const Json value = field_named(key).value(record);
  if (value.is_null()) return "-";
  if (value.is_number_float()) return fmt::format("{:.4g}", value.get<double>());
  return value.is_string() ? value.get<std::string>() : json_text(value);
}

// The printed fields, and whether they must be equal.
constexpr std::pair<const char*, bool> compared[] = {{"time_s", false},
                                                     {"peak_heap_bytes", false},
                                                     {"error_stress", false},
                                                     {"error_force", false},
                                                     {"status", true},
                                                     {"linear_iterations", true},
                                                     {"contact_iterations", true},
                                                     {"uzawa_iterations", true},
                                                     {"parameters", true},
                                                     {"n_open", true},
                                                     {"n_stick", true},
                                                     {"n_slip", true}};

}  // namespace

int replay_command(int argc, const char* const* argv) {
  const ReplayOptions asked = parse_replay(argc, argv);
  const Record record = find_record(asked);
  refuse_what_is_not_at_hand(record, asked.record);
  const Context& recorded = record.context;
  const Options options = options_of(record, recorded, asked.out);
  require_threads(options.run.cases.threads);
  set_threads(options.run.cases.threads);
  Context context = context_of_run(options);
  context.insert(recorded.begin(), recorded.end());  // keys that only that run has
  std::error_code error;
  if (std::filesystem::equivalent(asked.folder, asked.out, error))
    throw UsageError(
        fmt::format("--out: {} (allowed: another folder than the record's)", asked.out.string()));
  if (record.scene_definition.is_null() && record.scene != Scene().name)
    throw FileError(
        fmt::format("{}: the record lacks the definition of scene {}", asked.record, record.scene));
  const std::string differs = differences(recorded, context, Sameness::same_program);
  if (!differs.empty() && !asked.other_program)
    throw FileError(
        fmt::format("{}: was not measured by this program, or not so (recorded and "
                    "now): {} (--other-program runs it all the same)",
                    asked.record, differs));
  const Case planned = case_of(record, asked.record, asked.folder, options);
  catch_interrupts();
  const RunResult result = run_cases({planned}, options.limits, options.output, context);
  const Record now = result.record(0);
  bool same = true;
  fmt::print("{:<20}  {:>14}  {:>14}\n", name_of(record).text(), "recorded", "now");
  for (const auto& [key, must_be_same] : compared) {
    const std::string before = text_of(record, key), after = text_of(now, key);
    const bool is_other = must_be_same && before != after;
    same = same && !is_other;
    fmt::print("{:<20}  {:>14}  {:>14}{}\n", key, before, after, is_other ? "  differs" : "");
  }
  return same ? all_ok : some_case_failed;
}

}  // namespace airybench
