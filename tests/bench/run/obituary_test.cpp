// What is reported of a process that has ended.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <new>
#include <thread>

#include "bench/run/isolated_scene.hpp"

namespace airybench::obituary_test {
namespace {

TEST(Obituary, OfOneKilledWithoutTheKernelsCountIsNotOutOfMemory) {
  ActivityBoard board;
  ChildEnd end;
  end.signal = SIGKILL;
  for (const std::optional<bool> counted : {std::optional<bool>(), {true}, {false}}) {
    end.oom_killed = counted;
    EXPECT_EQ(obituary_of(end, board, Limits()).end.status,
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
    EXPECT_EQ(obituary_of(child.end(), board, Limits()).end.status, Status::machine_fault)
        << child.end().exit_code << " " << child.end().signal;
    board.begins(Activity::detail_run);
    EXPECT_EQ(obituary_of(child.end(), board, Limits()).end.status, Status::out_of_memory);
  }
}

// What a case's process does between its activities, as writing fields, has a limit, too.
TEST(ActivityBoard, WhatIsNoActivityHasTheLimitOfOtherPhases) {
  ActivityBoard board;
  board.beat();
  Limits limits;
  EXPECT_FALSE(is_overdue(board, limits));
  limits.others_s = -10;  // whatever has passed
  EXPECT_TRUE(is_overdue(board, limits));
  ChildEnd end;
  end.timed_out = true;
  end.signal = SIGKILL;
  limits.others_s = 5;
  const TimedRun run = obituary_of(end, board, limits);
  EXPECT_EQ(run.end.status, Status::timeout);
  EXPECT_EQ(run.end.reason, "its process was ended between its runs: the limit is 5 s");
  board.begins(Activity::detail_run);
  limits.others_s = -10;
  EXPECT_FALSE(is_overdue(board, limits));
}

// A path's steps are verified within its run, which may hang afterwards.
TEST(ActivityBoard, AnActivityWithinARunInterruptsIt) {
  ActivityBoard board;
  const auto start = std::chrono::steady_clock::now();
  const auto pass = [](double ms) {
    std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(ms));
  };
  {
    const ActivityScope run(&board, Activity::detail_run);
    pass(20);
    {
      const ActivityScope within(&board, Activity::verification);
      EXPECT_EQ(board.activity(), Activity::verification);
      EXPECT_GE(board.seconds_in_runs(), 0.02);
      pass(60);
    }
    EXPECT_EQ(board.activity(), Activity::detail_run);
    EXPECT_GE(board.seconds(), 0.02);
    pass(20);
  }
  EXPECT_EQ(board.activity(), Activity::none);
  EXPECT_GE(board.seconds_in_runs(), 0.04);
  const std::chrono::duration<double> all = std::chrono::steady_clock::now() - start;
  EXPECT_LE(board.seconds_in_runs(), all.count() - 0.06);
  const auto verification = [&](auto inside) {
    const double before_s = board.seconds_in_runs();
    inside();
    return board.seconds_in_runs() - before_s;
  };
  EXPECT_EQ(verification([&] {
              const ActivityScope alone(&board, Activity::verification);
              pass(5);
            }),
            0);
}

}  // namespace
}  // namespace airybench::obituary_test
