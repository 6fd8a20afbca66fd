// Nothing measured is lost: runs that are killed, interrupted or out of disk space, and gone on
// with; shards and their joining; one recorded case run again.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <map>
#include <random>
#include <set>
#include <thread>

#include "bench/records/json.hpp"
#include "tests/support/background_run.hpp"
#include "tests/support/bench_command.hpp"
#include "tests/support/places.hpp"
#include "tests/support/sanitized.hpp"

namespace airybench::resume_test {
namespace {

using testing::BackgroundRun;
using testing::BenchCommand;
using testing::CommandResult;
using testing::is_there;
using testing::wait_for;

const std::string six =
    "--mesh=Mesh0 --method=3STEPD,BLIND,BLIND:SCHUR,3STEPD:CHOLMOD,HYBRID,P2 --repetitions=1 ";

std::string name_of(const Json& record) {
  return record["mesh"].get<std::string>() + "/" + record["method"].get<std::string>();
}

// What is the same whenever a case is run.
Json lasting(const Json& record) {
  Json kept;
  for (const char* key :
       {"mesh", "scene", "method", "status", "n_phi", "n_f", "n_c", "storage_bytes", "error_stress",
        "error_force", "contact_iterations", "n_open", "n_stick", "n_slip", "case_number"})
    kept[key] = record[key];
  return kept;
}

std::map<std::string, Json> by_name(const std::vector<Json>& records) {
  std::map<std::string, Json> result;
  for (const Json& record : records) {
    EXPECT_EQ(result.count(name_of(record)), 0u) << name_of(record) << " is there twice";
    result[name_of(record)] = lasting(record);
  }
  return result;
}

std::set<pid_t> descendants(pid_t of) {
  std::set<pid_t> found;
  for (const pid_t child : testing::children_of(of)) {
    found.insert(child);
    found.merge(descendants(child));
  }
  return found;
}

void expect_found(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

void expect_refused(const CommandResult& result, const std::string& why) {
  EXPECT_EQ(result.code, 2);
  expect_found(result.err, why);
}

// In one line, and nothing is written.
void expect_merge_refused(const BenchCommand& bench, const std::string& arguments,
                          const std::string& why) {
  const CommandResult result = bench.run("merge " + arguments + " --out=no");
  expect_refused(result, why);
  EXPECT_EQ(std::ranges::count(result.err, '\n'), 1);
  EXPECT_FALSE(std::filesystem::exists(bench.path("no")));
}

TEST(Resume, AfterKillAtRandomMomentsNothingIsLostOrRepeated) {
  const BenchCommand bench;
  ASSERT_EQ(bench.run(six + "--out=undisturbed").code, 0) << bench.content("err.txt");
  const auto undisturbed = by_name(bench.records("undisturbed"));
  ASSERT_EQ(undisturbed.size(), 6u);
  std::mt19937 engine(5);
  std::size_t before = 0;
  int killed_at_work = 0;
  for (int kills = 0; kills < (testing::sanitized ? 8 : 20); ++kills) {
    if (before == undisturbed.size()) {  // it came to the end: from the start again
      std::filesystem::remove_all(bench.path("o"));
      before = 0;
    }
    BackgroundRun run(bench, six + "--out=o --resume");
    std::this_thread::sleep_for(std::chrono::milliseconds(engine() % 400));
    killed_at_work += WIFSIGNALED(run.end(SIGKILL)) ? 1 : 0;
    const auto records = by_name(bench.records());
    EXPECT_GE(records.size(), before) << "a record was lost";
    for (const auto& [name, record] : records) EXPECT_EQ(record, undisturbed.at(name));
    before = records.size();
  }
  EXPECT_GT(killed_at_work, 0);
  ASSERT_EQ(bench.run(six + "--out=o --resume").code, 0) << bench.content("err.txt");
  EXPECT_EQ(by_name(bench.records()), undisturbed);
  EXPECT_EQ(bench.content("o/results.csv").substr(0, 5), "mesh,");
}

TEST(Resume, ALineHalfWrittenIsRunAgain) {
  const BenchCommand bench;
  ASSERT_EQ(bench.run(six + "--out=o").code, 0);
  const auto whole = by_name(bench.records());
  const std::string text = bench.content("o/records.jsonl");
  testing::write_text(bench.path("o/records.jsonl"), text.substr(0, text.size() - 100));
  const CommandResult result = bench.run(six + "--out=o --resume");
  EXPECT_EQ(result.code, 0) << result.err;
  expect_found(result.out, "5 of these 6 records were there already, and the start of another");
  EXPECT_EQ(by_name(bench.records()), whole);
  // With the times of then: they were not measured again.
  const std::string five = text.substr(0, text.rfind('\n', text.size() - 2) + 1);
  EXPECT_EQ(std::ranges::count(five, '\n'), 5);
  EXPECT_EQ(bench.content("o/records.jsonl").substr(0, five.size()), five);
}

TEST(Resume, AfterAFullDisk) {
  const BenchCommand bench;
  // A file may have so many KiB: a record is a few.
  const CommandResult full = bench.run(six + "--out=o", "ulimit -f 16; ");
  expect_refused(full, "o/records.jsonl: cannot be written: File too large");
  const auto first = by_name(bench.records());
  EXPECT_GE(first.size(), 1u);
  EXPECT_LT(first.size(), 6u);
  const std::string text = bench.content("o/records.jsonl");
  EXPECT_EQ(text.back(), '\n') << "the line that did not fit was not taken back";
  EXPECT_EQ(bench.run(six + "--out=o --resume").code, 0);
  const auto whole = by_name(bench.records());
  EXPECT_EQ(whole.size(), 6u);
  for (const auto& [name, record] : first) EXPECT_EQ(whole.at(name), record);
}

// The new records are on disk before the old ones go.
TEST(Rerun, WithoutSpaceForARecordLeavesTheEarlierRun) {
  const BenchCommand bench;
  ASSERT_EQ(bench.run(six + "--out=o").code, 0);
  const std::string before = bench.results("o");
  expect_refused(bench.run(six + "--out=o", "ulimit -f 2; "),
                 "o/records.jsonl: cannot be written: File too large");
  EXPECT_EQ(bench.results("o"), before);
  std::filesystem::create_directories(bench.path("more"));
  testing::write_text(bench.path("more/records.jsonl"), bench.content("o/records.jsonl"));
  expect_refused(bench.run("merge more --out=o", "ulimit -f 16; "),
                 "cannot be written: File too large");
  EXPECT_EQ(bench.results("o"), before);
}

TEST(Resume, RefusesToMixAndSaysWhatDiffers) {
  const BenchCommand bench;
  ASSERT_EQ(bench.run("--mesh=Mesh0 --method=HYBRID --repetitions=1 --out=o").code, 0);
  const std::string before = bench.content("o/records.jsonl");
  const auto refused = [&](const std::string& arguments, const std::string& what) {
    const CommandResult result =
        bench.run("--mesh=Mesh0 --method=HYBRID --out=o --resume " + arguments);
    expect_refused(result, "o/records.jsonl:1: of another run");
    expect_found(result.err, what);
  };
  refused("--repetitions=1 --threads=2", "; threads: 1 and 2");
  refused("--repetitions=1 --target-error=1e-7", ": target_error: 1e-06 and 1e-07");
  refused("--repetitions=2", ": repetitions: 1 and 2");
  refused("--repetitions=1 --memory-limit=500", ": memory_limit_bytes: none and 524288000");
  expect_refused(bench.run("--mesh=Mesh0 --method=HYBRID,P2 --repetitions=1 --out=o --resume"),
                 ": cases_planned: 1 and 2; plan_sha256: ");
  EXPECT_EQ(bench.content("o/records.jsonl"), before);
  // Another machine, another build: as the records say.
  for (const auto& [key, now] : {std::pair("cpu", "Abacus"), std::pair("compiler", "pencil")}) {
    Json record = Json::parse(before);
    record["context"][key] = now;
    testing::write_text(bench.path("o/records.jsonl"), record.dump() + "\n");
    refused("--repetitions=1", std::string(key) + ": " + now + " and ");
  }
}

TEST(Interrupt, LeavesWhatWasMeasuredAndNoProcess) {
  const std::string slow = "--mesh=Mesh0,Mesh3 --method=HYBRID,SYMMLQ:NONE --out=o";
  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
    const BenchCommand bench;
    BackgroundRun run(bench, slow);
    std::set<pid_t> children;
    wait_for([&] {
      children = descendants(run.pid());
      return children.size() >= 2 && !bench.records().empty();
    });
    const int status = run.end(signal);
    for (const pid_t child : children) wait_for([&] { return !is_there(child); });
    EXPECT_GE(bench.records().size(), 1u);
    if (signal == SIGKILL) continue;
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 128 + signal);
    expect_found(bench.content("bg_err.txt"), "--resume goes on");
    EXPECT_EQ(bench.content("o/results.csv").substr(0, 5), "mesh,");
  }
}

TEST(Interrupt, BeforeTheFirstRecordLeavesTheEarlierRun) {
  const BenchCommand bench;
  ASSERT_EQ(bench.run("--mesh=Mesh0 --method=HYBRID --repetitions=1 --out=o").code, 0);
  const std::string before = bench.content("o/results.csv");
  BackgroundRun run(bench, "--mesh=Mesh3 --method=SYMMLQ:NONE --out=o");
  wait_for([&] { return descendants(run.pid()).size() >= 2; });
  run.end(SIGINT);
  EXPECT_EQ(bench.content("o/results.csv"), before);
  EXPECT_EQ(bench.records().size(), 1u);
}

TEST(Interrupt, OfASolveNamesTheSignalOnly) {
  const BenchCommand bench;
  testing::write_text(bench.path("tooth.json"), "{}");
  BackgroundRun run(bench, "solve Mesh3 tooth.json --error=0.001% --out=o");
  wait_for([&] { return !descendants(run.pid()).empty(); });
  const int status = run.end(SIGINT);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 128 + SIGINT);
  EXPECT_TRUE(bench.content("bg_err.txt").ends_with("bench: ended by SIGINT\n"))
      << bench.content("bg_err.txt");
}

