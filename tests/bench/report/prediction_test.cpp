// Predictions from records made up for each rule, and from the committed ones.
#include "bench/report/prediction.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solvers/methods.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_folder.hpp"

namespace airybench::prediction_test {
namespace {

using testing::TemporaryFolder;
using testing::write_text;

struct Size {
  const char* mesh;
  int n_phi;
};
constexpr Size small = {"Mesh0", 761}, middle = {"Mesh3", 6287}, large = {"Mesh7", 50483};

Record made_up(const std::string& method, const Size& size, double time_s,
               std::int64_t bytes = 1 << 20) {
  Record record;
  record.mesh = size.mesh;
  record.n_phi = size.n_phi;
  record.scene = "default";
  record.method = method;
  const Method known = select_methods(method).front();
  record.general_name = known.identity();
  record.family = known.family;
  record.iterative = known.is_iterative();
  record.status = Status::ok;
  record.stop = Stop::target;
  record.time_s = time_s;
  record.peak_heap_bytes = bytes;
  return record;
}

Record planned(const std::string& method, const Size& size) {
  Record record = made_up(method, size, 0);
  record.time_s.reset();
  return record;
}

Prediction predict_one(const Record& c, const std::vector<Record>& records,
                       const RunLimits& limits = {}) {
  return forecast({c}, records, limits).cases.front();
}
Prediction predicted(const std::string& method, const Size& size,
                     const std::vector<Record>& records, const RunLimits& limits = {}) {
  return predict_one(planned(method, size), records, limits);
}

TEST(Prediction, TheSameCaseHasItsLatestRecord) {
  const std::vector<Record> records = {made_up("HYBRID", small, 9),
                                       made_up("HYBRID", small, 0.5, 1000),
                                       made_up("HYBRID", middle, 4)};
  const Prediction p = predicted("HYBRID", small, records);
  EXPECT_EQ(p.time_s->value, 0.5);
  EXPECT_EQ(p.peak_heap_bytes->value, 1000);
  EXPECT_EQ(p.basis, "measured");
  EXPECT_EQ(predicted("HYBRID", {"Mesh0", 700}, records).basis,
            "measured on Mesh0/default, scaled by n log n")
      << "another mesh under the same name";
  EXPECT_EQ(predicted("SYMMLQ:SSOR1", small, {made_up("SYMMLQ:SSOR1.0", small, 0.5)}).basis,
            "measured")
      << "an alias is its method";
}

TEST(Prediction, ASceneOfItsOwnComesFirst) {
  std::vector<Record> records = {made_up("HYBRID", small, 1), made_up("HYBRID", middle, 1)};
  for (Record record : {records[0], records[1]}) {
    record.scene = "flat";
    record.time_s = 10;
    records.push_back(record);
  }
  const double grown = growth(middle.n_phi, large.n_phi);
  EXPECT_NEAR(predicted("HYBRID", large, records).time_s->value, grown, 1e-9);
  Record flat = planned("HYBRID", large);
  flat.scene = "flat";
  EXPECT_NEAR(predict_one(flat, records).time_s->value, 10 * grown, 1e-9);
}

TEST(Prediction, TheNearestSizeIsScaledByNLogN) {
  const std::vector<Record> records = {made_up("HYBRID", small, 1), made_up("HYBRID", middle, 2)};
  const Prediction p = predicted("HYBRID", large, records);
  EXPECT_NEAR(p.time_s->value, 2 * 50483 * std::log(50483) / (6287 * std::log(6287)), 1e-9);
  EXPECT_EQ(p.basis, "measured on Mesh3/default, scaled by n log n");
  EXPECT_GT(p.time_s->high, 2 * p.time_s->value);
}

TEST(Prediction, WithoutRecordsOfItsOwnTheClosestRelativeServes) {
  const std::vector<Record> records = {made_up("3STEPD", small, 1),
                                       made_up("3STEPCG:FLIC5", small, 2),
                                       made_up("3STEPCG:SKY", small, 3)};
  const Prediction p = predicted("3STEPCG:FLIC4", small, records);
  EXPECT_EQ(p.time_s->value, 2);
  EXPECT_EQ(p.basis, "like 3STEPCG:FLIC5 with stop target: measured");
  EXPECT_GT(p.time_s->high, 4 * 2);
  const Prediction none = predicted("HYBRID", small, records);
  EXPECT_FALSE(none.time_s);
  EXPECT_FALSE(none.run_s);
  EXPECT_EQ(none.basis, "no record");
}

TEST(Prediction, AStopIsAnotherCaseUnlessTheMethodHasNone) {
  Record iterative = made_up("SSKY", small, 1), direct = made_up("3STEPD", small, 2);
  iterative.stop = direct.stop = Stop::paper;
  EXPECT_EQ(predicted("3STEPD", small, {iterative, direct}).basis, "measured");
  const Prediction p = predicted("SSKY", small, {iterative, direct});
  EXPECT_EQ(p.basis, "like SYMMLQ:SKY with stop paper: measured");
}

TEST(Prediction, AStudysPointIsACaseOfItsOwn) {
  Record point = made_up("SSKY", small, 1);
  point.knob = "tolerance";
  point.knob_value = 0.01;
  Record c = planned("SSKY", small);
  EXPECT_NE(predict_one(c, {point}).basis, "measured");
  c.knob = "tolerance";
  c.knob_value = 0.01;
  EXPECT_EQ(predict_one(c, {point}).basis, "measured");
}

TEST(Prediction, ATimeoutCountsWithItsExtrapolatedTime) {
  Record stopped = made_up("SSKY", large, 0);
  stopped.status = Status::timeout;
  stopped.time_s.reset();
  stopped.extrapolated_time_s = 5000;
  const Prediction p = predicted("SSKY", large, {stopped}, {.timeout_s = 900});
  EXPECT_EQ(p.time_s->value, 5000);
  EXPECT_EQ(*p.run_s, 900);
  EXPECT_EQ(p.timeout, LimitMark::above);
  EXPECT_EQ(p.basis, "a timeout, extrapolated");
  EXPECT_GT(p.time_s->high, 3 * 5000);
  EXPECT_EQ(predicted("SSKY", middle, {made_up("SSKY", small, 1), stopped}).basis,
            "a timeout, extrapolated on Mesh7/default, scaled by n log n");
  stopped.extrapolated_time_s.reset();
  EXPECT_FALSE(predicted("SSKY", large, {stopped}).time_s);
}

TEST(Prediction, LimitsAreMarked) {
  const std::vector<Record> records = {made_up("HYBRID", small, 1, 2000)};
  const Prediction p =
      predicted("HYBRID", small, records, {.timeout_s = 1.1, .memory_limit_bytes = 1000});
  EXPECT_EQ(p.timeout, LimitMark::may_pass);
  EXPECT_EQ(p.memory_limit, LimitMark::above);
  const Prediction within =
      predicted("HYBRID", small, records, {.timeout_s = 100, .memory_limit_bytes = 1 << 20});
  EXPECT_EQ(within.timeout, LimitMark::below);
  EXPECT_EQ(within.memory_limit, LimitMark::below);
}

TEST(Prediction, ACaseCostsWhatTheRunnerRuns) {
  RunLimits limits;  // five repetitions, long from 30 s on, at most 900 s
  EXPECT_DOUBLE_EQ(run_seconds(1, 10, limits), 10 + 7);        // tuning, detail, memory, five
  EXPECT_DOUBLE_EQ(run_seconds(12, 0, limits), (2 + 3) * 12);  // three reach 30 s
  EXPECT_DOUBLE_EQ(run_seconds(30, 0, limits), 3 * 30);
  EXPECT_DOUBLE_EQ(run_seconds(31, 5, limits), 36);         // measured once
  EXPECT_DOUBLE_EQ(run_seconds(5000, 2000, limits), 1800);  // both end at the limit
  limits.measures_once = true;
  EXPECT_DOUBLE_EQ(run_seconds(1, 10, limits), 11);
}

TEST(Prediction, TuningIsThatOfTheSameRecords) {
  Record tuned = made_up("ALM", small, 1), other = made_up("ALM", middle, 10);
  tuned.tuning_s = 40;
  Prediction p = predicted("ALM", small, {tuned, other});
  EXPECT_EQ(p.tuning_s, 40);
  EXPECT_EQ(*p.run_s, 47);
  EXPECT_EQ(predicted("ALM", middle, {tuned, other}).tuning_s, 0);
  other.tuning_s = 40. * 6287 / 761;
  p = predicted("ALM", large, {tuned, other});
  EXPECT_NEAR(p.tuning_s, *other.tuning_s * growth(6287, 50483), 1e-6);
  Record given = made_up("ALM:r=20,rho=20", small, 2);
  p = predicted("ALM:r=20,rho=32", small, {tuned, given});
  EXPECT_EQ(p.time_s->value, 2);
  EXPECT_EQ(p.tuning_s, 0) << "of a method that chooses its parameters";
}

TEST(Prediction, AStudysRecordServesOnlyWhereThereIsNoOther) {
  Record of_study = made_up("HYBRID", small, 7);
  of_study.study = "stability";
  EXPECT_EQ(predicted("HYBRID", small, {of_study}).time_s->value, 7);
  const std::vector<Record> both = {made_up("HYBRID", small, 1), of_study};
  EXPECT_EQ(predicted("HYBRID", small, both).time_s->value, 1);
}

TEST(Prediction, ScenesOfOneMeshStandInForEachOther) {
  Record one = made_up("HYBRID", small, 1), other = made_up("HYBRID", small, 4);
  one.scene = "flat";
  other.scene = "steep";
  const Prediction p = predicted("HYBRID", small, {one, other});
  EXPECT_EQ(p.time_s->value, 1);
  EXPECT_GT(p.time_s->high, 4);
  EXPECT_EQ(p.basis, "measured on Mesh0/flat");
}

TEST(Prediction, FarExtrapolationsStillFitTheTable) {
  std::vector<Record> records = {made_up("SSKY", {"A", 10}, 1e-9, 1),
                                 made_up("SSKY", {"B", 11}, 1e9, std::int64_t{1} << 60)};
  const std::vector<Record> cases = {planned("SSKY", large)};
  const std::string table = prediction_table(cases, forecast(cases, records, {}), {});
  EXPECT_TRUE(testing::contains(table, "Mesh7/default/SSKY: above --timeout=900"));
  EXPECT_TRUE(testing::contains(table, "the run: about "));
}

TEST(PastRecords, MissingFoldersArePassedOverAndTheLatestComesLast) {
  const TemporaryFolder folder;
  for (const char* name : {"new", "old", "broken"})
    std::filesystem::create_directories(folder / name);
  const auto line = [](const char* method, const char* date) {
    return std::string(R"({"mesh":"Mesh0","scene":"default","method":")") + method +
           R"(","status":"ok","n_phi":761,"time_s":1,"study":"error","knob":"tolerance",)" +
           R"("knob_value":0.01,"context":{"date":")" + date + "\"}}\n";
  };
  write_text(folder / "new/records.jsonl", line("A", "2026-11-21T11:28:12Z"));
  write_text(folder / "old/records.jsonl", line("B", "2026-10-01T00:00:00Z"));
  write_text(folder / "broken/records.jsonl", "{\"mesh\":\n");
  const PastRecords past =
      read_past_records({folder / "new", folder / "missing", folder / "old", folder / "broken"});
  ASSERT_EQ(past.records.size(), 2u);
  EXPECT_EQ(past.records[0].method, "B");
  EXPECT_EQ(past.records[1].method, "A");
  EXPECT_EQ(past.records[1].n_phi, 761);
  EXPECT_EQ(past.records[1].knob, "tolerance");
  EXPECT_EQ(past.records[1].knob_value, 0.01);
  ASSERT_EQ(past.passed_over.size(), 1u);
  EXPECT_TRUE(testing::contains(past.passed_over[0], "records.jsonl:1: not JSON"));
}

