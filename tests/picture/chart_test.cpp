#include "engine/picture/chart.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>

#include "engine/base/file.h"
#include "engine/image/image.h"
#include "engine/picture/plan_picture.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;

fs::path pathFor(const char* name) {
  return fs::path(testing::TempDir()) / ("chart-" + std::to_string(getpid()) + "-" + name);
}

Chart twoLines() {
  Chart chart;
  chart.title = "Growth";
  chart.across = "triangles", chart.up = "milliseconds";
  chart.lines.push_back({"level", {{1e3, 10}, {1e5, 10}}});
  chart.lines.push_back({"rising", {{1e3, 1}, {1e5, 100}}});
  return chart;
}

TEST(Chart, NamesALineThatEndsBeforeOthersAtItsOwnEnd) {
  const fs::path path = pathFor("short.png");
  Chart chart = twoLines();
  chart.lines[1].points.back() = {1e4, 10'000};
  ASSERT_TRUE(writeChart(chart, path));
  const auto image = readColourImage(path);
  ASSERT_TRUE(image);
  glm::ivec2 end(-1);
  for (int y = 0; y < image->height; ++y)
    for (int x = 0; x < image->width; ++x)
      if (image->at(x, y) == categoryColour(1) && x > end.x) end = {x, y};
  ASSERT_GT(end.x, 200);
  ASSERT_LT(end.x, image->width - 300) << "it ends in the middle";
  int ink = 0;
  for (int y = end.y - 12; y <= end.y + 12; ++y)
    for (int x = end.x + 5; x <= end.x + 60; ++x) ink += image->at(x, y).r < 100 ? 1 : 0;
  EXPECT_GT(ink, 40) << "letters";
  fs::remove(path);
}

TEST(Chart, DrawsEqualValuesLevelAndPowersStraight) {
  const fs::path path = pathFor("lines.png");
  ASSERT_TRUE(writeChart(twoLines(), path));
  const auto image = readColourImage(path);
  ASSERT_TRUE(image);
  // Height of each line over the columns where it has its pure colour.
  const auto heights = [&](int line) {
    std::vector<double> all;
    for (int x = 0; x < image->width; ++x) {
      double sum = 0;
      int count = 0;
      for (int y = 0; y < image->height; ++y)
        if (image->at(x, y) == categoryColour(line)) sum += y, ++count;
      if (count > 0) all.push_back(sum / count);
    }
    return all;
  };
  const auto level = heights(0), rising = heights(1);
  ASSERT_GT(level.size(), 300u);
  ASSERT_GT(rising.size(), 300u);
  for (const double y : level) EXPECT_NEAR(y, level.front(), 1.5);
  constexpr std::size_t kDot = 20;  // at the ends
  const std::size_t last = rising.size() - 1 - kDot;
  const double slope = (rising[last] - rising[kDot]) / double(last - kDot);
  EXPECT_LT(slope, -0.2) << "larger values lie higher";
  for (std::size_t i = kDot; i <= last; ++i)
    EXPECT_NEAR(rising[i], rising[kDot] + slope * double(i - kDot), 2)
        << "a power of 1 over logarithmic axes";
  EXPECT_NEAR(rising[rising.size() / 2], level.front(), 4) << "they meet at 10";
  fs::remove(path);
}

TEST(Chart, IsAVectorDrawingToo) {
  const fs::path path = pathFor("lines.svg");
  ASSERT_TRUE(writeChart(twoLines(), path));
  const auto text = readText(path);
  ASSERT_TRUE(text);
  EXPECT_NE(text->find("<svg"), std::string::npos);
  fs::remove(path);
}

TEST(Chart, RefusesWhatHasNoPlaceOnIt) {
  const auto refused = [](auto&& change, const char* name = "refused.png") {
    Chart chart = twoLines();
    change(chart);
    const Status written = writeChart(chart, pathFor(name));
    return !written && !fs::exists(pathFor(name));
  };
  EXPECT_TRUE(refused([](Chart& c) { c.lines[0].points[1].y = 0; }));
  EXPECT_TRUE(refused([](Chart& c) { c.lines[0].points[0].x = std::nan(""); }));
  EXPECT_TRUE(refused([](Chart& c) { c.lines[1].points.clear(); }));
  EXPECT_TRUE(refused([](Chart& c) { c.lines.clear(); }));
  EXPECT_TRUE(refused([](Chart&) {}, "refused.jpg"));
}

}  // namespace
}  // namespace acentric
