#include <gtest/gtest.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <thread>

#include "bench/measure/environment.hpp"
#include "bench/measure/heap_probe.hpp"
#include "bench/measure/instruction_counter.hpp"
#include "bench/measure/machine_warnings.hpp"
#include "bench/measure/noise_kernel.hpp"

namespace airybench::noise_test {
namespace {

TEST(NoiseKernel, DoesTheSameWorkEveryTimeAndAllocatesNothing) {
  // D of I + 1 1ᵀ/n is (n + i + 1)/(n + i), i from 0; the sweep adds i mod 7.
  double expected = 0;
  for (int i = 0; i < 128; ++i) expected += (128.0 + i + 1) / (128.0 + i);
  for (int i = 0; i < noise_sweep_length; ++i) expected += i % 7;
  EXPECT_NEAR(noise_kernel_checksum(), expected, 1e-8);
  EXPECT_EQ(noise_kernel_checksum(), noise_kernel_checksum());
  const std::int64_t before = heap::allocations();
  const double seconds = run_noise_kernel();
  EXPECT_EQ(heap::allocations(), before);
  EXPECT_GT(seconds, 0);
}

TEST(NoiseKernel, OnSeveralThreadsEndsWithTheLastAndKeepsNothing) {
  const std::int64_t before = heap::live_bytes();
  EXPECT_GT(run_noise_kernel(3), 0);
  EXPECT_LT(heap::live_bytes(), before + (1 << 20));  // threads keep a little of their own
}

// A pass beside a case of another process times no copies of pages.
TEST(NoiseKernel, TakesNoNewPagesAfterAFork) {
  const auto faults = [] {
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_minflt;
  };
  run_noise_kernel();
  const pid_t other = fork();
  if (other == 0) {
    pause();
    _exit(0);
  }
  const auto before = faults();
  run_noise_kernel();
  EXPECT_LT(faults() - before, 16);
  kill(other, SIGKILL);
  waitpid(other, nullptr, 0);
}

TEST(NoiseKernel, SummaryIsMedianAndDeviation) {
  const NoiseSummary summary = summarise_noise({4, 2, 3, 100, 1});
  EXPECT_EQ(summary.median_s, 3);
  EXPECT_EQ(summary.mad_s, 1);
  EXPECT_DOUBLE_EQ(summary.spread(), 1.0 / 3);
  EXPECT_EQ(summary.samples.size(), 5u);
}

MachineState quiet_machine() {
  MachineState state;
  state.governor = "performance";
  state.load = 0.1;
  state.cpus = 4;
  state.repetitions = 5;
  state.noise = 0.01;
  state.heap_probe = true;
  state.build_type = "Release";
  return state;
}

TEST(MachineWarnings, NoneForAQuietMachineNorForWhatIsUnknown) {
  EXPECT_TRUE(machine_warnings(quiet_machine()).empty());
  MachineState unknown;
  unknown.repetitions = 5;
  unknown.heap_probe = true;
  EXPECT_TRUE(machine_warnings(unknown).empty());
}

TEST(MachineWarnings, EachCauseHasItsLine) {
  const auto line_of = [](auto change) {
    MachineState state = quiet_machine();
    change(state);
    const auto lines = machine_warnings(state);
    return lines.size() == 1 ? lines.front() : std::to_string(lines.size()) + " lines";
  };
  const auto expect = [](const std::string& line, const char* part) {
    EXPECT_NE(line.find(part), line.npos) << line;
  };
  expect(line_of([](MachineState& s) { s.governor = "powersave"; }), "governor powersave");
  expect(line_of([](MachineState& s) { s.load = 0.9; }), "load 0.90 on 4 CPUs");
  expect(line_of([](MachineState& s) { s.threads = 5; }), "--threads=5: more than the 4 CPUs");
  expect(line_of([](MachineState& s) { s.noise = 0.12; }), "scatter by 12.0 %");
  expect(line_of([](MachineState& s) { s.repetitions = 4; }), "--repetitions=4");
  expect(line_of([](MachineState& s) { s.heap_probe = false; }), "heap is not counted");
  expect(line_of([](MachineState& s) { s.build_type = "Debug"; }), "build type Debug");
  expect(line_of([](MachineState& s) { s.dirty = true; }), "no git revision");
  MachineState all;
  all.governor = "powersave";
  all.load = 3;
  all.cpus = 2;
  all.noise = 1;
  all.build_type = "Debug";
  all.dirty = true;
  EXPECT_EQ(machine_warnings(all).size(), 7u);
}

TEST(MachineWarnings, TheStateIsThatOfTheRecordsContext) {
  const MachineState state = machine_state({{"cpu_governor", "unknown"},
                                            {"load_1min_at_start", "1.93"},
                                            {"cpus", "2"},
                                            {"heap_probe", "on"},
                                            {"build_type", "Release"},
                                            {"git_dirty", "yes"}},
                                           3, 0.02);
  EXPECT_EQ(state.governor, "");
  EXPECT_EQ(state.load, 1.93);
  EXPECT_EQ(state.cpus, 2);
  EXPECT_EQ(state.repetitions, 3);
  EXPECT_EQ(state.noise, 0.02);
  EXPECT_TRUE(state.heap_probe);
  EXPECT_EQ(state.build_type, "Release");
  EXPECT_TRUE(state.dirty);
  EXPECT_FALSE(machine_state({{"load_1min_at_start", "-1.00"}}, 5, {}).load);
  const MachineState here = machine_state(describe_environment(1), 5, {});
  EXPECT_GT(here.cpus, 0);
  EXPECT_FALSE(here.build_type.empty());
}

[[gnu::noinline]] double additions(int count) {
  volatile double sum = 0;
  for (int i = 0; i < count; ++i) sum = sum + 1;
  return sum;
}

TEST(InstructionCounter, CountsTheWorkAndThatOfThreads) {
  const InstructionCounter counter;
  if (!counter.count()) GTEST_SKIP() << "this machine does not let its instructions be counted";
  const auto instructions_of = [&](auto work) {
    const std::int64_t before = *counter.count();
    work();
    return *counter.count() - before;
  };
  constexpr int many = 1000000;
  const auto once = instructions_of([] { additions(many); });
  EXPECT_GE(once, 3 * many);  // load, add, store
  EXPECT_NEAR(static_cast<double>(instructions_of([] { additions(2 * many); })) / once, 2, 0.1);
  EXPECT_GE(instructions_of([] { std::thread([] { additions(many); }).join(); }), once * 9 / 10);
}

}  // namespace
}  // namespace airybench::noise_test
