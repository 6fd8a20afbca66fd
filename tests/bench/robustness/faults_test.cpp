// Faults of the machine: whichever open, write, fsync, rename, fork, send or recv of a run
// fails, the run ends with an exit code, leaves nothing half-written, and --resume comes to the
// undisturbed result.
#include <gtest/gtest.h>

#include <map>

#include "tests/support/background_run.hpp"
#include "tests/support/bench_command.hpp"
#include "tests/support/places.hpp"

namespace airybench::faults_test {
namespace {

namespace fs = std::filesystem;

using testing::BenchCommand;
using testing::CommandResult;

const std::string two = "--mesh=Mesh0 --method=HYBRID,P2 --repetitions=1 --fields --out=o ";

std::map<std::string, std::string> lasting(const BenchCommand& bench) {
  std::map<std::string, std::string> result;
  for (const Json& record : bench.records()) {
    std::string& text = result[record["method"].get<std::string>()];
    EXPECT_EQ(text, "") << "a record is there twice";
    for (const char* key : {"status", "status_reason", "error_stress", "n_slip", "answer_hash",
                            "case_number", "storage_bytes"})
      text += record[key].dump() + " ";
  }
  return result;
}

std::map<std::string, std::string> fields(const BenchCommand& bench) {
  std::map<std::string, std::string> result;
  for (const auto& entry : fs::directory_iterator(bench.path("o/fields")))
    result[entry.path().filename().string()] = testing::text_of(entry.path());
  return result;
}

std::string strangers(const BenchCommand& bench) {
  std::string found;
  for (const auto& entry : fs::recursive_directory_iterator(bench.path("o")))
    if (const std::string name = entry.path().filename().string(); name.find(".part") != name.npos)
      found += name + " ";
  return found;
}

// How the shell begins a run whose n-th call of a kind fails.
std::string with_fault(const std::string& kind, int n) {
  return "AIRYBENCH_FAULT_TOLD=told AIRYBENCH_FAULT=" + kind + ":" + std::to_string(n) +
         " LD_PRELOAD='" + (testing::build_folder() / "tests/libnth_fault.so").string() + "' ";
}

class NthFault : public ::testing::TestWithParam<const char*> {};

TEST_P(NthFault, IsSurvivedAndResumed) {
  const BenchCommand undisturbed;
  ASSERT_EQ(undisturbed.run(two).code, 0);
  const auto records = lasting(undisturbed);
  const auto pictures = fields(undisturbed);
  ASSERT_EQ(records.size(), 2u);
  int failures = 0;
  for (bool failed = true; failed; failures += failed) {
    const BenchCommand bench;
    const int n = 1 + failures;
    const std::string fault = GetParam() + std::string(":") + std::to_string(n);
    const CommandResult result = bench.run(two, with_fault(GetParam(), n));
    failed = fs::exists(bench.path("told"));
    EXPECT_GE(result.code, 0) << fault << ": ended by a signal: " << result.err;
    EXPECT_LE(result.code, 2) << fault << ": " << result.err;
    if (!failed) {
      EXPECT_EQ(result.code, 0) << result.err;
    }
    if (!fs::exists(bench.path("o"))) continue;
    EXPECT_EQ(strangers(bench), "") << fault;
    const CommandResult resumed = bench.run(two + "--resume");
    EXPECT_EQ(resumed.code, 0) << fault << ": " << resumed.err << resumed.out;
    EXPECT_EQ(lasting(bench), records) << fault;
    EXPECT_EQ(fields(bench), pictures) << fault;
    EXPECT_EQ(bench.content("o/results.csv").substr(0, 5), "mesh,") << fault;
  }
  EXPECT_GE(failures, 3) << "this test fails nothing";
  std::cout << failures << " calls of " << GetParam() << " failed, one at a time\n";
}
INSTANTIATE_TEST_SUITE_P(Of, NthFault,
                         ::testing::Values("open", "write", "fsync", "rename", "fork", "send",
                                           "recv"),
                         [](const auto& of) { return std::string(of.param); });

// What a disk does not give back is told, and changes no file.
TEST(NthRead, ThatFailsIsNoDefectOfTheProgram) {
  int faults = 0, refused = 0;
  bool failed = true;
  for (int n = 1; failed; n += n < 10 ? 1 : 23, ++faults) {  // many are of the program itself
    const BenchCommand bench;
    SCOPED_TRACE("read " + std::to_string(n));
    const CommandResult result =
        bench.run("--mesh=Mesh0 --method=HYBRID --repetitions=1 --out=o", with_fault("read", n));
    failed = fs::exists(bench.path("told"));
    EXPECT_GE(result.code, 0) << "ended by a signal: " << result.err;
    EXPECT_LE(result.code, 2) << result.err;
    EXPECT_FALSE(testing::contains(result.err, "defect"));
    if (result.code != 2) continue;
    ++refused;
    EXPECT_TRUE(testing::contains(result.err, "Input/output error"));
  }
  EXPECT_GE(refused, 1) << "this test fails nothing";
  std::cout << faults - 1 << " reads failed, one at a time\n";
}

// Of some six thousand, in all three processes: of the program, and of BLAS, CHOLMOD and the rest.
// A method that got no memory says so, as it does under --memory-limit, and is not run again.
TEST(NthAllocation, IsSurvivedAndResumed) {
  const char* const asked = std::getenv("AIRYBENCH_ALLOCATION_STRIDE");
  const int stride = asked == nullptr ? 199 : std::atoi(asked);
  constexpr int first_ones = 10;  // main() is not yet ready for everything
  const std::string one = "--mesh=./m.msh --method=HYBRID --repetitions=1 --out=o ";
  const auto place_mesh = [](const BenchCommand& bench) {
    fs::copy_file(testing::test_data("fuzz/mesh/good-groups"), bench.path("m.msh"));
  };
  const BenchCommand undisturbed;
  place_mesh(undisturbed);
  ASSERT_EQ(undisturbed.run(one).code, 0);
  const auto records = lasting(undisturbed);
  int failures = 0, without_memory = 0;
  bool failed = true;
  for (int n = 1; failed; n += n < first_ones ? 1 : stride) {
    const BenchCommand bench;
    place_mesh(bench);
    SCOPED_TRACE("allocation " + std::to_string(n));
    const CommandResult result = bench.run(one, with_fault("alloc", n));
    failed = fs::exists(bench.path("told"));
    failures += failed;
    EXPECT_GE(result.code, 0) << "ended by a signal: " << result.err;
    EXPECT_LE(result.code, 3) << result.err;
    // The JSON library allocates in destructors, where a refusal ends the run without any others.
    const bool is_ended_at_once = result.code == 3;
    if (fs::exists(bench.path("o")) && !is_ended_at_once) {
      EXPECT_EQ(strangers(bench), "");
    }
    const CommandResult resumed = bench.run(one + "--resume");
    ASSERT_LE(resumed.code, 1) << resumed.err;
    EXPECT_EQ(strangers(bench), "");
    if (resumed.code == 0) {
      EXPECT_EQ(lasting(bench), records);
      continue;
    }
    ++without_memory;
    ASSERT_EQ(bench.records().size(), 1u);
    const Json record = bench.records().front();
    EXPECT_TRUE(record["status"] == "out_of_memory" ||
                record["status_reason"].get<std::string>().ends_with("memory"))
        << record["status"] << record["status_reason"];
  }
  EXPECT_GE(failures, 4) << "this test fails nothing";
  EXPECT_LT(without_memory, failures / 2);
  std::cout << failures << " allocations refused, one at a time; the method said so of "
            << without_memory << "\n";
}

TEST(MachineFault, IsNotTheMethodsAndIsRunAgain) {
  const BenchCommand bench;
  fs::create_directories(bench.path("o"));
  testing::write_text(bench.path("o/fields"), "in the way");
  EXPECT_EQ(bench.run(two).code, 1);
  for (const Json& record : bench.records()) {
    EXPECT_EQ(record["status"], "machine_fault");
    EXPECT_TRUE(testing::contains(record["status_reason"].get<std::string>(),
                                  "o/fields: cannot be made a folder"))
        << record["status_reason"];
  }
  fs::remove(bench.path("o/fields"));
  const CommandResult resumed = bench.run(two + "--resume");
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  ASSERT_EQ(bench.records().size(), 2u);
  for (const Json& record : bench.records()) EXPECT_EQ(record["status"], "ok");
}

TEST(MachineFault, OfALimitOnProcessorTime) {
  const BenchCommand bench;
  EXPECT_EQ(
      bench.run("--mesh=Mesh3 --method=SYMMLQ:NONE --repetitions=1 --out=o", "ulimit -t 2; ").code,
      1);
  ASSERT_EQ(bench.records().size(), 1u);
  EXPECT_EQ(bench.records()[0]["status"], "machine_fault") << bench.records()[0]["status_reason"];
  EXPECT_TRUE(testing::contains(bench.records()[0]["status_reason"].get<std::string>(),
                                "limit on processor time"));
}

// Forks of a run, in turn: the sign of life while the mesh is read, the scene, the method.
constexpr int method_fork = 3;

// Of the program's guardian and of the program.
TEST(MachineFault, OfAProgramThatCannotBeForked) {
  for (const int fork : {method_fork + 1, method_fork + 2}) {
    const BenchCommand bench;
    testing::write_text(bench.path("one.json"),
                        R"({"name": "one", "reads": "condensed", "format": "matrix-market",
                            "returns": "contact_forces", "command": ["true"]})");
    EXPECT_EQ(bench
                  .run("--external=one.json --method='EXTERNAL:*' --mesh=Mesh0 --out=o",
                       with_fault("fork", fork))
                  .code,
              1);
    EXPECT_TRUE(fs::exists(bench.path("told"))) << "nothing failed";
    EXPECT_EQ(bench.record()["status"], "machine_fault") << bench.record()["status_reason"];
  }
}

// Its fork waits for ever: 20 seconds later the main process no longer does.
TEST(MachineFault, OfASilentProcess) {
  const BenchCommand bench;
  EXPECT_EQ(bench.run(two, with_fault("hang", method_fork)).code, 1);
  ASSERT_EQ(bench.records().size(), 2u);
  EXPECT_EQ(bench.records()[0]["status"], "machine_fault") << bench.records()[0]["status_reason"];
  EXPECT_TRUE(
      testing::contains(bench.records()[0]["status_reason"].get<std::string>(), "did not answer"));
  EXPECT_EQ(bench.records()[1]["status"], "ok") << bench.records()[1]["status_reason"];
}

// A process that somebody stops is not waited for without end.
TEST(MachineFault, OfAStoppedProcess) {
  for (const bool the_scenes : {true, false}) {
    const BenchCommand bench;
    testing::BackgroundRun run(bench, "--mesh=Mesh3 --method=SYMMLQ:NONE --repetitions=1 --out=o");
    std::vector<pid_t> scenes, own;
    testing::wait_for([&] {
      scenes = testing::children_of(run.pid());
      if (!scenes.empty()) own = testing::children_of(scenes[0]);
      return !own.empty();
    });
    kill(the_scenes ? scenes[0] : own[0], SIGSTOP);
    const int status = run.end(0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 1);
    ASSERT_EQ(bench.records().size(), 1u);
    EXPECT_EQ(bench.records()[0]["status"], "machine_fault") << bench.records()[0]["status_reason"];
  }
}

}  // namespace
}  // namespace airybench::faults_test
