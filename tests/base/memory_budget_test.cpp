#include "engine/base/memory_budget.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace acentric {
namespace {

TEST(MemoryBudget, CountsWhatSharesHoldAndTheMostThatWas) {
  MemoryBudget budget(100);
  {
    MemoryBudget::Share a(budget), b(budget);
    a.set(70);
    b.set(60);
    EXPECT_EQ(budget.held(), 130u) << "what is there is counted, room or not";
    a.set(10);
    b.add(5);
    MemoryBudget::Share moved(std::move(b));
    a = std::move(moved);
    EXPECT_EQ(budget.held(), 65u);
  }
  EXPECT_EQ(budget.held(), 0u);
  EXPECT_EQ(budget.peak(), 130u);
  MemoryBudget::Share nobody;
  nobody.set(1000);
  EXPECT_EQ(budget.peak(), 130u);
}

TEST(MemoryBudget, WaitsForWhatGoesByItselfAndForNothingElse) {
  MemoryBudget budget(100);
  MemoryBudget::Share own(budget);
  own.set(90);
  MemoryBudget::Share more(budget);
  EXPECT_TRUE(more.setWhenRoom(50, {})) << "nobody would ever make room";
  more.set(0);
  MemoryBudget::Share passing(budget);
  passing.set(10);
  passing.pass();
  std::stop_source stop;
  std::jthread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    stop.request_stop();
  });
  EXPECT_FALSE(more.setWhenRoom(50, stop.get_token()));
  EXPECT_EQ(more.bytes(), 0u);
  std::jthread writer([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    passing = {};
  });
  EXPECT_TRUE(more.setWhenRoom(50, {}));
  EXPECT_EQ(budget.held(), 140u);
}

TEST(MemoryBudget, GivesRoomToOneAtATime) {
  MemoryBudget budget(100);
  MemoryBudget::Share passing(budget);
  passing.set(1);
  passing.pass();
  // Room for one of two: both ask at once, many times.
  const auto ask = [&] {
    for (int n = 0; n < 2'000; ++n) {
      MemoryBudget::Share share(budget);
      ASSERT_TRUE(share.setWhenRoom(60, {}));
      std::this_thread::yield();
    }
  };
  std::jthread other(ask);
  ask();
  other.join();
  EXPECT_EQ(budget.peak(), 61u);
}

}  // namespace
}  // namespace acentric
