// The bench command from outside: exit codes, records, output files; plan_test.cpp.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <map>

#include "bench/commands/commands.hpp"
#include "bench/records/json.hpp"
#include "tests/support/background_run.hpp"
#include "tests/support/bench_command.hpp"
#include "tests/support/places.hpp"
#include "tests/support/sanitized.hpp"

namespace airybench::command_test {
namespace {

namespace fs = std::filesystem;

using testing::BenchCommand;
using testing::CommandResult;
using testing::lines_of;
using testing::write_text;

TEST(Command, MeasuresOneCaseAndWritesThreeFiles) {
  const BenchCommand bench;
  const CommandResult result = bench.run("--mesh=Mesh0 --method=3STEPD --repetitions=3 --out=o");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.err.find("[1/1] Mesh0/default/3STEPD: ok, "), std::string::npos);
  EXPECT_NE(result.out.find("error stress"), std::string::npos);

  const auto record = bench.record();
  EXPECT_EQ(record["status"], "ok");
  EXPECT_EQ(record["n_phi"], 761);
  EXPECT_EQ(record["n_f"], 96);
  EXPECT_EQ(record["n_c"], 40);
  EXPECT_EQ(record["samples_s"].size(), 3u);
  EXPECT_LT(record["error_force"], 1e-9);
  EXPECT_EQ(record["mesh_sha256"].get<std::string>().size(), 64u);
  EXPECT_EQ(record["context"]["blas_threads"], "1");
  EXPECT_TRUE(record["context"].contains("git_revision"));

