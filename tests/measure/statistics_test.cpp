#include "engine/measure/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

namespace acentric {
namespace {

TEST(Spread, OfKnownValues) {
  const Spread odd = spreadOf({3, 1, 2});
  EXPECT_EQ(odd.min, 1);
  EXPECT_EQ(odd.median, 2);
  EXPECT_EQ(odd.p99, 3);
  EXPECT_EQ(odd.max, 3);
  EXPECT_EQ(odd.count, 3);
  EXPECT_EQ(spreadOf({4, 1, 3, 2}).median, 2.5);
  EXPECT_EQ(spreadOf({7}).median, 7);
}

TEST(Spread, TakesTheNearestRankForPercentiles) {
  std::vector<double> values(1000);
  std::iota(values.begin(), values.end(), 1);
  std::shuffle(values.begin(), values.end(), std::mt19937(1));
  const Spread spread = spreadOf(values);
  EXPECT_EQ(spread.p99, 990);
  EXPECT_EQ(spread.median, 500.5);
  std::sort(values.begin(), values.end());
  EXPECT_EQ(percentileOf(values, 0), 1);
  EXPECT_EQ(percentileOf(values, 1), 1000);
  EXPECT_EQ(percentileOf({1, 2, 3, 4}, 0.5), 2);
  for (int percent = 1; percent <= 100; ++percent)
    EXPECT_EQ(percentileOf(values, percent / 100.0), 10.0 * percent);
}

TEST(Spread, OfNothingIsZeroAndNumbersOnlyCount) {
  EXPECT_EQ(spreadOf({}).count, 0);
  EXPECT_EQ(spreadOf({}).max, 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(spreadOf({nan, nan}).count, 0);
  EXPECT_EQ(spreadOf({nan, 5, nan, 4}).max, 5);
  EXPECT_EQ(spreadOf({nan, 5, nan, 4}).count, 2);
  EXPECT_EQ(percentileOf({}, 0.5), 0);
}

}  // namespace
}  // namespace acentric
