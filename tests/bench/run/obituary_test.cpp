// What is reported of a process that has ended.
#include <gtest/gtest.h>

#include <csignal>
#include <new>

#include "bench/run/isolated_scene.hpp"

namespace airybench::obituary_test {
namespace {

TEST(Obituary, OfOneKilledWithoutTheKernelsCountIsNotOutOfMemory) {
  ActivityBoard board;
  ChildEnd end;
  end.signal = SIGKILL;
  for (const std::optional<bool> counted : {std::optional<bool>(), {true}, {false}}) {
    end.oom_killed = counted;
    EXPECT_EQ(obituary_of(end, board, Options()).status,
              counted == false ? Status::machine_fault : Status::out_of_memory);
  }
}

TEST(Obituary, OfOneWithoutMemoryOutsideOfARunIsNoCrash) {
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

}  // namespace
}  // namespace airybench::obituary_test
