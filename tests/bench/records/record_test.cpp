// The field table: struct, JSON, CSV, reader and documents follow from it.
#include "bench/records/record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include "bench/records/csv.hpp"
#include "bench/records/record_reader.hpp"
#include "bench/records/summary.hpp"
#include "bench/report/results_table.hpp"
#include "support/atomic_file.hpp"
#include "support/file_text.hpp"
#include "support/gzip.hpp"
#include "support/text_table.hpp"
#include "tests/support/places.hpp"

namespace airybench::record_test {
namespace {

// Others rely on these names: whoever takes one away says so here.
TEST(Record, KeepsThePromisedColumns) {
  const std::string promised =
      "mesh scene method status status_reason n_phi n_f n_c threads repetitions time_s time_min_s "
      "time_mad_s assembly_s stage_order_s stage_precondition_s stage_factor_s stage_condense_s "
      "stage_contact_s stage_recover_s peak_heap_bytes peak_rss_bytes storage_bytes "
      "linear_iterations contact_iterations uzawa_iterations error_stress error_force "
      "equilibrium_residual natural_map_residual signorini_violation_N coulomb_violation_N "
      "normal_resultant_N tangential_resultant_N strain_energy_Nmm complementary_energy_Nmm n_open "
      "n_stick n_slip outcome claimed_status error_estimate error_total";
  std::istringstream names(promised);
  for (std::string name; names >> name;) EXPECT_TRUE(field_named(name).use & column) << name;
}

TEST(Record, HasEachFieldOnceWithItsMeaning) {
  std::set<std::string> names;
  for (const Field& field : record_fields()) {
    EXPECT_TRUE(names.insert(field.name).second) << field.name;
    EXPECT_NE(std::string(field.meaning), "") << field.name;
  }
}

TEST(Record, AForgottenFieldCannotLookLikeSuccess) {
  const Record record;
  EXPECT_EQ(record.status, Status::crashed);
  const Json json = to_json(record);
  for (const auto& [name, value] : json.items())
    if (name.ends_with("_s") || name.starts_with("error") || name.ends_with("bytes")) {
      EXPECT_TRUE(value.empty()) << name;
    }
}

Record filled() {
  Record record;
  record.mesh = "a \"quoted\", mesh";
  record.scene = "default";
  record.method = "3STEPD";
  record.status = Status::ok;
  record.samples_s = {0.3, 0.1, 0.2};
  for (int i = 0; i < 3; ++i) record.stage_samples.push_back({{"factor", 0.01 * (i + 1)}});
  record.error_stress = 1.0 / 3;
  record.equilibrium_residual = std::nan("");
  record.stages_run = {"order"};
  record.stages_left_out["contact"] = "no contact boundary";
  summarise(record);
  return record;
}

TEST(Record, CsvIsUnroundedQuotedAndEmptyWhereNothingApplies) {
  const std::string text = csv_header() + csv_row(filled());
  const auto newline = text.find('\n');
  EXPECT_EQ(text.substr(0, 18), "mesh,scene,method,");
  const std::string row = text.substr(newline + 1);
  EXPECT_EQ(row.substr(0, 44), "\"a \"\"quoted\"\", mesh\",default,3STEPD,,ok,,ok,");
  EXPECT_NE(row.find(",0.3333333333333333,"), std::string::npos);
  EXPECT_NE(row.find(",0.2,0.1,"), std::string::npos);  // median, minimum
  EXPECT_EQ(row.find("nan"), std::string::npos);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
}

TEST(Record, JsonKeepsSamplesAndWhatWasLeftOut) {
  const Json json = to_json(filled());
  EXPECT_EQ(json["samples_s"].size(), 3u);
  EXPECT_EQ(json["time_s"], 0.2);
  EXPECT_EQ(json["stage_factor_s"], 0.02);
  EXPECT_TRUE(json["stage_contact_s"].is_null());
  EXPECT_TRUE(json["equilibrium_residual"].is_null());
  EXPECT_EQ(json["stages_left_out"]["contact"], "no contact boundary");
  EXPECT_EQ(json["stages_run"][0], "order");
}

// A field of every kind goes there and back; so does every other.
TEST(Record, ComesBackFromJson) {
  Record record = filled();
  record.equilibrium_residual = 1e-12;
  record.claimed_status = Status::inaccurate;
  record.stop = Stop::paper;
  record.iterative = true;
  record.factor_entries = 5;
  record.done_fraction = 0.5;
  record.histories = {{"residual", {1, 0.1}}};
  record.context["date"] = "2026-11-21T11:28:12Z";
  record.general_name = record.family = "3STEPD";
  record.case_name = name_of(record).text();
  const Json json = to_json(record);
  EXPECT_EQ(to_json(record_of(json, "here")), json);
  EXPECT_EQ(to_json(record_of_text(json_text(json), "here")), json);
  for (const Field& field : record_fields()) {
    Record changed = record;
    field.clear(changed);
    EXPECT_EQ(field.value(changed), field.value(Record{})) << field.name;
  }
}

std::string text_of(const std::filesystem::path& file) {
  return file.extension() == ".gz" ? unpacked_text(file) : file_text(file);
}

TEST(Record, OfATextIsThatOfItsJson) {
  const std::string names = R"("mesh":"M","scene":"s","method":"A:b","status":"ok")";
  for (const char* more :
       {R"("n_phi":3,"n_phi":5)", R"("n_phi":3,"n_phi":null)", R"("time_s":1e-3)",
        R"("no_field":{"deep":[1,{"n_phi":7}]},"n_phi":2)", R"("samples_s":[1,2.5,3e-1])",
        R"("stage_samples":[{"a":1},{}],"scene_definition":{"a":{"b":[[],{}]},"c":null})",
        R"("stages_run":["order"],"histories":{"residual":[1,null]},"context":{"date":"now"})"}) {
    const std::string text = "{" + names + "," + more + "}";
    EXPECT_EQ(to_json(record_of_text(text, "here")), to_json(record_of(parse_json(text), "here")))
        << text;
  }
}

TEST(Record, OfATextThatIsNoneIsRefusedInOneLine) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      record_of_text(text, "f:1");
    } catch (const RecordError& refused) {
      return refused.what();
    }
    return "taken";
  };
  EXPECT_EQ(refusal("[1,[2]]"), "f:1: [1,[2]] (allowed: a JSON object)");
  EXPECT_EQ(refusal("7"), "f:1: 7 (allowed: a JSON object)");
  EXPECT_EQ(refusal("{}").find("f:1: mesh: null"), 0u) << refusal("{}");
  const std::string deep(40, '['), big = R"({"time_s":1e999})";
  for (const std::string& text :
       {std::string(), std::string("{"), std::string("{\"mesh\":\"a\0\"}", 13),
        R"({"mesh":"M"} {})" + std::string(), deep, big})
    EXPECT_EQ(refusal(text).find("f:1: not JSON: "), 0u) << text << ": " << refusal(text);
}

