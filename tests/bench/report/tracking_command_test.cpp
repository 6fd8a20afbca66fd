// `bench compare` and `bench track` as a user calls them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "bench/commands/commands.hpp"
#include "bench/records/record.hpp"
#include "bench/report/history.hpp"
#include "tests/support/bench_command.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/places.hpp"

namespace airybench::tracking_command_test {
namespace {

namespace fs = std::filesystem;

class TrackingCommand : public ::testing::Test {
 protected:
  using Result = testing::CommandResult;
  Result run(const std::string& arguments) { return bench_.run(arguments); }
  // A results folder with one case.
  void write_run(const std::string& name, double time_s, const std::string& date,
                 int iterations = 10, const std::string& threads = "1") {
    Json samples = Json::array();
    for (int i = 0; i < 9; ++i) samples.push_back(time_s * (1 + 0.001 * i));
    const Json json = {
        {"mesh", "Mesh0"},
        {"scene", "default"},
        {"method", "ALM"},
        {"stop", "target"},
        {"status", "ok"},
        {"samples_s", samples},
        {"time_s", samples[4]},
        {"linear_iterations", iterations},
        {"context", {{"cpu", "C"}, {"cpus", "2"}, {"threads", threads}, {"date", date}}}};
    fs::create_directories(bench_.path(name));
    testing::write_text(bench_.path(name + "/records.jsonl"), json.dump() + "\n");
  }

