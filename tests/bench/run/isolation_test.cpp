// Methods that crash, hang, eat memory or lie: each becomes its case's record, and the run goes on.
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <thread>

#include "assembly/scene.hpp"
#include "bench/measure/heap_probe.hpp"
#include "bench/records/summary.hpp"
#include "bench/run/child_process.hpp"
#include "bench/run/oom_kills.hpp"
#include "bench/run/runner.hpp"
#include "bench/run/scene_process.hpp"
#include "mesh/refinement.hpp"
#include "solvers/methods.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/support/small_meshes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace airybench::isolation_test {
namespace {

using Harm = std::function<void(Solution&)>;  // done to HYBRID's answer

// A method that is HYBRID and then does harm; in the factor stage, where it says so.
Method harmful(const std::string& name, Harm harm) {
  Method method = select_methods("HYBRID").front();
  method.name = name;
  method.solve = [solve = method.solve, harm](const DualSystem& system, const RunControl& control) {
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

class Isolation : public ::testing::Test {
 protected:
  // The method between two that are sound.
  Record run_between(const Method& method) {
    const Method sound = select_methods("HYBRID").front();
    const std::vector<Record> records = run({sound, method, select_methods("P2").front()});
    EXPECT_EQ(records.size(), 3u);
    EXPECT_EQ(records.front().status, Status::ok) << records.front().status_reason;
    EXPECT_EQ(records.back().status, Status::ok) << records.back().status_reason;
    EXPECT_EQ(records.at(1).method, method.name);
    return records.at(1);
  }
  std::vector<Record> run(const std::vector<Method>& methods) {
    return run_cases(plan_cases({posed_}, methods), options_, {}).records;
  }

  Isolation() {
    options_.out = folder_ / "o";
    options_.repetitions = 2;
    options_.target_error = 1e-6;
    posed_.scene_name = "default";
    posed_.problem = testing::posed(Scene{}, testing::small_tooth(4, 3));
  }
  const testing::TemporaryFolder folder_;
  Options options_;
  PosedScene posed_;
};

TEST_F(Isolation, CrashesAreRecordedWithSignalAndStage) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS}) {
    const Record record = run_between(harmful("CRASH", [signal](Solution&) { die_of(signal); }));
    EXPECT_EQ(record.status, Status::crashed);
    EXPECT_EQ(record.signal, signal_name(signal));
    EXPECT_EQ(record.ended_in, "detail run, factor");
    EXPECT_TRUE(record.time_so_far_s);
    EXPECT_TRUE(record.samples_s.empty());
    EXPECT_NE(record.status_reason.find(signal_name(signal)), std::string::npos);
  }
}

TEST_F(Isolation, AProcessThatLeavesOrIsKilledIsRecorded) {
  Record record = run_between(harmful("LEAVES", [](Solution&) { _exit(3); }));
  EXPECT_EQ(record.status, Status::crashed);
  EXPECT_NE(record.status_reason.find("exit code 3"), std::string::npos) << record.status_reason;
  // As the kernel does to one that takes the last of the machine's memory; but it counts those.
  record = run_between(harmful("KILLED", [](Solution&) { die_of(SIGKILL); }));
  EXPECT_EQ(record.status, oom_kills() ? Status::machine_fault : Status::out_of_memory)
      << record.status_reason;
  EXPECT_EQ(record.signal, "SIGKILL");
}

TEST_F(Isolation, ACrashInATimedRunTakesTheTimesAway) {
  auto runs = std::make_shared<int>(0);
  const Record record = run_between(harmful("LATE", [runs](Solution&) {
    if (++*runs == 4) die_of(SIGSEGV);  // detail, memory, first timed, second timed
  }));
  EXPECT_EQ(record.status, Status::crashed);
  EXPECT_EQ(record.ended_in, "timed run, factor");
  EXPECT_TRUE(record.samples_s.empty());
  EXPECT_TRUE(is_verified(record));
}

TEST_F(Isolation, ExceptionsAreRecorded) {
  Record record =
      run_between(harmful("THROWS", [](Solution&) { throw std::runtime_error("no such luck"); }));
  EXPECT_EQ(record.status, Status::crashed);
  EXPECT_EQ(record.status_reason, "no such luck");
  EXPECT_EQ(record.signal, "");
  record = run_between(harmful("THROWS", [](Solution&) { throw 42; }));
  EXPECT_EQ(record.status, Status::crashed);
  EXPECT_EQ(record.signal, "SIGABRT");
}

TEST_F(Isolation, AHangIsEnded) {
  options_.timeout_s = 2;  // which the sound ones do not reach, however slow the machine
  const Record record = run_between(harmful("HANGS", [](Solution&) {
    for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
  }));
  EXPECT_EQ(record.status, Status::timeout);
  EXPECT_EQ(record.ended_in, "detail run, factor");
  EXPECT_GT(record.time_so_far_s.value_or(0), options_.timeout_s);
}

