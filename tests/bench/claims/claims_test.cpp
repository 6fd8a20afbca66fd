// `bench claims` on records made up for each verdict, and the statistics behind the verdicts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <sstream>

#include "bench/cases/blank_record.hpp"
#include "bench/claims/claims_cases.hpp"
#include "bench/claims/claims_statistics.hpp"
#include "bench/records/json.hpp"
#include "solvers/methods.hpp"
#include "tests/support/bench_command.hpp"

namespace airybench::claims_test {
namespace {

namespace fs = std::filesystem;

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(ClaimsStatistics, ConjunctionOfVerdicts) {
  using enum Verdict;
  EXPECT_EQ(all_of({}), reproduced);
  EXPECT_EQ(all_of({reproduced, undecided}), undecided);
  EXPECT_EQ(all_of({undecided, not_reproduced, reproduced}), not_reproduced);
  EXPECT_EQ(opposite(reproduced), not_reproduced);
  EXPECT_EQ(opposite(undecided), undecided);
}

TEST(ClaimsStatistics, AnIntervalThatStraddlesTheThresholdDecidesNothing) {
  EXPECT_EQ(is_above({1.1, 1.3}, 1), Verdict::reproduced);
  EXPECT_EQ(is_above({0.9, 1.3}, 1), Verdict::undecided);
  EXPECT_EQ(is_above({0.9, 1}, 1), Verdict::not_reproduced);
  EXPECT_EQ(is_above({3, infinity}, 1), Verdict::reproduced);
  EXPECT_EQ(is_within_factor({0.7, 1.4}, 1.5), Verdict::reproduced);
  EXPECT_EQ(is_within_factor({0.7, 1.6}, 1.5), Verdict::undecided);
  EXPECT_EQ(is_within_factor({0.3, 0.5}, 1.5), Verdict::not_reproduced);
  EXPECT_EQ(is_within_factor({1.6, infinity}, 1.5), Verdict::not_reproduced);
}

TEST(ClaimsStatistics, BootstrapOfTheRatioOfMedians) {
  const CaseTime slow = {2, {2, 2.1, 1.9, 2.2, 1.8}}, fast = {1, {1, 1.05, 0.95, 1, 1}};
  const Ratio ratio = ratio_of(slow, fast);
  EXPECT_DOUBLE_EQ(ratio.figure, 2);
  EXPECT_GE(ratio.interval.low, 1.8 / 1.05);
  EXPECT_LE(ratio.interval.high, 2.2 / 0.95);
  EXPECT_LT(ratio.interval.low, 1.95);
  EXPECT_GT(ratio.interval.high, 2.05);
  EXPECT_EQ(ratio_of(slow, fast).interval.low, ratio.interval.low);  // the seed is fixed
  const Ratio single = ratio_of({3, {3}}, {2, {2}});
  EXPECT_EQ(single.interval.low, 1.5);
  EXPECT_EQ(single.interval.high, 1.5);
}

TEST(ClaimsStatistics, TimedOutCasesEnterWithTheTimeTheySpent) {
  const CaseTime stopped = {100, {}, 10}, measured = {2, {2}};
  const Ratio above = ratio_of(stopped, measured), below = ratio_of(measured, stopped);
  EXPECT_TRUE(above.estimated);
  EXPECT_EQ(above.figure, 50);
  EXPECT_EQ(above.interval.low, 5);
  EXPECT_EQ(above.interval.high, infinity);
  EXPECT_EQ(below.interval.low, 0);
  EXPECT_EQ(below.interval.high, 0.2);
  const Ratio unknown = ratio_of(stopped, stopped);
  EXPECT_EQ(unknown.interval.low, 0);
  EXPECT_EQ(unknown.interval.high, infinity);
}

TEST(ClaimsStatistics, SpreadIsGeometricMeanAndRange) {
  const Ratio all = spread({{2, {1.9, 2.1}}, {8, {7, 9}}});
  EXPECT_DOUBLE_EQ(all.figure, 4);
  EXPECT_EQ(all.interval.low, 2);
  EXPECT_EQ(all.interval.high, 8);
  const Ratio with_timeout = spread({{2, {1.9, 2.1}}, {8, {1, infinity}, true}});
  EXPECT_EQ(with_timeout.interval.low, 1);
  EXPECT_EQ(with_timeout.interval.high, infinity);
}

TEST(ClaimsCases, ThePapersNamesAreTheMethods) {
  for (const auto& [of_paper, general] : paper_names)
    EXPECT_EQ(select_methods(of_paper).front().identity(), general);
}

using Result = testing::CommandResult;

class Claims : public ::testing::Test {
 protected:
  // An ok record with three samples, which its caller may change.
  Json& add(const std::string& mesh, const std::string& method, double time_s) {
    records_.push_back({{"mesh", mesh},
                        {"scene", "default"},
                        {"method", method},
                        {"status", "ok"},
                        {"stop", "target"},
                        {"time_s", time_s},
                        {"samples_s", {time_s * 0.99, time_s, time_s * 1.01}},
                        {"stage_contact_s", time_s / 1000},
                        {"peak_heap_bytes", 1000},
                        {"storage_bytes", 1000}});
    Record described;
    describe(select_methods(method).front(), described);
    for (const char* name : {"general_name", "family", "preconditioner", "iterative", "in_paper"})
      records_.back()[name] = field_named(name).value(described);
    if (described.family != "ALM") records_.back()["stage_condense_s"] = time_s / 2;
    return records_.back();
  }
  void add_timeout(const std::string& mesh, const std::string& method, double spent_s,
                   double whole_s) {
    fail(add(mesh, method, 1), "timeout");
    records_.back()["done_fraction"] = spent_s / whole_s;
    records_.back()["extrapolated_time_s"] = whole_s;
  }
  static void fail(Json& record, const std::string& status) {
    for (const char* key : {"time_s", "peak_heap_bytes", "stage_contact_s"}) record[key] = nullptr;
    record["samples_s"] = Json::array();
    record["status"] = status;
  }
  // Times of FAMILY:PRECONDITIONERx with x from `first` on, on Mesh3.
  void add_levels(const std::string& family, const std::string& preconditioner, int first,
                  const std::vector<double>& times_s) {
    for (const double time_s : times_s)
      add("Mesh3", family + ":" + preconditioner + std::to_string(first++), time_s);
  }
  Json& record(const std::string& mesh, const std::string& method) {
    return *std::find_if(records_.begin(), records_.end(),
                         [&](const Json& r) { return r["mesh"] == mesh && r["method"] == method; });
  }