  const std::string csv = bench.content("o/results.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 2);

  const auto google = Json::parse(bench.content("o/results.json"));
  int iterations = 0;
  for (const auto& run : google["benchmarks"]) {
    if (run["run_type"] != "iteration") continue;
    ++iterations;
    EXPECT_EQ(run["run_name"].get<std::string>().rfind("Mesh0/default/3STEPD", 0), 0u);
    EXPECT_LT(run["error_force"], 1e-9);
    EXPECT_GT(run["real_time"], 0);
  }
  EXPECT_EQ(iterations, 3);
  EXPECT_EQ(google["context"]["blas_threads"], "1");
}

TEST(Command, FailedCasesAreRecordedAndExitWithOne) {
  const BenchCommand bench;
  const CommandResult slow =
      bench.run("--mesh=Mesh0 --method=3STEPD --timeout=1e-9 --repetitions=2 --out=slow");
  EXPECT_EQ(slow.code, 1);
  EXPECT_EQ(bench.record("slow")["status"], "timeout");
  EXPECT_TRUE(fs::exists(bench.path("slow/results.csv")));
  EXPECT_NE(slow.out.find("timeout: time limit reached during"), std::string::npos);

  const CommandResult strict =
      bench.run("--mesh=Mesh0 --method=3STEPD --target-error=1e-16 --repetitions=2 --out=strict");
  EXPECT_EQ(strict.code, 1);
  const auto record = bench.record("strict");
  EXPECT_EQ(record["status"], "inaccurate");
  EXPECT_FALSE(record["time_s"].is_null());  // measured all the same, with its error beside it
}

TEST(Command, WritesFieldsOnRequest) {
  const BenchCommand bench;
  const CommandResult result = bench.run(
      "--mesh=Mesh0 --method=SDTIC6,3STEPD:CHOLMOD --repetitions=1 --fields=histories --out=o");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_FALSE(bench.records()[0]["histories"].empty());  // of SDTIC6
  const std::string stress = bench.content("o/fields/Mesh0--default--3STEPD+CHOLMOD.stress.csv");
  EXPECT_EQ(std::count(stress.begin(), stress.end(), '\n'), 1 + 9 * 226);
  const std::string contact = bench.content("o/fields/Mesh0--default--3STEPD+CHOLMOD.contact.csv");
  EXPECT_EQ(std::count(contact.begin(), contact.end(), '\n'), 1 + 20);
  // Of another run of the case they would be another answer's.
  EXPECT_EQ(bench.run("--mesh=Mesh0 --method=3STEPD:CHOLMOD --repetitions=1 --out=o").code, 0);
  for (const auto& file : fs::directory_iterator(bench.path("o/fields")))
    EXPECT_FALSE(testing::contains(file.path().string(), "CHOLMOD")) << file.path();
}

TEST(Command, TakesAUsersMeshAndScene) {
  const BenchCommand bench;
  fs::copy_file(testing::mesh_file("Mesh0"), bench.path("mine.msh"));
  write_text(bench.path("flat.json"), R"({"crown_radius_mm": null, "friction": 0})");
  const CommandResult result =
      bench.run("--mesh=mine.msh --scene=flat.json --method=3STEPD --repetitions=1 --out=o");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto record = bench.record();
  EXPECT_EQ(record["mesh"], "mine");
  EXPECT_EQ(record["mesh_file"], "../mine.msh");
  EXPECT_EQ(bench.run("replay o:1 --out=again/r").code, 0);
  EXPECT_EQ(bench.record("again/r")["mesh_file"], "../../mine.msh");
  EXPECT_EQ(record["scene"], "flat");
  EXPECT_EQ(record["n_c"], 20);
  EXPECT_TRUE(record["coulomb_violation_N"].is_null());
}

TEST(Command, GoogleBenchmarksFilterSelectsCases) {
  const BenchCommand bench;
  const std::string filtered =
      "explain --mesh=Mesh0,Mesh1 --method='3STEPD*' -- --benchmark_filter='";
  const auto cases = [&](const std::string& filter) {
    const CommandResult result = bench.run(filtered + filter + "'");
    EXPECT_EQ(result.code, 0) << result.err;
    return std::ranges::count_if(lines_of(result.out),
                                 [](const std::string& line) { return line.starts_with('['); });
  };
  const auto all = cases("all");
  EXPECT_GT(all, 4);
  EXPECT_EQ(cases("CHOLMOD"), 2);
  EXPECT_EQ(cases("-CHOLMOD"), all - 2);
  EXPECT_EQ(cases("^Mesh1/default/3STEPD(:CHOLMOD)?$"), 2);
  bench.expect_refusal(filtered + "NoSuchCase'",
                       "no case is left: the arguments after -- select none\n");
  bench.expect_refusal(
      filtered + "('",
      "bench: -- --benchmark_filter=(: Unmatched ( or \\( (allowed: extended regular expressions)");
  const CommandResult run = bench.run(
      "--mesh=Mesh0 --method='3STEP*' --repetitions=2 --out=o -- --benchmark_filter=CHOLMOD");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(bench.record()["method"], "3STEPD:CHOLMOD");
}

TEST(Command, InterleavedRepetitionsAreAllRecorded) {
  const BenchCommand bench;
  const CommandResult result = bench.run(
      "--mesh=Mesh0,Mesh3 --method=HYBRID --repetitions=6 --out=o -- "
      "--benchmark_enable_random_interleaving=true");
  ASSERT_EQ(result.code, 0) << result.err;
  std::map<std::string, Json> records;
  for (const Json& record : bench.records()) records[record["mesh"]] = record;
  ASSERT_EQ(records.size(), 2u);
  const auto &small = records["Mesh0"]["samples_s"], &large = records["Mesh3"]["samples_s"];
  EXPECT_EQ(small.size(), 6u);
  EXPECT_EQ(large.size(), 6u);
  EXPECT_EQ(records["Mesh0"]["n_phi"], 761);
  EXPECT_EQ(records["Mesh3"]["n_phi"], 6287);
}

TEST(Command, GeneralNamesAreKeptInTheRecords) {
  const BenchCommand bench;
  const bool few = testing::sanitized;  // iterations
  const std::vector<std::string> names = {"ALM:r=20,rho=32",
                                          few ? "SYMMLQ:SKY,refine=yes" : "SYMMLQ:FLIC2,refine=yes",
                                          few ? "3STEPCG:SKY,refine=yes" : "3STEPCG:SSOR0.7"};
  const CommandResult result =
      bench.run("--mesh=Mesh0 --repetitions=1 --out=o --method=" + names[0] + "," + names[1] + "," +
                names[2]);
  ASSERT_EQ(result.code, 0) << result.err << result.out;
  const std::vector<Json> records = bench.records();
  ASSERT_EQ(records.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    const Json& record = records[k];
    EXPECT_EQ(record["method"], names[k]);
    EXPECT_EQ(record["stop"], "target");
    EXPECT_GT(record["tolerance"], 0);
    EXPECT_LT(record["error_force"], 1e-6);
    EXPECT_LT(record["error_stress"], 1e-6);
    EXPECT_EQ(record["uzawa_iterations"].is_null(), k > 0);
    EXPECT_EQ(record["linear_iterations"].is_null(), k == 0);
  }
  EXPECT_EQ(records[0]["parameters"], "r=20, rho=32");
}

TEST(Command, ThePapersStopIsRecordedWithTheErrorItLeaves) {
  const BenchCommand bench;
  const CommandResult result =
      bench.run("--mesh=Mesh0 --method=SDTIC3,ALM --stop=paper --repetitions=1 --out=o");
  EXPECT_EQ(result.code, 1) << "its error is above the target";
  const std::vector<Json> records = bench.records();
  ASSERT_EQ(records.size(), 2u);
  for (const Json& record : records) {
    EXPECT_EQ(record["stop"], "paper");
    EXPECT_EQ(record["status"], "inaccurate");
    EXPECT_GT(record["error_force"], 1e-7);
    EXPECT_GT(record["time_s"], 0);
  }
  const Json& alm = records[1];
  EXPECT_TRUE(alm["parameters"].get<std::string>().starts_with("r="));
  EXPECT_GT(alm["tuning_s"], 0);
}

TEST(Command, AppendKeepsOtherRecordsAndReplacesTheSameCase) {
  const BenchCommand bench;
  ASSERT_EQ(bench.run("--mesh=Mesh0 --method=3STEPD,HYBRID --repetitions=1 --out=o").code, 0);
  ASSERT_EQ(bench.run("--mesh=Mesh0 --method=3STEPD --repetitions=2 --out=o --append").code, 0);
  ASSERT_EQ(bench.run("--mesh=Mesh1 --method=3STEPD --repetitions=1 --out=o --append").code, 0);
  // Another stop is another case.
  ASSERT_EQ(
      bench.run("--mesh=Mesh1 --method=3STEPD --stop=paper --repetitions=1 --out=o --append").code,
      0);
  std::vector<std::string> found;
  for (const Json& record : bench.records()) {
    found.push_back(record["mesh"].get<std::string>() + " " + record["method"].get<std::string>() +
                    " " + record["stop"].get<std::string>() + " " +
                    std::to_string(record["samples_s"].size()));
  }
  EXPECT_EQ(found, (std::vector<std::string>{"Mesh0 HYBRID target 1", "Mesh0 3STEPD target 2",
                                             "Mesh1 3STEPD target 1", "Mesh1 3STEPD paper 1"}));
  EXPECT_EQ(lines_of(bench.content("o/results.csv")).size(), 5u);
  // Without --append the folder holds what was run last.
  ASSERT_EQ(bench.run("--mesh=Mesh1 --method=HYBRID --repetitions=1 --out=o").code, 0);
  EXPECT_EQ(bench.records().size(), 1u);
}

TEST(Command, ATimeoutTellsWhatWasDone) {
  // However slow the machine: the limit is doubled until something is done within it.
  double limit_s = 0.2;
  Json record;
  for (;; limit_s *= 2) {
    const BenchCommand bench;
    const CommandResult result =
        bench.run("--mesh=Mesh3 --method=3STEPCG:NONE --repetitions=1 --out=o --timeout=" +
                  std::to_string(limit_s));
    ASSERT_EQ(result.code, 1);
    record = bench.record();
    ASSERT_EQ(record["status"], "timeout");
    if (record["done_fraction"] > 0) break;
  }
  EXPECT_TRUE(record["time_s"].is_null());
  EXPECT_LT(record["done_fraction"], 0.9);
  EXPECT_GT(record["extrapolated_time_s"], limit_s);
}

TEST(Command, CountsAreTheSameInEveryRunAndOnTwoThreads) {
  const BenchCommand bench;
  const std::string methods = testing::sanitized
                                  ? "3STEPCG3,BLIND:SKY,HYBRID"
                                  : "3STEPCG3,SDTIC6,ALM:r=20,rho=20,BLIND:SKY,HYBRID";
  const auto counts = [&](const std::string& arguments, std::vector<const char*> keys) {
    EXPECT_EQ(
        bench.run("--mesh=Mesh0 --repetitions=1 --out=o --method=" + methods + arguments).code, 0);
    std::vector<std::string> all;
    for (const Json& record : bench.records())
      for (const char* key : keys) all.push_back(record["method"].dump() + record[key].dump());
    return all;
  };
  const std::vector<const char*> every = {"linear_iterations", "contact_iterations",
                                          "uzawa_iterations", "tolerance", "error_force"};
  const auto first = counts("", every);
  EXPECT_EQ(first.size(), testing::sanitized ? 15u : 25u);
  EXPECT_EQ(counts("", every), first);
  // On two threads too, but for the solves of the check: they correct roundings, and BLAS rounds
  // otherwise there.
  const auto iterations = [&](const std::string& entry) {
    const std::string number = entry.substr(entry.rfind('"') + 1);
    return number == "null" ? 0 : std::stoi(number);
  };
  const auto on_two = counts(" --threads=2", {"linear_iterations"});
  ASSERT_EQ(on_two.size(), first.size() / every.size());
  for (std::size_t k = 0; k < on_two.size(); ++k)
    EXPECT_NEAR(iterations(on_two[k]), iterations(first[k * every.size()]),
                0.02 * iterations(on_two[k]))
        << on_two[k];
}

TEST(Command, ARunLeavesItsCallerWhatToDraw) {
  const BenchCommand bench;
  const std::string run = "--mesh=Mesh0 --method=HYBRID --repetitions=1 --out=\"-it's\" ",
                    caller = "export AIRYBENCH_TO_DRAW=drawn; ";
  for (const char* no_run : {"--dry-run", "--no-such-option"}) {
    bench.run(run + no_run, caller);
    EXPECT_FALSE(fs::exists(bench.path("drawn"))) << no_run;
  }
  const CommandResult result = bench.run(run, caller);
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(bench.content("drawn"), std::string("--\0-it's\0", 9));
  EXPECT_EQ(bench.run(run, "export AIRYBENCH_TO_DRAW=no/such/folder/file; ").code, 0);
}

// As ./run, which waits for it.
TEST(Command, EndsWithTheCallerThatDraws) {
  const BenchCommand bench;
  const pid_t caller = fork();
  if (caller == 0) {
    std::signal(SIGHUP, SIG_DFL);  // nohup may have started the tests
    const std::string command =
        "cd '" + bench.path("").string() + "' && export AIRYBENCH_TO_DRAW=drawn; '" +
        testing::bench_executable().string() +
        "' --mesh=Mesh0,Mesh3 --method=HYBRID,SYMMLQ:NONE --out=o >out.txt 2>err.txt; exit";
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
  testing::wait_for([&] { return !bench.records().empty(); });
  const pid_t program = testing::children_of(caller).at(0);
  kill(caller, SIGKILL);
  waitpid(caller, nullptr, 0);
  testing::wait_for([&] { return !testing::is_there(program); });
  EXPECT_NE(bench.content("err.txt").find("ended by SIGHUP: "), std::string::npos);
  EXPECT_FALSE(fs::exists(bench.path("drawn")));
}

TEST(Command, OptionsThatAreCommandsNowStillWork) {
  const BenchCommand bench;
  const std::string called = testing::bench_executable().string();
  for (const auto& [before, now, shown] : std::vector<std::array<std::string, 3>>{
           {"--list", "list", "list"},
           {"--method=HYBRID --explain -- --benchmark_filter=Mesh0",
            "explain --method=HYBRID -- --benchmark_filter=Mesh0", "explain"},
           {"--check none.json", "check none.json", "check none.json"},
           {"--new-external='a b'", "new-external 'a b'", "new-external 'a b'"},
           {"--new-scene=none.geo --role=a=force", "new-scene none.geo --role=a=force",
            "new-scene none.geo"}}) {
    const CommandResult old = bench.run(before), same = bench.run(now);
    EXPECT_EQ(old.code, same.code) << before;
    EXPECT_EQ(old.out, same.out) << before;
    EXPECT_EQ(old.err, fmt::format("note: --{}: is now {} {} (this version still takes both)\n{}",
                                   now.substr(0, now.find(' ')), called, shown, same.err));
  }
}

TEST(Command, YourOwnBodyIsSolvedByTwoMethods) {
  const BenchCommand bench;
  fs::copy_file(testing::source_folder() / "bench/scenes/check/block.msh", bench.path("part.msh"));
  ASSERT_EQ(bench.run("--mesh=part.msh --repetitions=1 --out=o").code, 0);
  std::vector<std::string> methods;
  for (const Json& record : bench.records()) methods.push_back(record["method"]);
  EXPECT_EQ(methods, (std::vector<std::string>{"HYBRID", "P2"}));
}

TEST(Command, ARunSaysThatItReplacesTheRecordsOfItsFolder) {
  const BenchCommand bench;
  const std::string run = "--mesh=Mesh0 --method=HYBRID --repetitions=1 --out=o ";
  const char* said = "note: o: this run replaces its records (--append keeps them)\n";
  EXPECT_EQ(bench.run(run).err.find(said), std::string::npos);
  EXPECT_NE(bench.run(run).err.find(said), std::string::npos);
  for (const char* kept : {"--append", "--resume"})
    EXPECT_EQ(bench.run(run + kept).err.find(said), std::string::npos) << kept;
}

TEST(Command, HelpIsOneScreenAndNamesEveryCommand) {
  const std::vector<std::string> lines = lines_of(BenchCommand().run("--help").out);
  EXPECT_LE(lines.size(), 45u);
  for (const Command& command : all_commands())
    EXPECT_EQ(std::ranges::count_if(lines,
                                    [&](const std::string& line) {
                                      return line.starts_with(fmt::format("  {} ", command.name));
                                    }),
              1)
        << command.name;
}

// As the script was typed, or else this program.
TEST(Command, HelpBeginsCommandsWithWhatTheUserStarted) {
  const BenchCommand bench;
  const std::string typed = testing::bench_executable().string();
  std::vector<std::string> asked = {"--help", "--help-all"};
  for (const Command& command : all_commands())
    asked.push_back(fmt::format("{} --help", command.name));
  for (const std::string& words : asked) {
    const std::string command = words.starts_with('-') ? "" : words.substr(0, words.find(' ') + 1);
    for (const auto& [before, called] :
         {std::pair("", typed),
          std::pair("export AIRYBENCH_CALLED_AS=../run; ", std::string("../run bench"))}) {
      const std::string help = bench.run(words, before).out;
      EXPECT_NE(help.find("Usage: " + called + " " + command), std::string::npos) << help;
      EXPECT_EQ(help.find("\n  bench "), std::string::npos) << help;
      for (const char* left : {"{bench}", "{run}", "{meshgen}"})
        EXPECT_EQ(help.find(left), std::string::npos) << help;
    }
  }
}

TEST(Command, TheLoopIsProfiledByLevelAndPhase) {
  const std::string out =
      BenchCommand().expect_ok("profile Mesh0 --error=2% --degree=2 --repetitions=2").out;
  for (const char* part :
       {"n_phi 761", "\nrefine ", "\nfactor ", "\nestimate ", "\nall levels: ", "\npage faults: "})
    EXPECT_NE(out.find(part), std::string::npos) << part << " in " << out;
}

TEST(Command, TheListIsComplete) {
  const std::string list = BenchCommand().run("list").out;
  for (const char* part :
       {"Mesh7", "HYBRID:CG", "EXTERNAL:<name>", "newton, gauss-seidel, anderson",
        "CONDENSED, the contact law alone by newton", "\n  stability ", "\n  check "})
    EXPECT_NE(list.find(part), std::string::npos) << part;
}

TEST(Command, ProgressNamesTheLargestError) {
  const CommandResult result = BenchCommand().run(
      "--mesh=Mesh0 --method=ALM:r=20,rho=20 --stop=paper --repetitions=1 --out=o");
  EXPECT_NE(result.err.find(", stress error "), std::string::npos) << result.err;
}

TEST(Command, ALongCaseIsMeasuredOnce) {
  const BenchCommand bench;
  ASSERT_EQ(bench.run("--mesh=Mesh0 --method=3STEPD --repetitions=5,within=0.001 --out=o").code, 0);
  const auto record = bench.record();
  EXPECT_EQ(record["measured_once"], true);
  EXPECT_EQ(record["repetitions"], 1);
  EXPECT_EQ(record["samples_s"].size(), 1u);
  EXPECT_GT(record["time_s"], 0);
  // Null without the heap probe.
  EXPECT_EQ(record["peak_heap_bytes"].is_null(), record["memory_by_owner"].is_null());
}

}  // namespace
}  // namespace airybench::command_test
