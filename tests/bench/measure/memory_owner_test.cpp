#include "support/memory_owner.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <array>
#include <filesystem>
#include <functional>
#include <thread>

#include "assembly/problem/scene.hpp"
#include "bench/measure/heap_probe.hpp"
#include "bench/measure/solve_watch.hpp"
#include "mesh/msh_format.hpp"
#include "solvers/base/parallel.hpp"
#include "tests/bench/measure/examined.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posed.hpp"

namespace airybench::memory_owner_test {
namespace {

constexpr std::int64_t KiB = 1024, MiB = 1024 * KiB;

// The compiler may not leave out a block that is shown to it.
void* used(void* block) {
  asm volatile("" : : "r"(block) : "memory");
  return block;
}

// What the owners have gained since.
class Gained {
 public:
  std::int64_t operator()(MemoryOwner owner) const {
    return heap::live_by_owner()[owner] - before_[owner];
  }

 private:
  ByOwner<std::int64_t> before_ = heap::live_by_owner();
};

void expect_about(std::int64_t bytes, std::int64_t expected, const char* what) {
  EXPECT_NEAR(static_cast<double>(bytes), static_cast<double>(expected), 8192) << what;
}

TEST(OwnerScope, IsOfOneThreadAndOurParallelRangesTakeItAlong) {
  const OwnerScope scope(MemoryOwner::iteration);
  MemoryOwner elsewhere = MemoryOwner::factor;
  std::thread([&] { elsewhere = current_memory_owner; }).join();
  EXPECT_EQ(elsewhere, MemoryOwner::other);
  std::array<MemoryOwner, 3> seen{};
  in_parallel(3, 3, [&](int begin, int) { seen[begin] = current_memory_owner; });
  for (const MemoryOwner owner : seen) EXPECT_EQ(owner, MemoryOwner::iteration);
}

TEST(MemoryOwner, EveryKindOfAllocationIsCountedForTheScope) {
  struct Kind {
    const char* name;
    std::function<void*()> allocate;
  };
  const Kind kinds[] = {
      {"malloc", [] { return std::malloc(MiB); }},
      {"calloc", [] { return std::calloc(MiB / 8, 8); }},
      {"realloc", [] { return std::realloc(std::malloc(100), MiB); }},
      {"realloc of nothing", [] { return std::realloc(nullptr, MiB); }},
      {"aligned_alloc", [] { return std::aligned_alloc(4096, MiB); }},
      {"posix_memalign",
       [] {
         void* block = nullptr;
         return posix_memalign(&block, 128, MiB) == 0 ? block : nullptr;
       }},
      {"operator new", [] { return ::operator new(MiB, std::nothrow); }},
  };
  for (const bool on_another_thread : {false, true})
    for (const Kind& kind : kinds) {
      const std::int64_t before = heap::live_bytes();
      heap::reset_peak();
      const Gained gained;
      void* block = nullptr;
      const auto allocate = [&] {
        const OwnerScope scope(MemoryOwner::preconditioner);
        block = kind.allocate();
      };
      if (on_another_thread)
        std::thread(allocate).join();
      else
        allocate();
      ASSERT_NE(block, nullptr) << kind.name;
      expect_about(gained(MemoryOwner::preconditioner), MiB, kind.name);
      if (!on_another_thread) {
        expect_about(heap::live_bytes() - before, MiB, kind.name);
      }
      EXPECT_GE(heap::peak_bytes(), heap::live_bytes()) << kind.name;
      const OwnerScope scope(MemoryOwner::condensed);  // who frees does not matter
      std::free(block);
      EXPECT_EQ(gained(MemoryOwner::preconditioner), 0) << kind.name;
      EXPECT_EQ(gained(MemoryOwner::condensed), 0) << kind.name;
      if (!on_another_thread) {
        EXPECT_EQ(heap::live_bytes(), before) << kind.name;
      }
      EXPECT_GE(heap::peak_bytes() - before, MiB) << kind.name;
    }
}

// Of any size, also those that fill their usable bytes: 24, 40, … and whole pages.
TEST(MemoryOwner, ABlockMayBeWrittenWholeWithoutLosingItsOwner) {
  for (std::size_t bytes = 0; bytes < 300; ++bytes)
    for (const std::size_t size : {bytes, 4096 * bytes}) {
      const Gained gained;
      const OwnerScope scope(MemoryOwner::factor);
      auto* block = static_cast<volatile unsigned char*>(std::malloc(size));
      for (std::size_t k = 0; k < size; k += size < 300 ? 1 : 64) block[k] = 0xff;
      if (size > 0) block[size - 1] = 0xff;
      std::free(const_cast<unsigned char*>(block));
      ASSERT_EQ(gained(MemoryOwner::factor), 0) << size;
    }
}

// 24, 40, 56 … bytes fill glibc's blocks: the tag makes them larger, and that does not count.
TEST(MemoryOwner, TheTagItselfDoesNotCount) {
  std::array<void*, 1000> blocks{};
  for (const std::size_t bytes : {24, 40, 56}) {
    const Gained gained;
    const auto held = [&] { return static_cast<double>(gained(MemoryOwner::factor)); };
    {
      const OwnerScope scope(MemoryOwner::factor);
      for (void*& block : blocks) block = used(std::malloc(bytes));
    }
    const double expected = 1000.0 * static_cast<double>(bytes);
    EXPECT_NEAR(held(), expected, 4000) << bytes;  // not 16000 more
    for (void*& block : blocks) block = used(std::realloc(block, bytes + 160));
    EXPECT_NEAR(held(), expected + 160'000, 4000) << bytes;
    for (void* block : blocks) std::free(block);
    EXPECT_EQ(held(), 0) << bytes;
  }
}

TEST(MemoryOwner, ABlockThatGrowsOrShrinksKeepsItsOwner) {
  const Gained gained;
  void* block = nullptr;
  {
    const OwnerScope scope(MemoryOwner::factor);
    block = used(std::malloc(100));
  }
  const OwnerScope scope(MemoryOwner::answer);
  for (const std::int64_t bytes : {MiB, 3 * MiB, 64 * KiB}) {
    block = used(std::realloc(block, static_cast<std::size_t>(bytes)));
    expect_about(gained(MemoryOwner::factor), bytes, "factor");
    EXPECT_EQ(gained(MemoryOwner::answer), 0);
  }
  std::thread([&] { std::free(block); }).join();
  EXPECT_EQ(gained(MemoryOwner::factor), 0);
}

TEST(MemoryOwner, OwnersSumToTheWholeWhateverThreadsDo) {
  std::vector<std::jthread> threads;
  for (const MemoryOwner owner : all_memory_owners)
    threads.emplace_back([owner] {
      const OwnerScope scope(owner);
      for (int k = 0; k < 1000; ++k)
        std::free(used(std::realloc(used(std::malloc(8 * k)), 64 * k + 1)));
    });
  threads.clear();
  EXPECT_EQ(heap::live_by_owner().sum(), heap::live_bytes());
}

TEST(MemoryOwner, PeakIsSplitAsItWasThenAndEachOwnerHasItsOwn) {
  heap::reset_peak();
  const auto before = heap::live_by_owner();
  const auto of = [&](const ByOwner<std::int64_t>& now, MemoryOwner owner) {
    return now[owner] - before[owner];
  };
  const auto hold = [](MemoryOwner owner, std::int64_t bytes) {
    const OwnerScope scope(owner);
    return std::vector<char>(static_cast<std::size_t>(bytes));
  };
  hold(MemoryOwner::factor, 20 * MiB);  // and gone
  const auto a = hold(MemoryOwner::factor, 5 * MiB), b = hold(MemoryOwner::answer, 30 * MiB);
  const auto peak = heap::peak_by_owner(), highest = heap::highest_by_owner();
  expect_about(of(peak, MemoryOwner::factor), 5 * MiB, "factor at the peak");
  expect_about(of(peak, MemoryOwner::answer), 30 * MiB, "answer at the peak");
  expect_about(of(highest, MemoryOwner::factor), 20 * MiB, "factor's own");
  EXPECT_NEAR(static_cast<double>(peak.sum()), static_cast<double>(heap::peak_bytes()),
              static_cast<double>(heap::peak_bytes()) / 1000);
}

TEST(HeapProbe, AllocatedBytesAddUpWhatIsFreedToo) {
  const std::int64_t before = heap::allocated_bytes();
  for (int k = 0; k < 3; ++k) std::free(used(std::malloc(MiB)));
  expect_about(heap::allocated_bytes() - before, 3 * MiB, "three blocks");
}

TEST(MemoryWatch, SplitsByOwnerWithTheBlocksInside) {
  StageTimes times;
  MemoryWatch watch(7 * MiB);
  std::vector<char> kept;
  {
    const StageTimer timer(times, Stage::factor);
    const OwnerScope scope(MemoryOwner::factor);
    std::vector<char>(static_cast<std::size_t>(4 * MiB));  // workspace
    kept.resize(static_cast<std::size_t>(MiB));
  }
  {
    const StageTimer timer(times, Stage::recover);
    const std::vector<char> other(static_cast<std::size_t>(2 * MiB));
  }
  const MemorySplit memory = watch.split({}, 7 * MiB);
  expect_about(memory.held[MemoryOwner::factor], MiB, "held");
  expect_about(memory.at_peak[MemoryOwner::factor], 4 * MiB, "at the peak");
  expect_about(memory.at_peak[MemoryOwner::blocks], 7 * MiB, "blocks");
  expect_about(watch.peak_bytes(), 11 * MiB, "peak");
}

class CountedMemory : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Methods, CountedMemory,
                         ::testing::Values("3STEPD", "3STEPD:REFINED", "3STEPD:FILE", "3STEPD:LEAN",
                                           "3STEPD:CHOLMOD", "BLIND", "BLIND:SCHUR", "BLIND:SKY",
                                           "HYBRID", "HYBRID:CHOLMOD", "HYBRID:MUMPS",
                                           "HYBRID:PDAS", "HYBRID:CG", "P2", "3STEPCG:DTIC3",
                                           "3STEPCG:FLIC2", "3STEPCG:SKY", "SYMMLQ:DTIC3",
                                           "SYMMLQ:SKY", "ALM:r=20,rho=20", "ALM:AUTO"),
                         [](const auto& method) { return "m" + std::to_string(method.index); });

TEST_P(CountedMemory, IsWhatIsMeasured) {
  Options options;
  options.limits.repetitions = 1;
  const Method method = select_methods(GetParam()).front();
  testing::CaseBench bench(testing::posed(Scene{}, testing::catalogue_mesh("Mesh1")), options);
  const Record record = bench.measure(method);
  ASSERT_FALSE(record.memory_by_owner.is_null()) << record.status_reason;
  EXPECT_FALSE(record.memory_counts_differ) << record.memory_by_owner.dump(1);
  double at_peak = 0, held = 0, counted = 0;
  for (const auto& [owner, bytes] : record.memory_by_owner.items()) {
    at_peak += bytes.at("peak_bytes").get<double>();
    if (owner == "blocks" || bytes.at("counted_bytes").is_null()) continue;
    held += bytes.at("held_bytes").get<double>();
    counted += bytes.at("counted_bytes").get<double>();
  }
  EXPECT_NEAR(held / counted, 1, 0.1) << record.memory_by_owner.dump(1);
  const auto whole = static_cast<double>(heap::peak_ever_bytes());
  EXPECT_NEAR(at_peak, static_cast<double>(record.peak_heap_bytes.value()), whole / 500);
  EXPECT_GT(record.heap_allocated_bytes.value(), record.storage_bytes.value() / 2);
  const auto of_blocks = record.memory_by_owner.at("blocks").at("held_bytes").get<std::int64_t>();
  if (method.name != "3STEPD:FILE") {  // whose factor is in a file
    EXPECT_GE(record.peak_heap_bytes.value(), record.storage_bytes.value() + of_blocks);
  }
}

}  // namespace
}  // namespace airybench::memory_owner_test