  Result run(const std::string& arguments) const {
    return testing::run_bench(folder_.path(), arguments);
  }
  Result claims(const std::string& arguments = "") const {
    std::string lines;
    for (const Json& record : records_) lines += record.dump() + "\n";
    testing::write_text(folder_ / "records.jsonl", lines);
    return run("claims . " + arguments);
  }
  // The lines of one claim: verdict, sentence, what it rests on.
  std::string claim(int number, const std::string& arguments = "") const {
    const Result result = claims(arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    std::string head = number < 10 ? " " : "";
    head += std::to_string(number) + "  ";
    std::istringstream lines(result.out);
    std::string text;
    for (std::string line; std::getline(lines, line);)
      if (text.empty() ? line.rfind(head, 0) == 0 : line.rfind("    ", 0) == 0)
        text += text.empty() ? line.substr(head.size()) + "\n" : line + "\n";
      else if (!text.empty())
        break;
    EXPECT_NE(text, "") << result.out;
    return text;
  }
  std::string verdict(int number, const std::string& arguments = "") const {
    const std::string text = claim(number, arguments);
    return text.substr(0, text.find("  "));
  }
  void expect_open(int number, const std::string& reason) const {
    EXPECT_EQ(verdict(number), "undecided") << claim(number);
    EXPECT_NE(claim(number).find("open      " + reason), std::string::npos) << claim(number);
  }
  void expect_refused(const std::string& records, const std::string& complaint) const {
    testing::write_text(folder_ / "records.jsonl", records);
    const Result result = run("claims . --out=table.md");
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.err, "bench: ./records.jsonl" + complaint + "\n");
    EXPECT_EQ(result.out, "");
    EXPECT_FALSE(fs::exists(folder_ / "table.md"));
  }

