#include "engine/inspect/random_poses.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace acentric {
namespace {

/// An L of three unit squares.
StandingArea corner() {
  return {{0, 0}, {2, 2}, [](const glm::dvec2& p) {
            return p.x >= 0 && p.y >= 0 && p.x <= 2 && p.y <= 2 && !(p.x > 1 && p.y > 1);
          }};
}

TEST(RandomPoses, StandEverywhereAlikeAndLookEverywhereAlike) {
  RandomPoseOptions options;
  options.count = 12000;
  const auto poses = randomPoses(corner(), options);
  ASSERT_TRUE(poses);
  ASSERT_EQ(poses->size(), 12000u);
  std::array<int, 3> squares{};
  std::array<int, 8> octants{};
  double lowest = 0, highest = 0, sum = 0;
  for (const RandomPose& pose : *poses) {
    ASSERT_TRUE(corner().contains(pose.place));
    ++squares[pose.place.x > 1 ? 1 : pose.place.y > 1 ? 2 : 0];
    ASSERT_GE(pose.yawRadians, 0);
    ASSERT_LT(pose.yawRadians, kTwoPi);
    ++octants[std::size_t(pose.yawRadians / kTwoPi * 8)];
    lowest = std::min(lowest, pose.pitchRadians), highest = std::max(highest, pose.pitchRadians);
    sum += pose.pitchRadians;
  }
  // Five standard deviations of a count with chance p of n: 5 sqrt(n p (1 - p)).
  for (const int count : squares) EXPECT_NEAR(count, 4000, 5 * std::sqrt(12000 * 2 / 9.0));
  for (const int count : octants) EXPECT_NEAR(count, 1500, 5 * std::sqrt(12000 * 7 / 64.0));
  EXPECT_GE(lowest, -radians(20.0));
  EXPECT_LE(highest, radians(20.0));
  EXPECT_LT(lowest, -radians(19.9));
  EXPECT_GT(highest, radians(19.9));
  EXPECT_NEAR(sum / 12000, 0, radians(20.0) / std::sqrt(3 * 12000) * 5);
}

TEST(RandomPoses, AreThoseOfTheirSeed) {
  RandomPoseOptions options;
  options.count = 3;
  const auto first = randomPoses(corner(), options), again = randomPoses(corner(), options);
  options.seed = 2;
  const auto other = randomPoses(corner(), options);
  ASSERT_TRUE(first && again && other);
  EXPECT_EQ((*first)[2].place, (*again)[2].place);
  EXPECT_EQ((*first)[2].yawRadians, (*again)[2].yawRadians);
  EXPECT_NE((*first)[2].place, (*other)[2].place);
}

TEST(RandomPoses, NeedSomewhereToStand) {
  EXPECT_FALSE(randomPoses({}, {}));
  EXPECT_FALSE(randomPoses({{0, 0}, {1, 1}, [](const glm::dvec2&) { return false; }}, {}));
  RandomPoseOptions none;
  none.count = 0;
  EXPECT_FALSE(randomPoses(corner(), none));
}

TEST(StandingArea, IsTheOutlineWithinPlacedRegions) {
  LayoutSpec spec;
  spec.cellSize = 1;
  spec.outline.loops = {{{-4, -3}, {4, -3}, {4, 3}, {-4, 3}}};
  Layout layout = buildLayout(spec).value();
  const StandingArea area = standingAreaOf(layout);
  EXPECT_EQ(area.low, glm::dvec2(-4, -3));
  EXPECT_EQ(area.high, glm::dvec2(4, 3));
  EXPECT_TRUE(area.contains({0.1, 0.2}));
  EXPECT_FALSE(area.contains({4.1, 0})) << "though regions reach over the outline";
  layout = buildLayout({}).value();
  EXPECT_TRUE(standingAreaOf(layout).empty());
}

TEST(StandingArea, HoldsAsManyPointsOfAGridAsWereAskedFor) {
  StandingArea area{
      {0, 0}, {6, 4}, [](const glm::dvec2& p) { return p.x > 0 && p.x < 6 && p.y > 0 && p.y < 4; }};
  for (const std::size_t count : {1u, 6u, 24u, 150u}) {
    const auto grid = gridIn(area, count);
    EXPECT_NEAR(double(grid.size()), double(count), 0.15 * double(count));
    for (const glm::dvec2& point : grid) EXPECT_TRUE(area.contains(point));
  }
  EXPECT_TRUE(gridIn({}, 5).empty());
}

}  // namespace
}  // namespace acentric
