// The bench command from outside: exit codes, one-line complaints, output files.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "solvers/methods.hpp"
#include "tests/support/temporary_folder.hpp"

namespace airybench {
namespace {

namespace fs = std::filesystem;

struct Result {
  int code = -1;
  std::string out, err;
};

std::string content(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

class Command : public ::testing::Test {
 protected:
  Result bench(const std::string& arguments) const {
    const std::string command = "cd '" + folder_.string() + "' && '" BENCH_EXECUTABLE "' " +
                                arguments + " >out.txt 2>err.txt </dev/null";
    Result result;
    const int status = std::system(command.c_str());
    result.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    result.out = content(folder_ / "out.txt");
    result.err = content(folder_ / "err.txt");
    return result;
  }
  // Wrong usage: exit code 2, one line, no output folder.
  void expect_usage_error(const std::string& arguments, const std::string& line) const {
    const Result result = bench(arguments);
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_EQ(result.err, "bench: " + line + "\n") << arguments;
    EXPECT_FALSE(fs::exists(folder_ / "results")) << arguments;
  }
  fs::path file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  const testing::TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

TEST_F(Command, MeasuresOneCaseAndWritesThreeFiles) {
  const Result result = bench("--mesh=Mesh0 --method=3STEPD --repetitions=3 --out=o");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.err.find("[1/1] Mesh0 default 3STEPD: ok, "), std::string::npos);
  EXPECT_NE(result.out.find("error force"), std::string::npos);

  const auto record = nlohmann::json::parse(content(folder_ / "o/records.jsonl"));
  EXPECT_EQ(record["status"], "ok");
  EXPECT_EQ(record["n_phi"], 761);
  EXPECT_EQ(record["n_f"], 96);
  EXPECT_EQ(record["n_c"], 40);
  EXPECT_EQ(record["samples_s"].size(), 3u);
  EXPECT_LT(record["error_force"], 1e-9);
  EXPECT_EQ(record["mesh_sha256"].get<std::string>().size(), 64u);
  EXPECT_EQ(record["context"]["blas_threads"], "1");
  EXPECT_TRUE(record["context"].contains("git_revision"));

  const std::string csv = content(folder_ / "o/results.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 2);

  const auto google = nlohmann::json::parse(content(folder_ / "o/results.json"));
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

TEST_F(Command, FailedCasesAreRecordedAndExitWithOne) {
  const Result slow =
      bench("--mesh=Mesh0 --method=3STEPD --timeout=1e-9 --repetitions=2 --out=slow");
  EXPECT_EQ(slow.code, 1);
  EXPECT_EQ(nlohmann::json::parse(content(folder_ / "slow/records.jsonl"))["status"], "timeout");
  EXPECT_TRUE(fs::exists(folder_ / "slow/results.csv"));
  EXPECT_NE(slow.out.find("timeout: time limit reached during"), std::string::npos);

  const Result strict =
      bench("--mesh=Mesh0 --method=3STEPD --target-error=1e-16 --repetitions=2 --out=strict");
  EXPECT_EQ(strict.code, 1);
  const auto record = nlohmann::json::parse(content(folder_ / "strict/records.jsonl"));
  EXPECT_EQ(record["status"], "inaccurate");
  EXPECT_FALSE(record["time_s"].is_null());  // measured all the same, with its error beside it
}

TEST_F(Command, WritesFieldsOnRequest) {
  const Result result =
      bench("--mesh=Mesh0 --method=3STEPD:CHOLMOD --repetitions=1 --fields --out=o");
  ASSERT_EQ(result.code, 0) << result.err;
  const std::string stress = content(folder_ / "o/fields/Mesh0-default-3STEPD-CHOLMOD.stress.csv");
  EXPECT_EQ(std::count(stress.begin(), stress.end(), '\n'), 1 + 9 * 226);
  const std::string contact =
      content(folder_ / "o/fields/Mesh0-default-3STEPD-CHOLMOD.contact.csv");
  EXPECT_EQ(std::count(contact.begin(), contact.end(), '\n'), 1 + 20);
}

TEST_F(Command, TakesAUsersMeshAndScene) {
  fs::copy_file(fs::path(MESH_DIR) / "Mesh0.msh", folder_ / "mine.msh");
  file("flat.json", R"({"crown_radius_mm": null, "friction": 0})");
  const Result result =
      bench("--mesh=mine.msh --scene=flat.json --method=3STEPD --repetitions=1 --out=o");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto record = nlohmann::json::parse(content(folder_ / "o/records.jsonl"));
  EXPECT_EQ(record["mesh"], "mine");
  EXPECT_EQ(record["scene"], "flat");
  EXPECT_EQ(record["n_c"], 20);
  EXPECT_TRUE(record["coulomb_violation_N"].is_null());
}

TEST_F(Command, ListsPlansAndExplainsWithoutMeasuring) {
  EXPECT_NE(bench("--list").out.find("*3STEPD "), std::string::npos);
  const Result plan = bench("--mesh=Mesh0..Mesh7 --method='*' --dry-run");
  EXPECT_EQ(plan.code, 0);
  EXPECT_EQ(std::count(plan.out.begin(), plan.out.end(), '\n'),
            static_cast<std::ptrdiff_t>(8 * select_methods("*").size()));
  EXPECT_NE(plan.out.find("] Mesh7/default/3STEPD  n_phi 50483, n_f 920, n_c 640\n"),
            std::string::npos);
  file("smooth.json", R"({"friction": 0})");
  EXPECT_NE(bench("--mesh=Mesh0 --scene=smooth.json --dry-run").out.find("n_f 116, n_c 20\n"),
            std::string::npos);  // as records say it
  EXPECT_NE(bench("--mesh=Mesh0 --explain").out.find("left out  assemble F: no traction"),
            std::string::npos);
  EXPECT_EQ(bench("--help").code, 0);
  EXPECT_EQ(bench("--version").code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "results"));
}

TEST_F(Command, WrongUsageIsOneLineAndNothingIsWritten) {
  const Result unknown = bench("--method=4STEP");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_EQ(unknown.err.rfind("bench: no method matches '4STEP' (valid: SDTIC3, ", 0), 0u);
  EXPECT_EQ(std::count(unknown.err.begin(), unknown.err.end(), '\n'), 1);
  expect_usage_error("--mesh=nowhere.msh", "nowhere.msh: cannot be opened");
  expect_usage_error("--scene=nowhere.json", "nowhere.json: cannot be opened as a scene file");
  file("bad.json", R"({"friction": -2})");
  expect_usage_error("--scene=bad.json", "bad.json: friction: -2 (allowed: >= 0)");
  file("four.json", R"({"teeth": 4})");
  expect_usage_error("--mesh=Mesh0 --scene=four.json",
                     "four.json: teeth: 4 contradicts the mesh Mesh0, which has 1 contact face(s)");
  file("broken.msh", "hello\n");
  expect_usage_error("--mesh=broken.msh",
                     "broken.msh:1: not a mesh file: the first line must be $MeshFormat");
  EXPECT_EQ(bench("--mesh=Mesh9").code, 2);
  for (const char* arguments : {"--repetitions=0", "--repetitions=x", "--timeout=-1", "--threads=0",
                                "--target-error=0", "--memory-limit=0", "--wrong", "extra"}) {
    const Result result = bench(arguments);
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_FALSE(fs::exists(folder_ / "results")) << arguments;
  }
}

TEST_F(Command, AnOutputFolderThatCannotBeMadeIsNamed) {
  file("taken", "a file");
  const Result result = bench("--mesh=Mesh0 --repetitions=1 --out=taken/inside");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err, "bench: taken/inside: cannot be made a folder: Not a directory\n");
}

TEST_F(Command, HandsTheRestToGoogleBenchmark) {
  const Result result =
      bench("--mesh=Mesh0 --method='3STEP*' --repetitions=2 --out=o -- --benchmark_filter=CHOLMOD");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(nlohmann::json::parse(content(folder_ / "o/records.jsonl"))["method"],
            "3STEPD:CHOLMOD");
}

TEST_F(Command, InterleavedRepetitionsAreAllRecorded) {
  const Result result = bench(
      "--mesh=Mesh0,Mesh3 --method=HYBRID --repetitions=6 --out=o -- "
      "--benchmark_enable_random_interleaving=true");
  ASSERT_EQ(result.code, 0) << result.err;
  std::istringstream lines(content(folder_ / "o/records.jsonl"));
  std::map<std::string, nlohmann::json> records;
  for (std::string line; std::getline(lines, line);) {
    const auto record = nlohmann::json::parse(line);
    records[record["mesh"]] = record;
  }
  ASSERT_EQ(records.size(), 2u);
  const auto &small = records["Mesh0"]["samples_s"], &large = records["Mesh3"]["samples_s"];
  EXPECT_EQ(small.size(), 6u);
  EXPECT_EQ(large.size(), 6u);
  EXPECT_EQ(records["Mesh0"]["n_phi"], 761);
  EXPECT_EQ(records["Mesh3"]["n_phi"], 6287);
}

TEST_F(Command, ArgumentsThatCannotBeUsedLeaveEarlierResultsAlone) {
  ASSERT_EQ(bench("--mesh=Mesh0 --repetitions=1 --out=o").code, 0);
  const auto all = [&] {
    return content(folder_ / "o/records.jsonl") + content(folder_ / "o/results.csv") +
           content(folder_ / "o/results.json");
  };
  const std::string before = all();
  for (const char* arguments :
       {"--no_such_option", "--benchmark_out=x", "--benchmark_report_aggregates_only=true",
        "--benchmark_filter=NoSuchCase", "--benchmark_list_tests"}) {
    const Result result =
        bench(std::string("--mesh=Mesh0 --repetitions=1 --out=o -- ") + arguments);
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_NE(result.err.find("bench: "), std::string::npos) << result.err;
    EXPECT_EQ(all(), before) << arguments;
    EXPECT_FALSE(fs::exists(folder_ / "o/results.json.part")) << arguments;
  }
}

}  // namespace
}  // namespace airybench
