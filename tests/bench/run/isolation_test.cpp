// Methods that crash, hang, eat memory or lie: each becomes its case's record, and the run goes on.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <thread>

#include "assembly/problem/scene.hpp"
#include "bench/measure/heap_probe.hpp"
#include "bench/records/record_reader.hpp"
#include "bench/records/summary.hpp"
#include "bench/run/isolated_scene.hpp"
#include "bench/run/runner.hpp"
#include "mesh/refinement.hpp"
#include "solvers/methods.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/support/small_meshes.hpp"
#include "tests/support/test_folder.hpp"

namespace airybench::isolation_test {
namespace {

using Harm = std::function<void(Solution&)>;  // done to HYBRID's answer

// A method that is HYBRID and then does harm; in the factor stage, where it says so.
Method harmful(const std::string& name, Harm harm) {
  Method method = select_methods("HYBRID").front();
  method.name = name;
  method.solve = [solve = method.solve, harm](const ContactSystem& system,
                                              const RunControl& control) {
    Solution solution = solve(system, control);
    const StageTimer timer(solution.times, Stage::factor);
    harm(solution);
    return solution;
  };
  return method;
}

void die_of(int signal) {
  std::signal(signal, SIG_DFL);  // sanitizers have handlers
  std::raise(signal);
}

// As libraries do that the machine refuses memory.
void exit_without_memory() {
  volatile std::size_t too_much = std::numeric_limits<std::ptrdiff_t>::max() / 2;
  void* volatile block = std::malloc(too_much);  // or the compiler leaves it out
  std::free(block);
  std::exit(1);
}

class Isolation : public ::testing::Test {
 protected:
  // The methods between two that are sound.
  std::vector<Record> run_between(std::vector<Method> methods) {
    for (const char* sound : {"HYBRID", "P2"}) methods.push_back(select_methods(sound).front());
    std::rotate(methods.begin(), methods.end() - 1, methods.end());
    std::vector<Record> records = run(methods);
    EXPECT_EQ(records.size(), methods.size());
    for (const Record& sound : {records.front(), records.back()})
      EXPECT_EQ(sound.status, Status::ok) << sound.status_reason;
    return {records.begin() + 1, records.end() - 1};
  }
  Record run_between(const Method& method) {
    return run_between(std::vector<Method>{method}).front();
  }
  std::vector<Record> run(const std::vector<Method>& methods) {
    return run_cases(plan_cases({posed_}, methods, options_.run), options_.limits, options_.output,
                     {})
        .records();
  }