TEST_F(Isolation, NonsenseIsNoSuccess) {
  Record record = run_between(harmful("NAN", [](Solution& solution) {
    solution.F_C.setConstant(std::numeric_limits<double>::quiet_NaN());
  }));
  EXPECT_EQ(record.status, Status::breakdown);
  record = run_between(harmful("LIES", [](Solution& solution) {
    solution.F_C *= 1.5;
    for (ElementStress& stress : solution.stress) stress *= 1.5;
  }));
  EXPECT_EQ(record.status, Status::inaccurate);
  EXPECT_EQ(record.claimed_status, Status::ok);
  EXPECT_EQ(outcome_of(record), "wrong_success");
}

TEST_F(Isolation, MemoryWithoutEndIsEnded) {
  if (!heap::is_active()) return;  // sanitizers count for themselves
  options_.memory_limit_bytes = 64 << 20;
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
    EXPECT_NE(record.status_reason.find("limit"), std::string::npos) << record.status_reason;
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
    options_.repetitions = 1;
  }
  // Of the large body; the small one is solved after it.
  Record run_large(const Method& method) {
    const std::vector<Record> records =
        run_cases(plan_cases({large_, posed_}, {method}), options_, {}).records;
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
  for (const int MiB : {16, 48}) {
    options_.memory_limit_bytes = std::int64_t{MiB} << 20;
    const Record record = run_large(method_);
    EXPECT_EQ(record.status, Status::out_of_memory) << MiB;
    EXPECT_NE(record.status_reason.find("limit"), std::string::npos) << record.status_reason;
  }
}

// However fast the machine, the large body takes as long as it may; however slow, the small one
// does not.
TEST_F(IsolationAtSize, ATimeLimitIsARecord) {
  options_.timeout_s = 3;
  Method patient = method_;
  patient.solve = [this](const DualSystem& system, const RunControl& control) {
    Solution solution = method_.solve(system, control);
    while (system.problem == large_.body() && solution.status == Status::ok)
      solution = method_.solve(system, control);
    return solution;
  };
  const Record record = run_large(patient);
  EXPECT_EQ(record.status, Status::timeout);
  EXPECT_NE(record.status_reason.find("time limit"), std::string::npos) << record.status_reason;
}

TEST_F(IsolationAtSize, ATimeLimitInItsContactLawIsARecord) {
  struct EndsTheTime : StageObserver {
    RunControl& control;
    explicit EndsTheTime(RunControl& of) : control(of) {}
    void begins(Stage of) override {
      if (of == Stage::contact) control.deadline = Deadline::after(0);
    }
    void ends(Stage) override {}
  };
  Method late = method_;
  late.solve = [this](const DualSystem& system, const RunControl& control) {
    RunControl own = control;
    EndsTheTime ender(own);
    const bool is_large = system.problem == large_.body();
    const ObservedStages scope(is_large ? &ender : nullptr);
    return method_.solve(system, own);
  };
  const Record record = run_large(late);
  EXPECT_EQ(record.status, Status::timeout);
  EXPECT_EQ(record.status_reason, "time limit reached during the active sets of the contact law");
}

TEST_F(IsolationAtSize, AKillWithinAStageIsARecord) {
  struct KillsAtTheEnd : StageObserver {
    Stage stage;
    explicit KillsAtTheEnd(Stage of) : stage(of) {}
    void begins(Stage) override {}
    void ends(Stage of) override {
      if (of == stage) die_of(SIGKILL);
    }
  };
  for (const Stage stage : {Stage::precondition, Stage::contact, Stage::check}) {
    Method killed = method_;
    killed.solve = [this, stage](const DualSystem& system, const RunControl& control) {
      KillsAtTheEnd killer(stage);
      const bool is_large = system.problem == large_.body();
      const ObservedStages scope(is_large ? &killer : nullptr);
      return method_.solve(system, control);
    };
    const Record record = run_large(killed);
    EXPECT_EQ(record.status, oom_kills() ? Status::machine_fault : Status::out_of_memory);
    EXPECT_EQ(record.signal, "SIGKILL");
    EXPECT_EQ(record.ended_in, "detail run, " + std::string(name_of(stage)));
  }
}

// OpenBLAS's threads do: "malloc failed in gemm_driver".
TEST_F(Isolation, ALibraryThatExitsForLackOfMemoryIsOutOfMemory) {
  if (!heap::is_active()) return;
  options_.memory_limit_bytes = 64 << 20;
  const Method gives_up = harmful("GIVES UP", [](Solution&) {
    void* const block = std::malloc(std::size_t{1} << 27);
    if (block == nullptr) std::exit(1);
    std::free(block);
  });
  EXPECT_EQ(run_between(gives_up).status, Status::out_of_memory);
  // Where nothing was refused, an exit is a crash.
  EXPECT_EQ(run_between(harmful("EXITS", [](Solution&) { std::exit(1); })).status, Status::crashed);
}