TEST(PastRecords, TheCommittedOnesAreThoseThatTellOfTheCases) {
  const TemporaryFolder folder;
  Record planned;
  planned.mesh = "Mesh0";
  planned.method = planned.general_name = "P2";
  const auto known = [&](const char* scene) {
    planned.scene = scene;
    const PastRecords past = read_committed_records({planned}, folder.path());
    EXPECT_TRUE(past.passed_over.empty());
    return std::any_of(past.records.begin(), past.records.end(), [&](const Record& record) {
      return record.scene == planned.scene && record.method == planned.method;
    });
  };
  EXPECT_TRUE(known("default"));
  EXPECT_TRUE(known("layers_1e8"));
  EXPECT_FALSE(known("nobody's"));
}

// Each mesh from the smaller ones, as when a series of runs goes up in size.
TEST(PastRecords, DirectMethodsArePredictedFromSmallerMeshes) {
  for (const auto& [folder, min_predicted] : {std::pair("paper", 18), std::pair("direct", 24)}) {
    const PastRecords past = read_past_records({testing::results_folder() / folder});
    ASSERT_TRUE(past.passed_over.empty()) << past.passed_over.front();
    int predicted = 0, within = 0;
    for (const Record& held_out : past.records) {
      if (held_out.iterative || held_out.mesh < "Mesh5") continue;
      std::vector<Record> smaller = past.records;
      std::erase_if(smaller, [&](const Record& r) { return r.n_phi >= held_out.n_phi; });
      const Prediction p = predict_one(held_out, smaller);
      ASSERT_TRUE(p.time_s && p.peak_heap_bytes);
      const double factor = p.time_s->value / *held_out.time_s;
      const double heap_factor =
          p.peak_heap_bytes->value / static_cast<double>(*held_out.peak_heap_bytes);
      const std::string name = fmt::format("{}: {} {}", folder, held_out.mesh, held_out.method);
      // Refined twice it is sixteen times as large as the largest of the series: by its interval
      // only.
      if (held_out.mesh.find('+') == std::string::npos) {
        EXPECT_LT(std::abs(std::log(factor)), std::log(2.1)) << name << ": " << factor;
        EXPECT_LT(std::abs(std::log(heap_factor)), std::log(1.6)) << name << ": " << heap_factor;
      }
      ++predicted;
      within += p.time_s->low <= *held_out.time_s && *held_out.time_s <= p.time_s->high;
    }
    EXPECT_GE(predicted, min_predicted) << folder;
    EXPECT_GE(within, 0.9 * predicted) << folder;
  }
}

TEST(PastRecords, ASlowerMachineIsKnownByOneMeasurement) {
  const PastRecords past = read_past_records({testing::results_folder() / "paper"});
  Record measured = *std::ranges::find(past.records, "HYBRID", &Record::method);
  const double here = time_of_machine(measured, past.records);
  *measured.time_s *= 6;
  EXPECT_NEAR(time_of_machine(measured, past.records), 6 * here, 1e-9 * here);
  EXPECT_EQ(time_of_machine(made_up("HYBRID", small, 1), {}), 1);
}

}  // namespace
}  // namespace airybench::prediction_test
