// What measures, and what makes figures uncertain: noise kernel, warnings, counters, splits.
#include <gtest/gtest.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <sstream>

#include "bench/measure/case_result.hpp"
#include "bench/measure/environment.hpp"
#include "bench/measure/heap_probe.hpp"
#include "bench/measure/noise_kernel.hpp"
#include "tests/support/contains.hpp"

namespace airybench::instruments_test {
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
  EXPECT_LT(heap::live_bytes(), before + (1 << 20));  // threads keep a little
}

// A pass next to a case of another process times no copies of pages.
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

TEST(CpuModel, IsTheNameOrTheNumbersOfAnAArch64Processor) {
  const auto model = [](const std::string& text) {
    std::istringstream cpuinfo(text);
    return cpu_model(cpuinfo);
  };
  EXPECT_EQ(model("processor\t: 0\nmodel\t\t: 1\nmodel name\t: Abacus 9\nflags\t\t:\n"),
            "Abacus 9");
  EXPECT_EQ(model("processor\t: 0\nCPU implementer\t: 0x41\nCPU architecture: 8\n"
                  "CPU variant\t: 0x3\nCPU part\t: 0xd0c\nCPU revision\t: 1\n"),
            "implementer 0x41, part 0xd0c");
  EXPECT_EQ(model("processor\t: 0\n"), "unknown");
}

const Context quiet_machine = {{"cpu_governor", "performance"},
                               {"load_1min_at_start", "0.1"},
                               {"cpus", "4"},
                               {"threads", "1"},
                               {"heap_probe", "on"},
                               {"build_type", "Release"},
                               {"git_dirty", "no"}};
const std::vector<double> steady_s = {1, 1.01, 0.99};

TEST(MachineWarnings, NoneForAQuietMachineNorForWhatIsUnknown) {
  EXPECT_TRUE(machine_warnings(quiet_machine, 5, steady_s).empty());
  EXPECT_TRUE(machine_warnings({{"heap_probe", "on"}, {"cpu_governor", "unknown"}}, 5, {}).empty());
  Context no_load = quiet_machine;
  no_load["load_1min_at_start"] = "-1.00";
  EXPECT_TRUE(machine_warnings(no_load, 5, steady_s).empty());
}

TEST(MachineWarnings, EachCauseHasItsLine) {
  const Context here = describe_environment(1);
  for (const auto& [key, value] : quiet_machine) EXPECT_TRUE(here.contains(key)) << key;
  const auto expect_line = [](const std::vector<std::string>& lines, const char* part) {
    ASSERT_EQ(lines.size(), 1u) << part;
    EXPECT_TRUE(testing::contains(lines.front(), part));
  };
  for (const auto& [key, value, part] :
       {std::array{"cpu_governor", "powersave", "governor powersave"},
        {"load_1min_at_start", "0.9", "load 0.90 on 4 CPUs"},
        {"threads", "5", "--threads=5: more than the 4 CPUs"},
        {"heap_probe", "off", "heap is not counted"},
        {"build_type", "Debug", "build type Debug"},
        {"git_dirty", "yes", "uncommitted changes"}}) {
    Context machine = quiet_machine;
    machine[key] = value;
    expect_line(machine_warnings(machine, 5, steady_s), part);
  }
  expect_line(machine_warnings(quiet_machine, 5, {1, 1.12, 0.88}), "machine noise 12.0 %");
  expect_line(machine_warnings(quiet_machine, 4, steady_s), "--repetitions=4");
}

MemorySplit made_up_memory() {
  MemorySplit memory;
  memory.at_peak[MemoryOwner::factor] = 9'000'000;
  memory.held[MemoryOwner::factor] = memory.counted[MemoryOwner::factor] = 8'000'000;
  memory.held[MemoryOwner::blocks] = 5;  // is not the method's
  memory.counted[MemoryOwner::blocks] = 4'000;
  memory.held[MemoryOwner::other] = 700;
  return memory;
}

TEST(MemorySplit, IsByOwner) {
  const MemorySplit memory = made_up_memory();
  const Json owners = by_owner(memory);
  EXPECT_EQ(owners["factor"].dump(),
            R"({"peak_bytes":9000000,"held_bytes":8000000,"counted_bytes":8000000})");
  EXPECT_TRUE(owners["other"]["counted_bytes"].is_null());
  EXPECT_FALSE(owners.contains("answer"));
  EXPECT_FALSE(counts_differ(memory));
}

TEST(MemorySplit, DiffersBeyondATenthAndTheSlackInEitherDirection) {
  MemorySplit memory = made_up_memory();
  EXPECT_FALSE(counts_differ(memory));
  for (const std::int64_t held : {7'190'000, 8'810'000}) {
    memory.held[MemoryOwner::factor] = held;
    EXPECT_TRUE(counts_differ(memory)) << held;
  }
  memory = made_up_memory();
  memory.counted[MemoryOwner::answer] = 1;  // small: within the slack
  memory.held[MemoryOwner::answer] = 60'000;
  EXPECT_FALSE(counts_differ(memory));
  memory.held[MemoryOwner::answer] = 70'000;
  EXPECT_TRUE(counts_differ(memory));
}

TEST(TimedRun, ThatEndsOtherwiseTakesTheMeasurementsAway) {
  Record record;
  record.samples_s = {0.3};
  record.claimed_status = Status::ok;
  record.peak_heap_bytes = 12;
  record.memory_by_owner = by_owner(made_up_memory());
  TimedRun run;
  run.end.status = Status::ok;
  run.time_s = 0.5;
  add_run(run, record);
  EXPECT_EQ(record.samples_s.size(), 2u);
  run.end.status = Status::timeout;
  add_run(timed_run_of(to_json(run)), record);
  EXPECT_EQ(record.status, Status::timeout);
  EXPECT_TRUE(record.samples_s.empty());
  EXPECT_FALSE(record.peak_heap_bytes);
  EXPECT_TRUE(record.memory_by_owner.is_null());
}

}  // namespace
}  // namespace airybench::instruments_test