  Isolation() {
    options_.output.folder = folder_ / "o";
    options_.limits.repetitions = 2;
    options_.run.cases.target_error = 1e-6;
    posed_.scene_name = "default";
    posed_.problem = testing::posed(Scene{}, testing::small_tooth(4, 3));
  }
  const testing::TemporaryFolder folder_;
  Options options_;
  PosedScene posed_;
};

TEST_F(Isolation, CrashesExitsAndExceptionsAreRecordsOfTheirCasesAlone) {
  constexpr Status crashed = Status::crashed;
  constexpr const char* factor = "its process was ended in detail run, factor after ";
  // As the kernel does when memory runs out; but it counts those.
  const Status killed = oom_kills() ? Status::machine_fault : Status::out_of_memory;
  const struct {
    const char* name;
    Harm harm;
    Status status;
    const char *ended_in, *reason;
  } harms[] = {
      {"SEGV", [](Solution&) { die_of(SIGSEGV); }, crashed, factor, " by SIGSEGV"},
      {"ABRT", [](Solution&) { die_of(SIGABRT); }, crashed, factor, " by SIGABRT"},
      {"FPE", [](Solution&) { die_of(SIGFPE); }, crashed, factor, " by SIGFPE"},
      {"BUS", [](Solution&) { die_of(SIGBUS); }, crashed, factor, " by SIGBUS"},
      {"KILLED", [](Solution&) { die_of(SIGKILL); }, killed, factor, " by SIGKILL"},
      {"LEAVES", [](Solution&) { _exit(3); }, crashed,
       "its process ended in detail run, factor after ", " with exit code 3"},
      {"THROWS 42", [](Solution&) { throw 42; }, crashed, "its process was ended in nothing after ",
       " by SIGABRT"},
      {"THROWS", [](Solution&) { throw std::runtime_error("no luck"); }, crashed, "", "no luck"},
  };
  std::vector<Method> methods;
  for (const auto& harm : harms) methods.push_back(harmful(harm.name, harm.harm));
  const std::vector<Record> records = run_between(methods);
  ASSERT_EQ(records.size(), std::size(harms));
  for (std::size_t k = 0; k < std::size(harms); ++k) {
    const Record& record = records[k];
    SCOPED_TRACE(record.method + ": " + record.status_reason);
    EXPECT_EQ(record.method, harms[k].name);
    EXPECT_EQ(record.status, harms[k].status);
    EXPECT_TRUE(record.status_reason.starts_with(harms[k].ended_in));
    EXPECT_TRUE(testing::contains(record.status_reason, harms[k].reason));
    EXPECT_TRUE(record.samples_s.empty());
  }
}

TEST_F(Isolation, ACrashInATimedRunTakesTheTimesAway) {
  auto runs = std::make_shared<int>(0);
  const Record record = run_between(harmful("LATE", [runs](Solution&) {
    if (++*runs == 4) die_of(SIGSEGV);  // detail, memory, first timed, second timed
  }));
  EXPECT_EQ(record.status, Status::crashed);
  EXPECT_NE(record.status_reason.find("in timed run, factor after"), std::string::npos)
      << record.status_reason;
  EXPECT_TRUE(record.samples_s.empty());
  EXPECT_TRUE(is_verified(record));
}

TEST_F(Isolation, AHangIsEnded) {
  options_.limits.timeout_s = 2;  // which the sound ones do not reach, however slow the machine
  const Record record = run_between(harmful("HANGS", [](Solution&) {
    for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
  }));
  EXPECT_EQ(record.status, Status::timeout);
  EXPECT_TRUE(record.status_reason.starts_with("its process was ended in detail run, factor after"))
      << record.status_reason;
  EXPECT_NE(record.status_reason.find(": the limit is "), std::string::npos);
}

TEST_F(Isolation, NonsenseIsNoSuccess) {
  Record record = run_between(harmful("NAN", [](Solution& solution) {
    solution.F_C.setConstant(std::numeric_limits<double>::quiet_NaN());
  }));
  EXPECT_EQ(record.status, Status::breakdown);
  record = run_between(harmful("LIES", [](Solution& solution) {
    solution.F_C *= 1.5;
    solution.stress.values() *= 1.5;
  }));
  EXPECT_EQ(record.status, Status::inaccurate);
  EXPECT_EQ(record.claimed_status, Status::ok);
  EXPECT_EQ(outcome_of(record), "wrong_success");
}

// A record with any of these could not be read again.
TEST_F(Isolation, NumbersThatNoRecordMayHaveAreRecordsOfTheirCasesAlone) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::pair<Harm, const char*> harms[] = {
      {[](Solution& solution) { solution.linear_iterations = std::int64_t{1} << 61; },
       "linear_iterations: 2305843009213693952 (allowed: a whole number from 0 to 2^60, null)"},
      {[](Solution& solution) { solution.newton_steps = -1; }, "newton_steps: -1 (allowed: "},
      {[](Solution& solution) { solution.done_fraction = 2; }, "done_fraction: 2"},
      {[](Solution& solution) { solution.times[Stage::order] = -1; }, "stage_order_s: -1"},
      {[nan](Solution& solution) { solution.times[Stage::order] = nan; }, "are no numbers"}};
  std::vector<Method> methods;
  for (const auto& [harm, reason] : harms) methods.push_back(harmful(reason, harm));
  for (Method& method : methods) method.name = "HARM" + std::to_string(&method - methods.data());
  const std::vector<Record> records = run_between(methods);
  ASSERT_EQ(records.size(), std::size(harms));
  for (std::size_t k = 0; k < std::size(harms); ++k) {
    EXPECT_EQ(records[k].status, Status::crashed);
    EXPECT_TRUE(testing::contains(records[k].status_reason, harms[k].second));
  }
  EXPECT_EQ(read_records(folder_ / "o/records.jsonl").size(), records.size() + 2);
}

TEST_F(Isolation, ATimeWithASuspensionInItIsNoSample) {
  const std::filesystem::path runs = folder_ / "runs";
  const Record record = run_between(harmful("SUSPENDED", [runs](Solution&) {
    const std::string before = testing::text_of(runs);
    testing::write_text(runs, before + "run\n");
    if (testing::lines_of(before).size() != 2) return;  // not the first timed run
    const pid_t self = getpid();
    if (fork() == 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(700));
      kill(self, SIGCONT);
      _exit(0);
    }
    std::raise(SIGSTOP);
  }));
  EXPECT_EQ(record.status, Status::ok) << record.status_reason;
  EXPECT_EQ(record.samples_s.size(), 2u);
  EXPECT_GE(testing::lines_of(testing::text_of(runs)).size(), 5u);  // detail, memory, time: 1 + 2
}