  const testing::TemporaryFolder folder_;
  std::vector<Json> records_;
};

TEST_F(Claims, Claim1LargerXMakesDticFaster) {
  add_levels("SYMMLQ", "DTIC", 3, {8, 6, 4, 2});
  add_levels("3STEPCG", "DTIC", 3, {7, 6, 5, 4});
  EXPECT_EQ(verdict(1), "reproduced");
  EXPECT_NE(claim(1).find("SYMMLQ DTIC3/DTIC4 1.33 [1."), std::string::npos) << claim(1);

  record("Mesh3", "3STEPCG:DTIC5")["samples_s"] = {3.5, 5, 6.5};
  EXPECT_EQ(verdict(1), "undecided");
  EXPECT_NE(claim(1).find("open      3STEPCG DTIC4/DTIC5: the interval straddles"),
            std::string::npos);

  add("Mesh3", "SYMMLQ:DTIC6", 5);
  EXPECT_EQ(verdict(1), "not reproduced");
}

TEST_F(Claims, Claim1NeedsBothFamilies) {
  add_levels("SYMMLQ", "DTIC", 3, {8, 6, 4, 2});
  add("Mesh3", "3STEPCG3", 8);
  fail(add("Mesh3", "3STEPCG6", 4), "breakdown");
  expect_open(1, "breakdown: 3STEPCG:DTIC6 (Mesh3)");
  expect_open(1, "no record: 3STEPCG:DTIC4 (Mesh3), 3STEPCG:DTIC5 (Mesh3)");
}

TEST_F(Claims, Claim2FlicHasAnInnerOptimum) {
  add_levels("SYMMLQ", "FLIC", 1, {9, 7, 5, 6, 8});
  EXPECT_EQ(verdict(2), "reproduced");
  add_levels("3STEPCG", "FLIC", 1, {9, 7, 6, 5, 4});  // there too, where it was measured
  EXPECT_EQ(verdict(2), "not reproduced");
  add("Mesh3", "3STEPCG:FLIC5", 5);
  EXPECT_EQ(verdict(2), "undecided");
  fail(add("Mesh3", "3STEPCG:FLIC5", 5), "not_converged");
  expect_open(2, "not_converged: 3STEPCG:FLIC5 (Mesh3)");
}

TEST_F(Claims, Claim2TimeoutsDecideByTheTimeTheySpent) {
  add_levels("SYMMLQ", "FLIC", 1, {9, 7, 5, 6, 8});
  add_timeout("Mesh3", "SYMMLQ:FLIC1", 10, 40);
  EXPECT_EQ(verdict(2), "reproduced");
  EXPECT_NE(claim(2).find("FLIC1 ~40 s (timeout, above 10 s)"), std::string::npos) << claim(2);
  EXPECT_NE(claim(2).find("FLIC1/FLIC3 ~8 above 1.9"), std::string::npos) << claim(2);
  add_timeout("Mesh3", "SYMMLQ:FLIC1", 4, 40);
  EXPECT_EQ(verdict(2), "undecided");
}

TEST_F(Claims, Claim3DticBeatsFlicAtEqualMemory) {
  add("Mesh3", "SDTIC3", 5)["storage_bytes"] = 1000;
  add_levels("SYMMLQ", "FLIC", 1, {9, 9, 4, 6, 9});
  record("Mesh3", "SYMMLQ:FLIC3")["storage_bytes"] = 700;
  record("Mesh3", "SYMMLQ:FLIC4")["storage_bytes"] = 1400;
  EXPECT_EQ(verdict(3), "reproduced");
  add("Mesh3", "SYMMLQ:FLIC4", 5)["storage_bytes"] = 1400;
  EXPECT_EQ(verdict(3), "undecided");

  // FLIC4 is not of DTIC3's size any more: FLIC3 is the nearest, and faster.
  record("Mesh3", "SYMMLQ:FLIC1")["storage_bytes"] = 100;
  record("Mesh3", "SYMMLQ:FLIC2")["storage_bytes"] = 200;
  record("Mesh3", "SYMMLQ:FLIC5")["storage_bytes"] = 9000;
  add("Mesh3", "SYMMLQ:FLIC4", 6)["storage_bytes"] = 1600;
  EXPECT_EQ(verdict(3), "not reproduced");
  EXPECT_NE(claim(3).find("the nearest is FLIC3's, 0.7 times as much"), std::string::npos);
  record("Mesh3", "SYMMLQ:FLIC3")["storage_bytes"] = 100;
  expect_open(3, "SYMMLQ: no FLIC has DTIC3's memory within a factor 1.5");
  record("Mesh3", "SDTIC3")["storage_bytes"] = nullptr;
  expect_open(3, "no storage_bytes: SYMMLQ:DTIC3 (Mesh3)");
}

TEST_F(Claims, Claim4SsorIsBestNear1AndSlow) {
  add("Mesh3", "SDTIC3", 2);
  add("Mesh3", "SYMMLQ:SSOR0.5", 9);
  add("Mesh3", "SYMMLQ:SSOR1.0", 6);
  expect_open(4, "SYMMLQ: SSOR needs an ω below 0.75, one above 1.25 and one between");
  add("Mesh3", "SYMMLQ:SSOR1.5", 7);
  EXPECT_EQ(verdict(4), "reproduced");
  add_timeout("Mesh3", "SYMMLQ:SSOR0.5", 8, 20);
  EXPECT_EQ(verdict(4), "reproduced");
  fail(add("Mesh3", "SYMMLQ:SSOR1.9", 1), "not_converged");  // gives no answer: not the best
  EXPECT_EQ(verdict(4), "reproduced");
  EXPECT_NE(claim(4).find("ω=1.9 not_converged"), std::string::npos) << claim(4);
  add("Mesh3", "SYMMLQ:SSOR1.5", 6.01);
  EXPECT_EQ(verdict(4), "undecided");
  EXPECT_NE(claim(4).find("best ω: 1 or 1.5"), std::string::npos) << claim(4);
  add("Mesh3", "SYMMLQ:SSOR1.5", 5);
  EXPECT_EQ(verdict(4), "not reproduced");
  add("Mesh3", "SYMMLQ:SSOR1", 3.5);  // near 1, but not slow
  EXPECT_EQ(verdict(4), "not reproduced");
}

TEST_F(Claims, Claim5SymmlqAnd3StepCgTakeTheSameTime) {
  expect_open(5, "no records");
  for (const char* mesh : {"Mesh0", "Mesh1"}) {
    add(mesh, "SDTIC3", 1.1);
    add(mesh, "3STEPCG:DTIC3", 1);
    add(mesh, "SYMMLQ:DTIC6", 0.9);
    add(mesh, "3STEPCG6", 1);
  }
  EXPECT_EQ(verdict(5), "reproduced");
  EXPECT_NE(claim(5).find("SDTIC3/3STEPCG3: Mesh0 1.1 s/1 s = 1.1, Mesh1 1.1 s/1 s = 1.1"),
            std::string::npos)
      << claim(5);
  add("Mesh1", "SDTIC6", 2);
  EXPECT_EQ(verdict(5), "undecided");
  EXPECT_NE(claim(5).find("SDTIC6/3STEPCG6 on 2 meshes 1.34 [0.9, 2]"), std::string::npos)
      << claim(5);
  add("Mesh0", "SDTIC6", 2);
  EXPECT_EQ(verdict(5), "not reproduced");
}

TEST_F(Claims, InaccurateCasesCountWithARemark) {
  add("Mesh0", "SDTIC3", 1.1)["status"] = "inaccurate";
  add("Mesh0", "3STEPCG3", 1);
  add("Mesh0", "SDTIC6", 1);
  add("Mesh0", "3STEPCG6", 1);
  EXPECT_EQ(verdict(5), "reproduced");
  EXPECT_NE(claim(5).find("Mesh0 1.1 s (inaccurate)/1 s"), std::string::npos) << claim(5);
}

TEST_F(Claims, Claim6IterativeReachDirectOnlyWithSky) {
  for (const char* method : {"SDTIC3", "3STEPCG3", "SDTIC6", "3STEPCG6"}) add("Mesh0", method, 4);
  add("Mesh0", "SSKY", 1.2);
  add("Mesh0", "3STEPD", 1);
  EXPECT_EQ(verdict(6), "reproduced");
  add_timeout("Mesh0", "SDTIC3", 3, 100);
  EXPECT_EQ(verdict(6), "reproduced");
  EXPECT_NE(claim(6).find("SDTIC3/3STEPD on 1 mesh ~100 above 2.9"), std::string::npos) << claim(6);
  add_timeout("Mesh0", "SDTIC3", 1, 100);
  EXPECT_EQ(verdict(6), "undecided");
  fail(add("Mesh0", "SDTIC3", 1), "out_of_memory");
  expect_open(6, "out_of_memory: SDTIC3 (Mesh0)");
  add("Mesh0", "SSKY", 1.8);  // a counterexample does not need the rest
  EXPECT_EQ(verdict(6), "not reproduced");
}

TEST_F(Claims, Claim7AlmIsSlightlyFasterThan3StepD) {
  for (const char* mesh : {"Mesh0", "Mesh1"}) {
    add(mesh, "ALM", 0.9)["tuning_s"] = 60;
    add(mesh, "3STEPD", 1);
  }
  EXPECT_EQ(verdict(7), "reproduced");
  EXPECT_NE(claim(7).find("Mesh0 (900 ms + 60 s)/1 s = 60.9"), std::string::npos) << claim(7);
  add("Mesh1", "ALM", 1.2);
  EXPECT_EQ(verdict(7), "undecided");
  add("Mesh0", "ALM", 1.1);
  EXPECT_EQ(verdict(7), "not reproduced");
  add("Mesh2", "3STEPD", 1);
  expect_open(7, "no record: ALM (Mesh2)");
}

TEST_F(Claims, Claim8AlmNeedsTheLeastMemory) {
  for (const char* method : {"SDTIC3", "3STEPCG3", "SDTIC6", "3STEPCG6", "SSKY", "3STEPD"})
    add("Mesh0", method, 1)["peak_heap_bytes"] = 4 << 20;
  expect_open(8, "no record: ALM (Mesh0)");
  add("Mesh0", "ALM", 1)["peak_heap_bytes"] = 2 << 20;
  EXPECT_EQ(verdict(8), "reproduced");
  EXPECT_NE(claim(8).find("Mesh0: ALM 2.0 MiB, 3STEPD 4.0 MiB, least but ALM SDTIC3 4.0 MiB"),
            std::string::npos)
      << claim(8);
  add_timeout("Mesh0", "SSKY", 1, 2);
  expect_open(8, "timeout: SSKY (Mesh0)");
  add("Mesh0", "SDTIC6", 1)["peak_heap_bytes"] = 1 << 20;
  EXPECT_EQ(verdict(8), "not reproduced");
}

TEST_F(Claims, Claim9GaussSeidelTakesUnder1Percent) {
  add("Mesh0", "ALM", 1)["stage_contact_s"] = 0.5;  // these two do not condense as the paper does
  add("Mesh0", "HYBRID", 1)["stage_contact_s"] = 0.5;
  expect_open(9, "no records");
  add("Mesh0", "3STEPD", 1);
  add_timeout("Mesh0", "BLIND", 1, 2);
  EXPECT_EQ(verdict(9), "reproduced");
  EXPECT_NE(claim(9).find("under 1 % in 1 of 1 cases; 1 without a time"), std::string::npos);
  add("Mesh0", "SYMMLQ:NONE", 1)["stage_contact_s"] = 0.02;
  EXPECT_EQ(verdict(9), "not reproduced");
  EXPECT_NE(claim(9).find("largest share: Mesh0 2 % (SYMMLQ:NONE)"), std::string::npos);
}

TEST_F(Claims, Claim10BlindCondensationIsTooExpensive) {
  add("Mesh0", "3STEPD", 1);
  expect_open(10, "no records");
  add_timeout("Mesh0", "BLIND", 5, 50);
  add("Mesh0", "BLIND:SKY", 0.5);
  EXPECT_EQ(verdict(10), "reproduced");
  EXPECT_NE(claim(10).find("BLIND:SKY/3STEPD: Mesh0 500 ms/1 s = 0.5"), std::string::npos);
  add("Mesh0", "BLIND", 0.9);
  EXPECT_EQ(verdict(10), "not reproduced");
  add("Mesh1", "3STEPD", 1);
  add("Mesh1", "BLIND", 3);
  EXPECT_EQ(verdict(10), "undecided");
}

TEST_F(Claims, StopsAreKeptApartButForDirectMethods) {
  add("Mesh0", "BLIND", 3);
  add("Mesh0", "3STEPD", 1);
  add("Mesh0", "ALM", 2);
  add("Mesh0", "ALM", 0.9)["stop"] = "paper";
  EXPECT_EQ(verdict(7), "not reproduced");
  EXPECT_EQ(verdict(7, "--stop=target"), "not reproduced");
  EXPECT_EQ(verdict(7, "--stop=paper"), "reproduced");
  EXPECT_EQ(verdict(10, "--stop=paper"), "reproduced");
  add("Mesh0", "3STEPD", 5)["stop"] = "paper";  // its own record of that stop goes before
  EXPECT_EQ(verdict(10, "--stop=paper"), "not reproduced");
  EXPECT_EQ(verdict(10), "reproduced");
}

TEST_F(Claims, OneSceneCounts) {
  add("Mesh0", "3STEPD", 1)["scene"] = "flat";
  add("Mesh0", "BLIND", 3)["scene"] = "flat";
  EXPECT_EQ(verdict(10), "reproduced");
  EXPECT_NE(claims().out.find("stop target, scene flat"), std::string::npos);
  add("Mesh0", "3STEPD", 1)["scene"] = "smooth";
  EXPECT_EQ(claims().err,
            "bench: ./records.jsonl: scene: flat and smooth (allowed: default among them, or one "
            "scene alone)\n");
  add("Mesh0", "3STEPD", 4);
  add("Mesh0", "BLIND", 3);
  EXPECT_EQ(verdict(10), "not reproduced");
}

TEST_F(Claims, PreconditionersAreComparedOnTheMeshWithMostOfThem) {
  add_levels("SYMMLQ", "FLIC", 1, {9, 7, 5, 6, 8});
  add("Mesh0", "SSKY", 1);
  EXPECT_NE(claims().out.find("preconditioners on Mesh3\n"), std::string::npos);
  for (Json& record : records_) record["mesh"] = "Mesh1";
  EXPECT_NE(claims().out.find("preconditioners on Mesh1\n"), std::string::npos);
}

TEST_F(Claims, NoRecordsDecideNothing) {
  const Result result = claims();
  EXPECT_EQ(result.code, 0);
  EXPECT_NE(result.out.find("0 cases, stop target, scene default, preconditioners on no mesh"),
            std::string::npos);
  for (int number = 1; number <= 10; ++number) EXPECT_EQ(verdict(number), "undecided") << number;
}

TEST_F(Claims, WritesAMarkdownTable) {
  add("Mesh0", "3STEPD", 1);
  add("Mesh0", "BLIND", 3);
  ASSERT_EQ(claims("--out=table.md").code, 0);
  const std::string table = testing::text_of(folder_ / "table.md");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 2 + 2 + 10);
  EXPECT_NE(table.find("| 10 | Blind condensation is too expensive (3.2.1); here: slower than "
                       "3STEPD | BLIND/3STEPD: Mesh0 3 s/1 s = 3 | BLIND/3STEPD on 1 mesh 3 | "
                       "**reproduced** |\n"),
            std::string::npos)
      << table;
}

TEST_F(Claims, WrongUsageIsOneLine) {
  add("Mesh0", "3STEPD", 1);
  ASSERT_EQ(claims().code, 0);
  EXPECT_EQ(run("claims --help").code, 0);
  EXPECT_NE(run("claims --help").out.find("bench claims"), std::string::npos);
  EXPECT_EQ(run("claims").err, "bench: DIR is required\n");
  EXPECT_EQ(
      run("claims nowhere").err,
      "bench: nowhere/records.jsonl: no such file (a folder that bench --out wrote has it)\n");
  EXPECT_EQ(run("claims . --out=table.csv").err,
            "bench: --out: table.csv (allowed: a name that ends in .md)\n");
  for (const char* arguments : {"", "nowhere", ". --stop=mine", ". --wrong", ". more",
                                ". --out=table.csv", ". --out=nowhere/table.md"}) {
    const Result result = run(std::string("claims ") + arguments);
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_EQ(result.out, "") << arguments;
  }
}

TEST_F(Claims, MalformedRecordsAreNamedByLineKeyAndValue) {
  const Json good = add("Mesh0", "3STEPD", 1);
  const auto expect_bad = [&](const char* key, const Json& value, const std::string& complaint) {
    Json bad = good;
    bad[key] = value;
    expect_refused(good.dump() + "\n" + bad.dump() + "\n", std::string(":2: ") + key + complaint);
  };
  const std::string text =
      " (allowed: a text that is not empty, without / and control "
      "characters)";
  expect_bad("mesh", "", ": \"\"" + text);
  expect_bad("scene", nullptr, ": null" + text);
  expect_bad("method", 7, ": 7" + text);
  expect_bad("status", "fine",
             ": \"fine\" (allowed: ok, inaccurate, unstressed, not_converged, breakdown, timeout, "
             "out_of_memory, crashed, machine_fault, skipped)");
  expect_bad("stop", "mine", ": \"mine\" (allowed: target, paper, null)");
  expect_bad("time_s", 0, ": 0 (allowed: a number > 0, null)");
  expect_bad("time_s", "1", ": \"1\" (allowed: a number > 0, null)");
  expect_bad("tuning_s", -1, ": -1 (allowed: a number >= 0, null)");
  expect_bad("samples_s", {1, -1}, ": -1 (allowed: numbers > 0)");
  expect_bad("samples_s", 1, ": 1 (allowed: a list of numbers > 0)");
  expect_bad("done_fraction", 1.5, ": 1.5 (allowed: a number from 0 to 1, null)");
  expect_bad("storage_bytes", 0.5, ": 0.5 (allowed: a whole number from 0 to 2^60, null)");
  expect_bad("peak_heap_bytes", -1, ": -1 (allowed: a whole number from 0 to 2^60, null)");
  expect_refused(good.dump() + "\n[1]\n", ":2: [1] (allowed: a JSON object)");
  const std::string cut = good.dump().substr(0, 40);
  testing::write_text(folder_ / "records.jsonl", good.dump() + "\n" + cut + "\n");
  Result result = run("claims .");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err.rfind("bench: ./records.jsonl:2: not JSON: ", 0), 0u) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  // The last line of a run that was ended while it wrote.
  testing::write_text(folder_ / "records.jsonl", good.dump() + "\n" + cut);
  result = run("claims .");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("1 cases"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace airybench::claims_test
