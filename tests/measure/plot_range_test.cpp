#include "engine/measure/plot_range.h"

#include <gtest/gtest.h>

#include <vector>

namespace acentric {
namespace {

TEST(PlotRange, LeavesOutWhatLiesFarFromAllOthers) {
  const std::vector<double> values{3.3, 3.5, 3.8, 4.0, 4.2, 4.4, 5.2, 48.5};
  const PlotRange range = plotRange(values, {}, true);
  EXPECT_EQ(range.low, 3.3);
  EXPECT_EQ(range.high, 5.2);
  EXPECT_FALSE(range.holds(48.5));
  const std::vector<double> always{48.5};
  EXPECT_EQ(plotRange(values, always, true).high, 48.5) << "unless it matters";
}

TEST(PlotRange, ShowsAllOfFewAndOfEvenlySpreadValues) {
  const std::vector<double> few{1, 2, 3, 100};
  EXPECT_EQ(plotRange(few, {}, false).high, 100);
  const std::vector<double> decades{0.01, 0.1, 1, 10, 100, 1000};
  EXPECT_EQ(plotRange(decades, {}, true).low, 0.01);
  EXPECT_EQ(plotRange(decades, {}, true).high, 1000);
  const std::vector<double> alike{2, 2, 2, 2, 2, 3};
  EXPECT_EQ(plotRange(alike, {}, false).high, 3) << "where most are the same nothing tells what is far";
}

}  // namespace
}  // namespace acentric
