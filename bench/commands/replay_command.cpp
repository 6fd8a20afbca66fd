#include "bench/commands/replay_command.hpp"

#include <fmt/format.h>

#include "bench/commands/command_line.hpp"
#include "bench/measure/environment.hpp"
#include "bench/plan/mesh_files.hpp"
#include "bench/plan/plan.hpp"
#include "bench/plan/scene_file.hpp"
#include "bench/records/record_files.hpp"
#include "bench/run/isolated_scene.hpp"
#include "bench/run/runner.hpp"
#include "bench/run/threads_at_hand.hpp"
#include "solvers/methods.hpp"
#include "support/lists.hpp"
#include "support/numbers.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

constexpr const char* replay_footer = R"(
RECORD is FOLDER:CASE or FOLDER:LINE, as in results/latest:Mesh0/default/3STEPD; a colon in the folder's
name is written \:. The mesh must be the file that the record was measured on, and this program the one that measured it.

Exit status  0  the same status, iterations and contact states as recorded
             1  something of these is another
             2  wrong usage, another mesh, another program: one line on standard error
)";

struct ReplayOptions {
  std::string record;
  std::filesystem::path out = "results/replay";
  bool other_program = false;
};

ReplayOptions parse_replay(int argc, const char* const* argv) {
  ReplayOptions options;
  CLI::App app("Runs one recorded case again, as it was run then.", "bench replay");
  app.footer(replay_footer);
  app.add_option("RECORD", options.record, "which")->required();
  app.add_option("--out", options.out, "folder of the new record")->capture_default_str();
  app.add_flag("--other-program", options.other_program,
               "although program, machine or settings are not the record's");
  parse_command_line(app, argc, argv);
  return options;
}

struct FolderAndCase {
  std::string folder, which;
};
FolderAndCase folder_and_case(const std::string& name) {
  const FirstItem folder = first_item(name, ':');
  return {folder.item, std::string(folder.rest.value_or(""))};
}