TEST(Shards, JoinToTheWhole) {
  const BenchCommand bench;
  ASSERT_EQ(bench.run(six + "--out=whole").code, 0);
  for (const char* shard : {"1", "2", "3"})
    ASSERT_EQ(bench.run(six + "--shard=" + shard + "/3 --out=part" + shard).code, 0);
  EXPECT_EQ(bench.records("part2").size(), 2u);
  const CommandResult merged = bench.run("merge part3 part1 part2 --out=joined");
  EXPECT_EQ(merged.code, 0) << merged.err;
  EXPECT_EQ(by_name(bench.records("joined")), by_name(bench.records("whole")));
  std::vector<int> numbers;
  for (const Json& record : bench.records("joined")) numbers.push_back(record["case_number"]);
  EXPECT_EQ(numbers, (std::vector<int>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(bench.content("joined/results.csv").substr(0, 5), "mesh,");

  const auto refused = [&](const std::string& arguments, const std::string& why) {
    expect_merge_refused(bench, arguments, why);
  };
  refused("part1 part3", "2 of 6 cases are missing: 2, 5");
  refused("part1 part2 part3 part2", "both are case 2, Mesh0/default/BLIND");
  refused("part1 part2 nowhere", "nowhere/records.jsonl: no such file");
  EXPECT_EQ(bench.run("merge part1 part3 --incomplete --out=some").code, 0);
  EXPECT_EQ(bench.records("some").size(), 4u);
  ASSERT_EQ(bench.run(six + "--shard=2/3 --target-error=1e-5 --out=other").code, 0);
  refused("part1 other part3", "do not mix: target_error: 1e-06 and 1e-05");
  ASSERT_EQ(
      bench.run("--mesh=Mesh0 --method=HYBRID,P2 --repetitions=1 --shard=2/2 --out=other").code, 0);
  refused("part1 other", "do not mix: cases_planned: 6 and 2; plan_sha256: ");
  ASSERT_EQ(
      bench
          .run("--mesh=Mesh0 --method=3STEPD,BLIND,BLIND:SCHUR,3STEPD:CHOLMOD,HYBRID,BLIND:SKY "
               "--repetitions=1 --shard=2/3 --out=other")
          .code,
      0);
  refused("part1 other part3", "do not mix: plan_sha256: ");
}

TEST(Runs, OfDifferentPlansJoinInTheirOrder) {
  const BenchCommand bench;
  const std::string hybrid = "--mesh=Mesh0 --method=HYBRID --repetitions=1 ";
  ASSERT_EQ(bench.run("--mesh=Mesh0 --method=P2,3STEPD --repetitions=2 --out=a").code, 0);
  ASSERT_EQ(bench.run(hybrid + "--timeout=60 --out=b").code, 0);
  const CommandResult joined = bench.run("merge --runs b a --out=joined");
  EXPECT_EQ(joined.code, 0) << joined.err;
  std::vector<std::string> methods;
  for (const Json& record : bench.records("joined")) methods.push_back(record["method"]);
  EXPECT_EQ(methods, (std::vector<std::string>{"HYBRID", "3STEPD", "P2"}));

  const auto refused = [&](const std::string& arguments, const std::string& why) {
    expect_merge_refused(bench, arguments, why);
  };
  refused("a b", "do not mix: ");
  refused("--runs a b a", "both are Mesh0/default/3STEPD");
  // As of a run that has not ended.
  const std::string lines = bench.content("a/records.jsonl");
  std::filesystem::create_directories(bench.path("begun"));
  testing::write_text(bench.path("begun/records.jsonl"), lines.substr(0, lines.find('\n') + 1));
  refused("--runs b begun", "1 of 2 cases are missing: 2 (");
  EXPECT_EQ(bench.run("merge --runs --incomplete b begun --out=some").code, 0);
  EXPECT_EQ(bench.records("some").size(), 2u);
  ASSERT_EQ(bench.run(hybrid + "--target-error=1e-5 --out=c").code, 0);
  refused("--runs a c", "do not mix: target_error: 1e-06 and 1e-05");
}

TEST(Shards, AreRefusedWhenTheyAreNone) {
  const BenchCommand bench;
  for (const char* shard : {"0/3", "4/3", "1", "1/", "/2", "1/2/3", "-1/2", "one/two"}) {
    const CommandResult result = bench.run(std::string("--shard=") + shard);
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.err,
              "bench: --shard: " + std::string(shard) + " (allowed: k/n with 1 <= k <= n)\n");
  }
}

TEST(Replay, RunsOneRecordedCaseAgain) {
  const BenchCommand bench;
  ASSERT_EQ(bench
                .run("--mesh=Mesh0 --method=3STEPD,HYBRID --repetitions=2 --interleave --out=o "
                     "-- --benchmark_context=lab=cellar")
                .code,
            0);
  for (const char* record : {"o:2", "o:Mesh0/default/HYBRID"}) {
    const CommandResult result = bench.run(std::string("replay ") + record + " --out=again");
    EXPECT_EQ(result.code, 0) << result.err << result.out;
    EXPECT_EQ(bench.records("again").size(), 1u);
    EXPECT_EQ(lasting(bench.records("again")[0])["error_stress"],
              bench.records()[1]["error_stress"]);
    EXPECT_EQ(bench.records("again")[0]["samples_s"].size(), 2u);
  }
  const auto changed = [&](const std::string& key, const Json& value, const Json& context = {}) {
    Json record = bench.records()[1];
    record[key] = value;
    if (context.is_object()) record["context"].update(context);
    std::filesystem::create_directories(bench.path("c"));
    testing::write_text(bench.path("c/records.jsonl"), record.dump() + "\n");
    return bench.run("replay c:1 --out=again2");
  };
  const CommandResult differing = changed("n_slip", 1);
  EXPECT_EQ(differing.code, 1);
  expect_found(differing.out, "differs");
  expect_refused(changed("mesh_sha256", "0123"), "is not the mesh of the record");
  expect_refused(changed("study", nullptr, {{"program_sha256", "0123"}}),
                 "program_sha256: 0123 and ");
  EXPECT_EQ(bench.run("replay c:1 --other-program --out=again2").code, 0);
  expect_refused(bench.run("replay o:1 --out=./o"), "allowed: another folder than the record's");
  EXPECT_EQ(bench.records().size(), 2u);
}

TEST(Replay, KeepsSceneAndKnob) {
  const BenchCommand bench;
  testing::write_text(bench.path("flat.json"), R"({"crown_radius_mm": null, "friction": 0.4})");
  ASSERT_EQ(bench
                .run("--study=error --mesh=Mesh0 --method=HYBRID --scene=flat.json "
                     "--repetitions=1 --out=o")
                .code,
            1);  // the coarse points of the knob are not ok
  std::filesystem::remove(bench.path("flat.json"));
  const Json recorded = bench.records()[1];
  ASSERT_TRUE(recorded["knob_value"].is_number());
  const CommandResult result = bench.run("replay o:2 --out=again");
  EXPECT_EQ(result.code, 0) << result.err << result.out;
  const Json again = bench.records("again")[0];
  for (const char* key : {"scene", "knob", "knob_value", "study", "error_force", "n_slip"})
    EXPECT_EQ(again[key], recorded[key]) << key;
}

}  // namespace
}  // namespace airybench::resume_test