TEST_F(Isolation, WhatBreaksTheAssemblyIsEveryCasesRecord) {
  auto problem = std::make_shared<Problem>(*posed_.body());
  problem->loads.displacement_mm = [](const Eigen::Vector2d&, int) -> Eigen::Vector2d {
    die_of(SIGSEGV);
    return Eigen::Vector2d::Zero();
  };
  posed_.problem = problem;
  const std::vector<Record> records = run(select_methods("3STEPD,BLIND"));
  ASSERT_EQ(records.size(), 2u);
  for (const Record& record : records) {
    EXPECT_NE(record.status, Status::ok);
    EXPECT_NE(record.status_reason.find("SIGSEGV"), std::string::npos) << record.status_reason;
  }
  EXPECT_NE(records[0].status_reason.find("assembly"), std::string::npos);
}

TEST_F(Isolation, RepetitionsAreInterleavedAndAllKept) {
  options_.interleave = true;
  options_.repetitions = 5;
  const std::vector<Record> records = run(select_methods("3STEPD,HYBRID,P2"));
  options_.interleave = false;
  ASSERT_EQ(records.size(), 3u);
  for (const Record& record : records) {
    EXPECT_EQ(record.status, Status::ok);
    EXPECT_EQ(record.samples_s.size(), 5u);
    EXPECT_EQ(record.stage_samples.size(), 5u);
  }
}

// Whom the kernel killed is what its counters say: the control group's, else the machine's.
TEST(OomKills, AreTheKernelsCount) {
  const testing::TemporaryFolder root;
  EXPECT_EQ(oom_kills(root.path()), std::nullopt);
  for (const char* folder : {"proc/self", "sys/fs/cgroup/night/run"})
    std::filesystem::create_directories(root / folder);
  testing::write_text(root / "proc/vmstat", "nr_free_pages 81\noom_kill 4\nswap_ra 0\n");
  EXPECT_EQ(oom_kills(root.path()), 4);
  testing::write_text(root / "proc/self/cgroup", "1:cpu:/\n0::/night/run\n");
  EXPECT_EQ(oom_kills(root.path()), 4) << "the group has no count";
  testing::write_text(root / "sys/fs/cgroup/night/run/memory.events",
                      "low 0\nhigh 7\nmax 9\noom 3\noom_kill 2\noom_group_kill 1\n");
  EXPECT_EQ(oom_kills(root.path()), 2);
}

TEST(ChildProcess, ThatIsKilledWithoutTheKernelsCountIsNotOutOfMemory) {
  ActivityBoard board;
  ChildEnd end;
  end.signal = SIGKILL;
  EXPECT_EQ(obituary_of(end, board, Options()).status, Status::out_of_memory) << "a guess";
  end.oom_killed = true;
  EXPECT_EQ(obituary_of(end, board, Options()).status, Status::out_of_memory);
  end.oom_killed = false;
  EXPECT_EQ(obituary_of(end, board, Options()).status, Status::machine_fault);
}

TEST(ChildProcess, ThatGetsNoMemoryOutsideOfARunIsNoCrash) {
  for (const bool in_noexcept : {false, true}) {
    ChildProcess child([&](Channel& channel) {
      channel.receive();
      const auto fail = [] { throw std::bad_alloc(); };
      if (in_noexcept) [&]() noexcept { fail(); }();
      fail();
    });
    EXPECT_FALSE(child.ask("are you there"));
    ActivityBoard board;
    EXPECT_EQ(obituary_of(child.end(), board, Options()).status, Status::machine_fault)
        << child.end().exit_code << " " << child.end().signal;
    board.begins(Activity::detail_run);
    EXPECT_EQ(obituary_of(child.end(), board, Options()).status, Status::out_of_memory);
  }
}

// As OpenMP's library does.
TEST(ChildProcess, ThatALibraryEndsForLackOfMemoryIsNoCrash) {
  if (!heap::is_active()) GTEST_SKIP();
  ChildProcess child([](Channel& channel) {
    channel.receive();
    volatile std::size_t too_much = std::numeric_limits<std::ptrdiff_t>::max() / 2;
    void* volatile block = std::malloc(too_much);  // or the compiler leaves it out
    std::free(block);
    std::exit(1);
  });
  EXPECT_FALSE(child.ask("are you there"));
  EXPECT_EQ(child.end().exit_code, no_memory_exit_code);
}

TEST(ChildProcess, AnswersUntilItEnds) {
  ChildProcess child([](Channel& channel) {
    while (const auto line = channel.receive()) channel.send("you said " + *line);
  });
  EXPECT_EQ(child.ask("yes"), "you said yes");
  const std::string text(1 << 20, 'x');  // more than a socket holds
  EXPECT_EQ(child.ask(text).value_or("").size(), text.size() + 9);
}

TEST(ChildProcess, ThatClosesTheLineIsReapedAllTheSame) {
  ChildProcess child([](Channel&) {
    for (int descriptor = 3; descriptor < 64; ++descriptor) close(descriptor);
    for (;;) pause();
  });
  EXPECT_FALSE(child.ask("are you there"));
  EXPECT_EQ(child.end().signal, SIGKILL);
  EXPECT_TRUE(child.end().lingered);
}

}  // namespace
}  // namespace airybench::isolation_test
