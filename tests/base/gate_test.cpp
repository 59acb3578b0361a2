#include "engine/base/gate.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "engine/base/task_runner.h"

namespace acentric {
namespace {

using namespace std::chrono_literals;

class GateTest : public testing::TestWithParam<int> {};

TEST_P(GateTest, ClosedHoldsWorkBetweenItsPieces) {
  Gate gate;
  TaskRunner runner(GetParam(), &gate);
  std::atomic<int> done = 0, doneWhenClosed = 0;
  std::thread work([&] {
    runner.parallelFor(200, [&](std::size_t) {
      if (++done != 20) return;
      gate.close();
      doneWhenClosed = done.load();
    });
  });
  while (doneWhenClosed == 0) std::this_thread::yield();
  std::this_thread::sleep_for(60ms);  // what would be done if it were open
  EXPECT_LE(done, doneWhenClosed + GetParam()) << "at most what each thread had begun";
  gate.open();
  work.join();
  EXPECT_EQ(done, 200);
}

INSTANTIATE_TEST_SUITE_P(Workers, GateTest, testing::Values(0, 1, 3));

}  // namespace
}  // namespace acentric
