#include "engine/pipeline/region_crossings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

Layout hexagonsAndTriangles() {
  LayoutSpec spec;
  spec.cellSize = 1;
  spec.outline = *parseOutline("-4,-4;4,-4;4,4;-4,4");
  return *buildLayout(spec);
}

PathPose poseAt(double x, double y, double yaw = 0) { return {{x, y, 1.6}, yaw, 0}; }

TEST(RegionCrossings, AreNoneWithinARegion) {
  const Layout layout = hexagonsAndTriangles();
  EXPECT_TRUE(crossingsBetween(layout, poseAt(0, 0), poseAt(0.3, 0.2)).empty());
  EXPECT_TRUE(crossingsBetween(layout, poseAt(0, 0), poseAt(0, 0)).empty());
}

TEST(RegionCrossings, EndWhereTheStepLeavesThePlan) {
  const Layout layout = hexagonsAndTriangles();
  EXPECT_TRUE(crossingsBetween(layout, poseAt(100, 0), poseAt(0, 0)).empty());
  const auto out = crossingsBetween(layout, poseAt(0, 0), poseAt(100, 0));
  ASSERT_FALSE(out.empty());
  EXPECT_LT(out.back().after.eye.x, 8);
}

TEST(RegionCrossings, TurnTheShorterWayRound) {
  const Layout layout = hexagonsAndTriangles();
  const auto crossings =
      crossingsBetween(layout, poseAt(-0.2, 0, radians(170)), poseAt(3.1, 0.4, radians(-170)));
  ASSERT_FALSE(crossings.empty());
  for (const RegionCrossing& crossing : crossings)
    EXPECT_LT(std::abs(std::remainder(crossing.before.yawRadians - kPi, kTwoPi)), radians(10.001));
}

TEST(RegionCrossings, FollowEachOtherFromRegionToRegion) {
  const Layout layout = hexagonsAndTriangles();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-3, 3);
  int seen = 0;
  for (int n = 0; n < 300; ++n) {
    const PathPose a = poseAt(place(random), place(random)), b = poseAt(place(random), place(random));
    int region = *layout.regionAt(glm::dvec2(a.eye));
    double share = 0;
    for (const RegionCrossing& crossing : crossingsBetween(layout, a, b)) {
      EXPECT_EQ(crossing.from, region);
      EXPECT_NE(crossing.to, crossing.from);
      EXPECT_EQ(layout.regionAt(glm::dvec2(crossing.before.eye)), crossing.from);
      EXPECT_EQ(layout.regionAt(glm::dvec2(crossing.after.eye)), crossing.to);
      EXPECT_LT(glm::distance(crossing.before.eye, crossing.after.eye), 1e-6);
      EXPECT_GE(crossing.share, share);
      region = crossing.to, share = crossing.share;
      ++seen;
    }
    EXPECT_EQ(region, *layout.regionAt(glm::dvec2(b.eye)));
  }
  EXPECT_GT(seen, 300);
}

}  // namespace
}  // namespace acentric