// What committed records have is kept, by records that were written before some fields were.
TEST(Record, OfEveryRunThatIsCommittedComesBack) {
  for (const char* run : {"paper", "error", "stability"}) {
    const std::filesystem::path file = records_file_in(testing::results_folder() / run);
    std::vector<std::string> lines;
    read_lines(file, [&](const std::string& text, const Line&) { lines.push_back(text); });
    EXPECT_GT(lines.size(), 50u) << file;
    lines.resize(std::min<std::size_t>(lines.size(), 200));
    for (const std::string& line : lines) {
      const Json json = parse_json(line), once = to_json(record_of(json, file));
      for (const auto& [key, value] : json.items())
        if (once.contains(key) && !value.is_null()) {
          EXPECT_EQ(once[key], value) << file << ": " << key << "\n" << line;
        }
    }
  }
}

TEST(Record, OfACommittedRunNamesNoFolderOfTheMachine) {
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(testing::results_folder())) {
    const std::string extension = entry.path().extension();
    if (!std::set<std::string>{".jsonl", ".json", ".gz", ".md", ".txt"}.contains(extension))
      continue;
    const std::string text = text_of(entry.path());
    for (const char* folder : {"\"/", "/home/", "/tmp/", "/root/", "/work/"})
      EXPECT_EQ(text.find(folder), text.npos)
          << entry.path() << ": " << text.substr(text.find(folder), 80);
  }
}