TEST_F(Isolation, MemoryWithoutEndIsEnded) {
  if (!heap::is_active()) return;  // sanitizers count for themselves
  options_.limits.memory_limit_bytes = 64 << 20;
  // Blocks that the limit refuses, and blocks so small that it grants them.
  for (const std::size_t bytes : {std::size_t{1} << 20, std::size_t{1} << 10}) {
    const Record record = run_between(harmful("EATS", [bytes](Solution&) {
      std::vector<std::unique_ptr<char[]>> eaten;
      for (;;) {
        eaten.emplace_back(new char[bytes]);
        std::memset(eaten.back().get(), 1, bytes);
      }
    }));
    EXPECT_EQ(record.status, Status::out_of_memory) << bytes;
    EXPECT_TRUE(testing::contains(record.status_reason, "limit"));
  }
}

// An iterative method on a body of a size that takes it a while, and on a small one.
class IsolationAtSize : public Isolation {
 protected:
  IsolationAtSize() {
    Mesh mesh = testing::small_tooth(16, 12);
    for (int level = testing::sanitized; level < 3; ++level) mesh = uniformly_refined(mesh);
    mesh.name = "large";
    large_.scene_name = "default";
    large_.problem = testing::posed(Scene{}, std::move(mesh));
    options_.limits.repetitions = 1;
  }
  // Of the large body; the small one is solved after it.
  Record run_large(const Method& method) {
    const std::vector<Record> records =
        run_cases(plan_cases({large_, posed_}, {method}, options_.run), options_.limits,
                  options_.output, {})
            .records();
    EXPECT_EQ(records.size(), 2u);
    EXPECT_EQ(records.back().status, Status::ok) << records.back().status_reason;
    EXPECT_GT(records.front().n_phi, testing::sanitized ? 12'000 : 50'000);
    EXPECT_EQ(records.front().method, method.name);
    EXPECT_TRUE(records.front().samples_s.empty());
    EXPECT_FALSE(records.front().status_reason.empty());
    return records.front();
  }
  const Method method_ = select_methods("HYBRID:CG").front();
  PosedScene large_;
};

TEST_F(IsolationAtSize, AMemoryLimitIsARecord) {
  if (!heap::is_active()) return;
  options_.limits.memory_limit_bytes = std::int64_t{48} << 20;
  const Record record = run_large(method_);
  EXPECT_EQ(record.status, Status::out_of_memory);
  EXPECT_TRUE(testing::contains(record.status_reason, "limit"));
}

// However fast the machine, the large body takes as long as it may; however slow, the small one
// does not.
TEST_F(IsolationAtSize, ATimeLimitIsARecord) {
  options_.limits.timeout_s = 3;
  Method patient = method_;
  patient.solve = [this](const ContactSystem& system, const RunControl& control) {
    Solution solution = method_.solve(system, control);
    while (system.problem == large_.body() && solution.status == Status::ok)
      solution = method_.solve(system, control);
    return solution;
  };
  const Record record = run_large(patient);
  EXPECT_EQ(record.status, Status::timeout);
  EXPECT_TRUE(testing::contains(record.status_reason, "time limit"));
}

// Does it where a stage begins and where it ends.
struct AtStage : StageObserver {
  std::function<void(Stage)> at_begin = [](Stage) {}, at_end = [](Stage) {};
  void begins(Stage stage) override { at_begin(stage); }
  void ends(Stage stage) override { at_end(stage); }
};

TEST_F(IsolationAtSize, ATimeLimitInItsContactLawIsARecord) {
  Method late = method_;
  late.solve = [this](const ContactSystem& system, const RunControl& control) {
    RunControl own = control;
    AtStage ender;
    ender.at_begin = [&](Stage stage) {
      if (stage == Stage::contact) own.deadline = Deadline::after(0);
    };
    const ObservedStages scope(system.problem == large_.body() ? &ender : nullptr);
    return method_.solve(system, own);
  };
  const Record record = run_large(late);
  EXPECT_EQ(record.status, Status::timeout);
  EXPECT_EQ(record.status_reason, "time limit reached during the active sets of the contact law");
}

TEST_F(IsolationAtSize, AKillWithinAStageIsARecord) {
  for (const Stage stage : {Stage::precondition, Stage::contact, Stage::check}) {
    Method killed = method_;
    killed.solve = [this, stage](const ContactSystem& system, const RunControl& control) {
      AtStage killer;
      killer.at_end = [&](Stage of) {
        if (of == stage) die_of(SIGKILL);
      };
      const ObservedStages scope(system.problem == large_.body() ? &killer : nullptr);
      return method_.solve(system, control);
    };
    const Record record = run_large(killed);
    EXPECT_EQ(record.status, oom_kills() ? Status::machine_fault : Status::out_of_memory);
    EXPECT_NE(record.status_reason.find(fmt::format("in detail run, {} after ", name_of(stage))),
              std::string::npos)
        << record.status_reason;
    EXPECT_NE(record.status_reason.find(" by SIGKILL"), std::string::npos) << record.status_reason;
  }
}

