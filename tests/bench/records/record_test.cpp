#include "bench/records/record.hpp"
#include "bench/records/json.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "bench/records/record_files.hpp"
#include "bench/records/record_json.hpp"
#include "bench/terminal.hpp"
#include "tests/support/places.hpp"

namespace airybench::record_test {
namespace {

TEST(Record, HasExactlyTheDocumentedColumns) {
  const std::set<std::string> documented = {"mesh",
                                            "scene",
                                            "method",
                                            "status",
                                            "status_reason",
                                            "n_phi",
                                            "n_f",
                                            "n_c",
                                            "threads",
                                            "repetitions",
                                            "time_s",
                                            "time_min_s",
                                            "time_mad_s",
                                            "assembly_s",
                                            "stage_order_s",
                                            "stage_precondition_s",
                                            "stage_factor_s",
                                            "stage_condense_s",
                                            "stage_contact_s",
                                            "stage_recover_s",
                                            "stage_check_s",
                                            "peak_heap_bytes",
                                            "peak_rss_bytes",
                                            "storage_bytes",
                                            "linear_iterations",
                                            "contact_iterations",
                                            "uzawa_iterations",
                                            "stop",
                                            "target_error",
                                            "tolerance",
                                            "parameters",
                                            "tuning_s",
                                            "grid_best",
                                            "grid_median",
                                            "grid_worst",
                                            "grid_failures",
                                            "done_fraction",
                                            "extrapolated_time_s",
                                            "error_so_far",
                                            "error_stress",
                                            "error_force",
                                            "equilibrium_residual",
                                            "natural_map_residual",
                                            "signorini_violation_N",
                                            "coulomb_violation_N",
                                            "normal_resultant_N",
                                            "tangential_resultant_N",
                                            "strain_energy_Nmm",
                                            "complementary_energy_Nmm",
                                            "n_open",
                                            "n_stick",
                                            "n_slip",
                                            "outcome",
                                            "claimed_status",
                                            "error_estimate",
                                            "condition_estimate",
                                            "error_discretisation",
                                            "error_total",
                                            "lower_bound_Nmm",
                                            "upper_bound_Nmm",
                                            "study",
                                            "knob",
                                            "knob_value",
                                            "scene_group",
                                            "factor_entries",
                                            "factor_flops",
                                            "library_bytes",
                                            "memory_count_ratio",
                                            "heap_allocations",
                                            "heap_allocated_bytes",
                                            "time_low_s",
                                            "time_high_s",
                                            "signal",
                                            "ended_in",
                                            "time_so_far_s",
                                            "instructions",
                                            "answer_hash",
                                            "runs_s",
                                            "wall_s",
                                            "noise_kernel_s"};
  std::set<std::string> names;
  for (const auto& [name, value] : columns(Record{}))
    EXPECT_TRUE(names.insert(name).second) << name;
  EXPECT_EQ(names, documented);
}

TEST(Record, AForgottenFieldCannotLookLikeSuccess) {
  const Record record;
  EXPECT_EQ(record.status, Status::crashed);
  for (const auto& [name, value] : columns(record))
    if (name.ends_with("_s") || name.starts_with("error") || name.ends_with("bytes")) {
      EXPECT_TRUE(value.is_null()) << name;
    }
}

Record filled() {
  Record record;
  record.mesh = "a \"quoted\", mesh";
  record.scene = "default";
  record.method = "3STEPD";
  record.status = Status::ok;
  record.status_reason.clear();
  record.samples_s = {0.3, 0.1, 0.2};
  record.stage_samples.resize(3);
  for (int i = 0; i < 3; ++i) record.stage_samples[i][Stage::factor] = 0.01 * (i + 1);
  record.verification.emplace();
  record.verification->error_stress = 1.0 / 3;
  record.verification->equilibrium_residual = std::nan("");
  record.stages = {{"order", true, ""}, {"contact", false, "no contact boundary"}};
  return record;
}

TEST(Record, CsvIsUnroundedQuotedAndEmptyWhereNothingApplies) {
  const std::string text = csv_text({to_json(filled())});
  const auto newline = text.find('\n');
  EXPECT_EQ(text.substr(0, 18), "mesh,scene,method,");
  const std::string row = text.substr(newline + 1);
  EXPECT_EQ(row.substr(0, 42), "\"a \"\"quoted\"\", mesh\",default,3STEPD,ok,,0,");
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
  EXPECT_EQ(json["stages_left_out"]["contact"], "no contact boundary");
  EXPECT_EQ(json["stages_run"][0], "order");
}

MemorySplit made_up_memory() {
  MemorySplit memory;
  memory.at_peak[MemoryOwner::factor] = 9'000'000;
  memory.held[MemoryOwner::factor] = memory.counted[MemoryOwner::factor] = 8'000'000;
  memory.held[MemoryOwner::blocks] = 5;  // is not the method's
  memory.counted[MemoryOwner::blocks] = 4'000;
  memory.held[MemoryOwner::other] = 700;
  memory.stage_peak[static_cast<int>(Stage::factor)] = 9'100'000;
  memory.allocations = 12;
  memory.allocated_bytes = 10'000'000;
  return memory;
}

TEST(MemorySplit, IsInTheRecordByOwnerAndByStage) {
  Record record = filled();
  EXPECT_TRUE(to_json(record)["memory_by_owner"].is_null());
  EXPECT_TRUE(to_json(record)["memory_counts_differ"].is_null());
  EXPECT_TRUE(to_json(record)["memory_count_ratio"].is_null());
  record.memory = made_up_memory();
  record.factor_entries = 42;
  record.factor_flops = 1.5e6;
  const Json json = to_json(record);
  EXPECT_EQ(json["memory_by_owner"]["factor"].dump(),
            R"({"peak_bytes":9000000,"held_bytes":8000000,"counted_bytes":8000000})");
  EXPECT_TRUE(json["memory_by_owner"]["other"]["counted_bytes"].is_null());
  EXPECT_FALSE(json["memory_by_owner"].contains("answer"));
  EXPECT_EQ(json["memory_by_stage"].dump(), R"({"factor":9100000})");
  EXPECT_EQ(json["memory_counts_differ"], false);
  EXPECT_EQ(json["memory_count_ratio"], 1.0);
  EXPECT_EQ(json["heap_allocations"], 12);
  EXPECT_EQ(json["heap_allocated_bytes"], 10'000'000);
  EXPECT_EQ(json["factor_entries"], 42);
  EXPECT_EQ(json["factor_flops"], 1.5e6);
}

TEST(MemorySplit, DiffersBeyondATenthAndTheSlackInEitherDirection) {
  MemorySplit memory = made_up_memory();
  EXPECT_FALSE(counts_differ(memory));
  for (const std::int64_t held : {7'190'000, 8'810'000}) {
    memory.held[MemoryOwner::factor] = held;
    EXPECT_TRUE(counts_differ(memory)) << held;
  }
  memory = made_up_memory();
  memory.counted[MemoryOwner::answer] = 1;  // small: within the slack
  memory.held[MemoryOwner::answer] = 60'000;
  EXPECT_FALSE(counts_differ(memory));
  memory.held[MemoryOwner::answer] = 70'000;
  EXPECT_TRUE(counts_differ(memory));
  EXPECT_FALSE(count_ratio(MemorySplit{}).has_value());
}

TEST(Terminal, ShowsUnitsAPersonReads) {
  EXPECT_EQ(show_seconds(1.5e-5), "15 µs");
  EXPECT_EQ(show_seconds(0.0123), "12.3 ms");
  EXPECT_EQ(show_seconds(4.5), "4.5 s");
  EXPECT_EQ(show_seconds(std::nan("")), "-");
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
  const std::string table = results_table({record});
  EXPECT_NE(table.find("Mesh0/default/3STEPD: timeout: time limit reached during"),
            std::string::npos);
}

// Every key that a record can have comes back from JSON.
TEST(Record, ComesBackFromJson) {
  for (const char* run : {"paper", "error", "stability"}) {
    const std::filesystem::path file = testing::results_folder() / run / "records.jsonl";
    std::ifstream in(file);
    int compared = 0;
    for (std::string line; std::getline(in, line) && compared < 200; ++compared) {
      const auto json = Json::parse(line);
      const auto once = to_json(record_from_json(json));
      EXPECT_EQ(to_json(record_from_json(once)), once) << file << ":" << compared + 1;
      // These were written before some keys were there: what they have is kept.
      for (const auto& [key, value] : json.items())
        if (once.contains(key) && key != "stages_left_out") {
          EXPECT_EQ(once[key], value) << key;
        }
    }
    EXPECT_GT(compared, 50) << file;
  }
}

TEST(Record, WithAllThatANewOneHasComesBackFromJson) {
  Record record;
  record.mesh_file = "m.msh";
  record.scene_definition = R"({"friction":0})";
  record.case_number = 7;
  record.signal = "SIGSEGV";
  record.ended_in = "timed run, factor";
  record.time_so_far_s = 1.5;
  record.samples_s = {1, 2, 3};
  record.stage_samples.resize(3);
  for (StageTimes& times : record.stage_samples) times[Stage::check] = 0.5;
  record.noise_kernel_samples_s = {1e-3, 2e-3};
  record.instructions = 12;
  record.runs_s = 3;
  record.wall_s = 4;
  record.factor_entries = 5;
  record.factor_flops = 6;
  record.library_bytes = 7;
  record.memory.emplace();
  record.memory->at_peak[MemoryOwner::factor] = 100;
  record.memory->held[MemoryOwner::factor] = 90;
  record.memory->counted[MemoryOwner::factor] = 80;
  record.memory->stage_peak[static_cast<std::size_t>(Stage::factor)] = 110;
  record.memory->allocations = 3;
  record.memory->allocated_bytes = 200;
  record.verification.emplace();
  record.verification->equilibrium_residual = 1e-12;
  record.histories.push_back({"residual", {1, 0.1}});
  record.grid.push_back({20, 30, 12, "converged"});
  const auto json = to_json(record);
  EXPECT_EQ(json["memory_by_owner"]["factor"]["counted_bytes"], 80);
  EXPECT_EQ(json["stage_samples"][2]["check"], 0.5);
  EXPECT_GT(json["time_high_s"], json["time_low_s"]);
  EXPECT_EQ(to_json(record_from_json(json)), json);
}

}  // namespace
}  // namespace airybench::record_test