// The unit where the name does not end in it, and the questions that the fields answer.
std::string rows_of(bool columns) {
  std::string text = "| key | meaning |\n|---|---|\n", question;
  const auto add = [&](const std::string& name, const std::string& unit, unsigned use,
                       const char* meaning) {
    if (((use & column) != 0) != columns) return;
    if (!question.empty()) text += "| **" + question + "** | |\n";
    question.clear();
    std::string ending = unit;
    std::erase(ending, ' ');
    const bool is_in_name = unit.empty() || unit == "1" || name.ends_with("_" + ending);
    text += "| `" + name + "`" + (is_in_name ? "" : " (" + unit + ")") + " | " + meaning + " |\n";
  };
#define QUESTION(words) question = words;
#define FIELD(kind, name, unit, use, source, label, meaning) add(#name, unit, use, meaning);
#include "bench/records/record_fields.def"
  return text;
}

// Between the markers; written there when AIRYBENCH_UPDATE is set.
void expect_table(const std::string& marker, const std::string& rows) {
  const std::filesystem::path file = testing::results_folder() / "README.md";
  std::string text = file_text(file);
  const std::string begin = "<!-- " + marker + ", from record_fields.def -->\n",
                    end = "<!-- end -->";
  const std::size_t from = text.find(begin);
  ASSERT_NE(from, text.npos) << marker;
  const std::size_t start = from + begin.size(), length = text.find(end, start) - start;
  if (std::getenv("AIRYBENCH_UPDATE") != nullptr)
    write_file_atomically(file, text.replace(start, length, rows));
  else
    EXPECT_EQ(text.substr(start, length), rows)
        << "results/README.md does not follow from record_fields.def; tests/update_tables.sh";
}

TEST(RecordFormat, IsDocumentedFromTheTable) {
  expect_table("columns", rows_of(true));
  expect_table("more keys", rows_of(false));
}

// What plots/ know of the fields, a line each.
TEST(RecordFormat, IsKnownToThePlots) {
  std::string text;
  for (const Field& field : record_fields()) {
    Json json = {{"name", field.name},
                 {"kind", field.kind},
                 {"unit", field.unit},
                 {"column", (field.use & column) != 0},
                 {"nightly", (field.use & nightly) != 0},
                 {"label", field.label}};
    if (!field.words.empty()) json["words"] = field.words;
    text += (text.empty() ? "[\n " : ",\n ") + json_text(json);
  }
  text += "\n]\n";
  const std::filesystem::path file = testing::source_folder() / "plots/record_fields.json";
  if (std::getenv("AIRYBENCH_UPDATE") != nullptr)
    write_file_atomically(file, text);
  else
    EXPECT_EQ(file_text(file), text) << "tests/update_tables.sh";
}

TEST(RecordFormat, EveryStatusIsAnOutcome) {
  for (const std::string& status : names_of(all_statuses))
    EXPECT_NE(std::ranges::find(all_outcomes, status), all_outcomes.end()) << status;
}

TEST(Terminal, ShowsUnitsAPersonReads) {
  EXPECT_EQ(show_seconds(1.5e-5), "15 µs");
  EXPECT_EQ(show_seconds(0.0123), "12.3 ms");
  EXPECT_EQ(show_seconds(4.5), "4.5 s");
  EXPECT_EQ(show_seconds(std::nan("")), "-");
  EXPECT_EQ(show_seconds({}), "-");
  EXPECT_EQ(show_bytes(1536 * 1024), "1.5 MiB");
  EXPECT_EQ(show_bytes({}), "-");
  EXPECT_EQ(show_error(1.23e-7), "1.2e-07");
  EXPECT_EQ(show_error({}), "-");
  EXPECT_EQ(show_duration(12), "12 s");
  EXPECT_EQ(show_duration(190), "3 min 10 s");
  EXPECT_EQ(show_duration(3725), "1 h 02 min");
}

TEST(Terminal, TableNamesWhatWentWrong) {
  Record record = filled();
  record.mesh = "Mesh0";
  record.status = Status::timeout;
  record.status_reason = "time limit reached during the contact sweeps";
  ResultsTable results;
  results.add(record);
  const std::string table = results.text();
  EXPECT_NE(table.find("Mesh0/default/3STEPD: timeout: time limit reached during"),
            std::string::npos);
}

}  // namespace
}  // namespace airybench::record_test