// OpenBLAS's threads do: "malloc failed in gemm_driver".
TEST_F(Isolation, ALibraryThatExitsForLackOfMemoryIsOutOfMemory) {
  if (!heap::is_active()) return;
  options_.limits.memory_limit_bytes = 64 << 20;
  const Method gives_up = harmful("GIVES UP", [](Solution&) {
    void* const block = std::malloc(std::size_t{1} << 27);
    if (block == nullptr) std::exit(1);
    std::free(block);
  });
  EXPECT_EQ(run_between(gives_up).status, Status::out_of_memory);
  options_.limits.memory_limit_bytes.reset();
  const Method gets_none = harmful("GETS NONE", [](Solution&) { exit_without_memory(); });
  const Record record = run_between(gets_none);
  EXPECT_EQ(record.status, Status::out_of_memory);
  EXPECT_TRUE(testing::contains(record.status_reason, "there was no memory"));
  // Where nothing was refused, an exit is a crash.
  EXPECT_EQ(run_between(harmful("EXITS", [](Solution&) { std::exit(1); })).status, Status::crashed);
}

TEST_F(Isolation, WhatBreaksAnAssemblyIsTheRecordOfEveryCaseThatNeedsIt) {
  const std::shared_ptr<const Problem> whole = posed_.body();
  const auto records_if = [&](void (*breaks)()) {
    auto problem = std::make_shared<Problem>(*whole);
    problem->loads.displacement_mm = [breaks](const Eigen::Vector2d&, int) -> Eigen::Vector2d {
      breaks();
      return Eigen::Vector2d::Zero();
    };
    posed_.problem = problem;
    return run(select_methods("3STEPD,BLIND,HYBRID"));
  };
  const auto expect_all = [&](const std::vector<Record>& records, Status status) {
    ASSERT_EQ(records.size(), 3u);
    for (const Record& record : records) EXPECT_EQ(record.status, status) << record.status_reason;
    const auto ended_in = [&](std::size_t k, const char* place) {
      return records[k].status_reason.find(place) != std::string::npos;
    };
    for (const std::size_t k : {0, 1}) EXPECT_TRUE(ended_in(k, "in assembly after "));
    EXPECT_TRUE(ended_in(2, "in detail run, condense after "));  // HYBRID assembles in its solve
  };
  const std::vector<Record> crashed = records_if([] { die_of(SIGSEGV); });
  expect_all(crashed, Status::crashed);
  EXPECT_TRUE(crashed.back().status_reason.ends_with(" by SIGSEGV"));
  if (heap::is_active()) expect_all(records_if(exit_without_memory), Status::out_of_memory);
}

TEST_F(Isolation, AnAssemblyThatBreaksLastLeavesTheOthers) {
  struct Calls {
    pid_t scene = 0;
    int count = 0;
  };
  const auto calls = std::make_shared<Calls>();  // every process has its own
  const std::filesystem::path counted = folder_ / "calls";
  int most = std::numeric_limits<int>::max();
  auto problem = std::make_shared<Problem>(*posed_.body());
  problem->loads.displacement_mm = [calls, counted, &most, main = getpid()](
                                       const Eigen::Vector2d&, int) -> Eigen::Vector2d {
    if (calls->scene == 0 && getpid() != main) calls->scene = getpid();
    if (getpid() == calls->scene) {
      if (++calls->count > most) die_of(SIGSEGV);
      testing::write_text(counted, std::to_string(calls->count));
    }
    return Eigen::Vector2d::Zero();
  };
  posed_.problem = problem;
  EXPECT_EQ(run(select_methods("HYBRID")).front().status, Status::ok);
  most = std::stoi(testing::text_of(counted));  // what follows is 3STEPCG's assembly
  const std::vector<Record> records = run(select_methods("HYBRID,3STEPCG:DTIC4"));
  ASSERT_EQ(records.size(), 2u);
  EXPECT_EQ(records.front().status, Status::ok) << records.front().status_reason;
  EXPECT_EQ(records.back().status, Status::crashed) << records.back().status_reason;
  EXPECT_NE(records.back().status_reason.find("in assembly after "), std::string::npos);
}

TEST_F(Isolation, AKillFromOutsideLeavesNothingOut) {
  if (!oom_kills()) return;
  auto problem = std::make_shared<Problem>(*posed_.body());
  const std::filesystem::path marker = folder_ / "killed";
  problem->loads.displacement_mm = [marker](const Eigen::Vector2d&, int) -> Eigen::Vector2d {
    if (!std::filesystem::exists(marker)) {
      testing::write_text(marker, "");
      die_of(SIGKILL);
    }
    return Eigen::Vector2d::Zero();
  };
  posed_.problem = problem;
  for (const Record& record : run(select_methods("HYBRID,P2")))
    EXPECT_EQ(record.status, Status::ok) << record.status_reason;
  EXPECT_TRUE(std::filesystem::exists(marker));
}

}  // namespace
}  // namespace airybench::isolation_test