Record find_record(const std::string& name) {
  const auto [folder, which] = folder_and_case(name);
  if (which.empty())
    throw UsageError(
        fmt::format("{}: which case? (allowed: FOLDER:CASE, FOLDER:LINE)", shortened(name)));
  const std::vector<RecordLine> lines = lines_in(folder);
  if (const std::optional<std::int64_t> line = parse_whole(which)) {
    if (*line < 1 || *line > static_cast<std::int64_t>(lines.size()))
      throw UsageError(fmt::format("{}: line {} (allowed: 1 to {})", name, *line, lines.size()));
    return lines[static_cast<std::size_t>(*line - 1)].record;
  }
  if (!case_name_of(which))
    throw UsageError(fmt::format(
        "{}: '{}' is no case's name (allowed: MESH/SCENE/METHOD[/study=STUDY][/KNOB=VALUE]"
        "[/stop=paper], or a line's number)",
        shortened(name), shortened(which)));
  for (const RecordLine& one : lines)
    if (name_of(one.record).text() == which) return one.record;
  throw UsageError(fmt::format("{}: no such case (the first is {})", name,
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

double setting(const Context& context, const std::string& key, double otherwise) {
  const std::string word = context_word(context, key);
  if (word.empty()) return otherwise;
  const std::optional<double> value = parse_number(word);
  if (!value || !(*value > 0 && *value <= 1e18))
    throw FileError(fmt::format("context: {}: {} (allowed: a number above 0, up to 1e18)", key,
                                shortened(word)));
  return *value;
}

// Of the run of a scaling study: "1,2,4".
std::vector<int> thread_counts_of(const Context& context) {
  std::vector<int> counts;
  for (const std::string& word : split_list(context_word(context, "threads"))) {
    const std::int64_t count = parse_whole(word).value_or(0);
    if (count < 1 || count > most_threads)
      throw FileError(fmt::format("context: threads: {} (allowed: whole numbers from 1 to {})",
                                  shortened(word), most_threads));
    counts.push_back(static_cast<int>(count));
  }
  return counts;
}

Options options_of(const Record& record, const Context& context, std::filesystem::path out) {
  Options options;
  options.out = std::move(out);
  options.threads = static_cast<int>(record.threads.value_or(1));
  options.target_error = record.target_error.value_or(options.target_error);
  if (record.study == name_of(Study::error))
    options.study = Study::error;  // whose points have stops of their own
  else
    options.stop = record.stop;
  if (record.study != name_of(Study::error)) options.study = study_of(record.study);
  if (options.study == Study::scaling) {
    options.thread_counts = thread_counts_of(context);
    options.threads = options.thread_counts.back();
  }
  if (options.study == Study::none && record.contact_solver)
    options.contact = *record.contact_solver;
  options.repetitions = static_cast<int>(setting(context, "repetitions", options.repetitions));
  options.precision = record.precision;
  options.retry_noisy = record.retry_noisy;
  options.tuning_budget_s = record.tuning_budget_s;
  options.max_repetitions =
      static_cast<int>(setting(context, "max_repetitions", options.max_repetitions));
  const auto interleaved = context.find("interleaved");
  options.interleave = interleaved != context.end() && interleaved->second == "yes";
  options.timeout_s = setting(context, "timeout_s", options.timeout_s);
  options.long_case_s = setting(context, "long_case_s", options.long_case_s);
  if (context_word(context, "memory_limit_bytes") != "none")
    if (const double limit = setting(context, "memory_limit_bytes", 0); limit > 0)
      options.memory_limit_bytes = static_cast<std::int64_t>(limit);
  return options;
}

// Older records do not say where a mesh of the catalogue was.
MeshFile mesh_of(const Record& record, const std::filesystem::path& folder) {
  const std::string recorded = record.mesh_file.empty() ? record.mesh + ".msh" : record.mesh_file;
  const std::filesystem::path file = recorded_file(recorded, folder);
  MeshFile mesh = read_mesh_file(file);
  if (mesh.sha256 != record.mesh_sha256)
    throw FileError(fmt::format("{}: is not the mesh of the record: its SHA-256 is {}, not {}",
                                file.string(), mesh.sha256, record.mesh_sha256));
  return mesh;
}

// place: of the record, for messages.
Case case_of(const Record& record, const std::string& place, const std::filesystem::path& folder,
             const Options& options) {
  MeshFile mesh = mesh_of(record, folder);
  const std::string definition = json_text(record.scene_definition);
  PosedScene posed{record.scene, record.scene_group, recorded_path(mesh.path, options.out),
                   mesh.sha256,  definition,         {}};
  Scene scene;
  if (definition != "{}") {
    scene = scene_of(definition, place + ": scene_definition");
    scene.name = record.scene;
  }
  posed.problem = std::make_shared<const Problem>(pose(scene, std::move(mesh.mesh)));
  const auto plan = plan_cases({posed}, select_methods(record.method), options.study, options.stop,
                               options.contact, options.thread_counts);
  for (const Case& c : plan)
    if (c.knob.name == record.knob && c.knob.value == record.knob_value && c.stop == record.stop &&
        (!record.contact_solver || c.contact == record.contact_solver))
      return c;
  throw FileError(fmt::format("{}: this program has no such point of the study", record.method));
}

std::string text_of(const Record& record, const char* key) {
  const Json value = field_named(key).value(record);
  if (value.is_null()) return "-";
  if (value.is_number_float()) return fmt::format("{:.4g}", value.get<double>());
  return value.is_string() ? value.get<std::string>() : json_text(value);
}

// What must be the same, and what may differ.
constexpr std::array<const char*, 8> exact = {"status",
                                              "linear_iterations",
                                              "contact_iterations",
                                              "uzawa_iterations",
                                              "parameters",
                                              "n_open",
                                              "n_stick",
                                              "n_slip"};
constexpr std::array<const char*, 4> measured = {"time_s", "peak_heap_bytes", "error_stress",
                                                 "error_force"};

}  // namespace

int replay_command(int argc, const char* const* argv) {
  const ReplayOptions asked = parse_replay(argc, argv);
  const Record record = find_record(asked.record);
  refuse_what_is_not_at_hand(record, asked.record);
  const Context& recorded = record.context;
  const Options options = options_of(record, recorded, asked.out);
  require_threads(options.threads);
  set_threads(options.threads);
  Context context = context_of_run(options);
  for (const auto& [key, value] : recorded)  // what that run said of itself
    if (context.count(key) == 0) context[key] = value;
  const std::filesystem::path folder = folder_and_case(asked.record).folder;
  std::error_code error;
  if (std::filesystem::equivalent(folder, asked.out, error))
    throw UsageError(
        fmt::format("--out: {} (allowed: another folder than the record's)", asked.out.string()));
  if (record.scene_definition.is_null() && record.scene != Scene().name)
    throw FileError(
        fmt::format("{}: does not say what its scene {} is", asked.record, record.scene));
  const std::string differs = differences(recorded, context, Sameness::same_program);
  if (!differs.empty() && !asked.other_program)
    throw FileError(
        fmt::format("{}: was not measured by this program, or not so (recorded and "
                    "now): {} (--other-program runs it all the same)",
                    asked.record, differs));
  const Case planned = case_of(record, asked.record, folder, options);
  catch_interrupts();
  const RunResult result = run_cases({planned}, options, context);
  const Record& now = result.records.front();
  bool same = true;
  fmt::print("{:<20}  {:>14}  {:>14}\n", name_of(record).text(), "recorded", "now");
  for (const char* key : measured)
    fmt::print("{:<20}  {:>14}  {:>14}\n", key, text_of(record, key), text_of(now, key));
  for (const char* key : exact) {
    const std::string before = text_of(record, key), after = text_of(now, key);
    same = same && before == after;
    fmt::print("{:<20}  {:>14}  {:>14}{}\n", key, before, after,
               before == after ? "" : "  differs");
  }
  return same ? all_ok : some_case_failed;
}

}  // namespace airybench