  const testing::BenchCommand bench_;
};

TEST_F(TrackingCommand, CompareSaysWhatIsSlower) {
  std::string a, b;
  for (int run = 1; run <= 4; ++run) {
    const std::string number = std::to_string(run), hour = "2026-11-21T0" + number;
    write_run("a," + number, 1 + 0.001 * run, hour + ":00:00Z");
    write_run("b" + number, 1.2 + 0.001 * run, hour + ":30:00Z");
    a += (a.empty() ? "" : ",") + ("a\\," + number);
    b += (b.empty() ? "b" : ",b") + number;
  }
  a = "'" + a + "' ";
  const Result worse = run("compare " + a + b + " --out=c.json");
  EXPECT_EQ(worse.code, 1) << worse.err;
  EXPECT_TRUE(testing::contains(
      worse.out, "B is faster in 0 cases, slower in 1, not separated from A in 0\n"));
  const Result named = run("compare " + a + b + " --names=HEAD~1,HEAD");
  EXPECT_TRUE(named.out.starts_with("A: HEAD~1 (4 runs), B: HEAD (4 runs)\n")) << named.out;
  EXPECT_EQ(Json::parse(bench_.content("c.json"))["cases"][0]["verdict"], "slower");
  bench_.expect_ok("compare " + b + " " + a);
  bench_.expect_ok("compare " + a + b + " --minimum-effect=30");
  bench_.expect_ok("compare b1 b2 --out=c.md");
  EXPECT_TRUE(testing::contains(bench_.content("c.md"), "| not separated: one run each |"));
}

TEST_F(TrackingCommand, CompareRefusesWhatItCannotUse) {
  write_run("a", 1, "2026-11-21T03:00:00Z");
  write_run("b", 1, "2026-11-21T04:00:00Z");
  write_run("c", 1, "2026-11-21T05:00:00Z");
  write_run("two_threads", 1, "2026-11-21T09:00:00Z", 10, "2");
  fs::create_directories(bench_.path("empty"));
  testing::write_text(bench_.path("empty/records.jsonl"), "");
  for (const auto& [arguments, named] :
       {std::pair("a none", "none/records.jsonl: no such file"),
        {"a", "B"},
        {"a a --out=c.txt", "allowed: a name that ends in .md or .json"},
        {"a a --minimum-effect=-1", "--minimum-effect"},
        {"a b --names=HEAD", "--names: HEAD (allowed: two names)"},
        {"a empty", "no case is in both ("},
        {"a,b,a c", "a/records.jsonl: the same run as a"},
        {"a,two_threads c",
         "two_threads/records.jsonl: another program or other settings than of a: "
         "threads: 1 and 2"}})
    bench_.expect_refusal(std::string("compare ") + arguments, named);
}

// What the page has a label for.
TEST_F(TrackingCommand, NightsHaveEveryQuantityOfThePage) {
  std::vector<std::string> keys;
  for (const Field& field : record_fields())
    if ((field.use & nightly) != 0 && *field.label != '\0') keys.push_back(field.name);
  EXPECT_GE(keys.size(), 18u);
  write_run("a", 1, "2026-11-21T03:00:00Z");
  Json record = Json::parse(bench_.content("a/records.jsonl"));
  for (std::size_t k = 0; k < keys.size(); ++k) record[keys[k]] = k + 1;
  testing::write_text(bench_.path("a/records.jsonl"), record.dump() + "\n");
  ASSERT_EQ(run("track --history=h --from=a").code, 0);
  const Json night = Json::parse(bench_.content("h/nights/2026-11-21T030000Z.json"));
  for (std::size_t k = 0; k < keys.size(); ++k)
    EXPECT_EQ(night.at("cases")[0].at(keys[k]), k + 1) << keys[k];
}

TEST_F(TrackingCommand, TrackAddsNightsAndJudgesThem) {
  write_run("a", 1, "2026-11-21T03:00:00Z");
  EXPECT_TRUE(
      testing::contains(bench_.expect_ok("track --history=h --from=a").out, "nothing is worse"));
  EXPECT_TRUE(fs::exists(bench_.path("h/nights/2026-11-21T030000Z.json")));
  bench_.expect_refusal("track --history=h --from=a", "already in the history");
  EXPECT_EQ(Json::parse(bench_.content("h/nights/2026-11-21T030000Z.json")).at("times_judged"),
            false);
  write_run("b", 1, "2026-11-22T03:00:00Z", 12);
  const Result second = run("track --history=h --from=b");
  EXPECT_EQ(second.code, 1);
  EXPECT_TRUE(testing::contains(second.out,
                                "worse    Mesh0/default/ALM: linear_iterations was 10 and is 12"));
  const std::string night = bench_.content("h/nights/2026-11-22T030000Z.json");
  EXPECT_EQ(Json::parse(night)["failed"], true);
  EXPECT_EQ(run("track --history=h --judge-only").code, 1);
  EXPECT_EQ(bench_.content("h/nights/2026-11-22T030000Z.json"), night);
}

TEST_F(TrackingCommand, TrackRefusesWhatItCannotUse) {
  write_run("a", 1, "yesterday");
  bench_.expect_refusal("track --history=h --judge-only", "h: no nights");
  bench_.expect_refusal("track --history=h --from=a",
                        "a/records.jsonl:1: context: date: \"yesterday\"");
  bench_.expect_refusal("track --history=h --from=none", "none/records.jsonl: no such file");
  bench_.expect_refusal("track --history=h --from=a --mesh=Mesh0", "--mesh=Mesh0: not with --from");
  bench_.expect_refusal("track --history=h --out=x", "--out: not with bench track");
  EXPECT_FALSE(fs::exists(bench_.path("h")));
  fs::create_directories(bench_.path("h/nights"));
  testing::write_text(bench_.path("h/nights/2026-11-21T030000Z.json"), "{\"format\"");
  write_run("b", 1, "2026-11-21T03:00:00Z");
  bench_.expect_refusal("track --history=h --from=b", "2026-11-21T030000Z.json: not a whole night");
}

TEST(NightlyArguments, LeaveMeshesAndMethodsToAFigureOrAProblem) {
  for (const char* own : {"--figure=4", "--problem=a.hdf5"})
    for (const std::string& argument : nightly_arguments({own}, "o")) {
      EXPECT_FALSE(argument.starts_with("--mesh")) << own;
      EXPECT_FALSE(argument.starts_with("--method")) << own;
    }
}

TEST(History, RunsThatAreWrongAreNamedByFileKeyAndValue) {
  const auto refusal = [](const std::string& text) {
    return testing::complaint_of<FileError>([&] { parse_tracked_run(text, "n.json"); });
  };
  const std::string whole = testing::text_of(testing::test_data("fuzz/night/good-one"));
  const Json good = Json::parse(whole);
  const std::string longish(5000, 'x');
  std::vector<std::pair<std::string, std::string>> refused = {
      {whole.substr(0, whole.size() / 2), "n.json: not a whole night: "},
      {"", "n.json: not a whole night: "},
      {"[]", "n.json: the file: [] (allowed: a JSON object)"}};
  for (const auto& [path, value, named] :
       {std::tuple<const char*, Json, const char*>(
            "/format", 1, "n.json: format: 1 (allowed: airybench-night-1)"),
        {"/format", longish, "n.json: format: \"xxx"},
        {"/date", 7, "n.json: date: 7 (allowed: a text)"},
        {"/date", "yesterday", "n.json: date: \"yesterday\" (allowed: as 2026-11-21T03:00:00Z)"},
        {"/context", {{"cpu", 3}}, "n.json: context: {\"cpu\":3} (allowed: an object of texts)"},
        {"/noise", 3, "n.json: noise: 3 (allowed: a JSON object)"},
        {"/noise/samples_s", "fast", "n.json: noise: samples_s: \"fast\" (allowed: a list of"},
        {"/cases", nullptr, "n.json: cases: null (allowed: a list)"},
        {"/cases/0/n_phi", "many", "n.json: case 1: n_phi: \"many\" (allowed: a whole number"},
        {"/cases/0/status", "fine", "n.json: case 1: status: \"fine\" (allowed: ok, "},
        {"/verdicts/0", 3, "n.json: verdict 1: 3 (allowed: a JSON object)"},
        {"/verdicts/0/lane", longish, "n.json: verdict 1: lane: \"xxx"},
        {"/verdicts/0/kind", "odd", "n.json: verdict 1: kind: \"odd\" (allowed: worse, better, ch"},
        {"/verdicts/0/ratio", "2", "n.json: verdict 1: ratio: \"2\" (allowed: a number, null)"},
        {"/failed", "no", "n.json: failed: \"no\" (allowed: true, false)"}}) {
    Json wrong = good;
    wrong[Json::json_pointer(path)] = value;
    refused.emplace_back(wrong.dump(), named);
  }
  for (const auto& [text, named] : refused) {
    EXPECT_EQ(refusal(text).find(named), 0u) << refusal(text);
    EXPECT_LT(refusal(text).size(), 250u);
    EXPECT_FALSE(testing::contains(refusal(text), "\n"));
  }
  EXPECT_EQ(refusal(whole), "no complaint");
}

TEST_F(TrackingCommand, TrackRunsAndAddsWhatItMeasured) {
  const Result result = run("track --history=h --mesh=Mesh0 --method=HYBRID --repetitions=2");
  EXPECT_EQ(result.code, 0) << result.err;
  ASSERT_TRUE(fs::exists(bench_.path("h/nights")));
  const Json night =
      Json::parse(testing::text_of(fs::directory_iterator(bench_.path("h/nights"))->path()));
  EXPECT_EQ(night["format"], "airybench-night-1");
  EXPECT_EQ(night["cases"][0]["method"], "HYBRID");
  EXPECT_EQ(night["cases"][0]["samples_s"].size(), 2u);
  EXPECT_EQ(night["failed"], false);
}

}  // namespace
}  // namespace airybench::tracking_command_test
