#include "engine/base/task_runner.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace acentric {
namespace {

TEST(TaskRunner, RunsInlineAndInOrderWithoutWorkers) {
  TaskRunner runner(0);
  std::vector<std::size_t> order;
  runner.parallelFor(5, [&](std::size_t i) { order.push_back(i); });
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
}

TEST(TaskRunner, CallsEachIndexExactlyOnce) {
  for (int workers : {1, 3}) {
    TaskRunner runner(workers);
    for (std::size_t count : {std::size_t(0), std::size_t(1), std::size_t(1000)}) {
      std::vector<std::atomic<int>> calls(count);
      runner.parallelFor(count, [&](std::size_t i) { ++calls[i]; });
      for (auto& c : calls) EXPECT_EQ(c.load(), 1);
    }
  }
}

TEST(TaskRunner, WorkIsVisibleAfterTheCall) {
  TaskRunner runner(2);
  for (int round = 0; round < 200; ++round) {
    std::vector<int> values(64, 0);
    runner.parallelFor(values.size(), [&](std::size_t i) { values[i] = int(i) + round; });
    for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i], int(i) + round);
  }
}

}  // namespace
}  // namespace acentric
