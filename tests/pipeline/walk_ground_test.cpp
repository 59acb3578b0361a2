#include "engine/pipeline/walk_ground.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/layout/layout_fixtures.h"

namespace acentric {
namespace {

/// 6 x 4 m with a pillar in it and a wall of 5 cm that ends 1 m before the far side.
Layout roomWithPillar(Configuration configuration = Configuration::b) {
  LayoutSpec spec;
  spec.configuration = configuration;
  spec.cellSize = 1;
  spec.outline.loops = {{{0, 0}, {6, 0}, {6, 4}, {0, 4}},
                        {{1, 1}, {2, 1}, {2, 2}, {1, 2}},
                        {{4, -0.5}, {4.05, -0.5}, {4.05, 3}, {4, 3}}};
  return buildLayout(spec).value();
}

TEST(WalkGround, OneStandsWithinTheOutlineOrInACellAddedBeyondIt) {
  Layout layout = roomWithPillar();
  EXPECT_TRUE(mayStand(layout, {3, 3}));
  EXPECT_FALSE(mayStand(layout, {1.5, 1.5})) << "in the pillar";
  EXPECT_FALSE(mayStand(layout, {-0.05, 2})) << "the region reaches beyond the outline";
  LayoutSpec spec = layout.spec;
  const CellId beyond = cellAt(spec, {9.2, 2}).id;
  spec.added.insert(beyond);
  layout = buildLayout(spec).value();
  const glm::dvec2 centre = cellPolygon(spec, beyond).centroid();
  EXPECT_TRUE(mayStand(layout, centre));
  spec.added.clear();
  spec.removed.insert(cellAt(spec, {3, 3.5}).id);
  EXPECT_FALSE(mayStand(buildLayout(spec).value(), {3, 3.5}));
}

TEST(WalkGround, APlaceThatIsToldInCentimetresIsOneToStand) {
  LayoutSpec spec;
  spec.cellSize = 1;
  spec.outline.loops = {{{0.0031, 0.0017}, {6.0049, 0.3}, {5.7, 4.0023}, {0.3, 3.9}}};
  const Layout layout = buildLayout(spec).value();
  int outside = 0;
  for (double x = -1.003; x < 7; x += 0.19)
    for (double y = -1.007; y < 5; y += 0.17) {
      const glm::dvec2 told = nearestStandingCentimetre(layout, {x, y});
      EXPECT_TRUE(mayStand(layout, glm::round(told * 100.0) / 100.0)) << x << " " << y;
      if (mayStand(layout, {x, y})) continue;
      ++outside;
      EXPECT_LT(glm::distance(told, nearestStanding(layout, {x, y})), 0.03) << x << " " << y;
    }
  EXPECT_GT(outside, 100);
}

TEST(WalkGround, TheNearestPlaceIsAsNearAsAnyOfAFineGrid) {
  const Layout layout = roomWithPillar();
  test::Random random(3);
  for (int n = 0; n < 60; ++n) {
    const glm::dvec2 point(random(-2, 8), random(-2, 6));
    const glm::dvec2 found = nearestStanding(layout, point);
    EXPECT_TRUE(mayStand(layout, found)) << point.x << ", " << point.y;
    double nearest = std::numeric_limits<double>::infinity();
    for (double x = 0.02; x < 6; x += 0.04)
      for (double y = 0.02; y < 4; y += 0.04)
        if (mayStand(layout, {x, y})) nearest = std::min(nearest, glm::distance(point, {x, y}));
    EXPECT_LE(glm::distance(found, point), nearest + 0.01);
    if (mayStand(layout, point)) {
      EXPECT_EQ(found, point);
    }
  }
}

TEST(WalkGround, AStraightWayThatIsFreeIsWalkedToItsEnd) {
  const glm::dvec2 end = walkTo(roomWithPillar(), {0.5, 3}, {3.5, 3.5});
  EXPECT_NEAR(glm::distance(end, {3.5, 3.5}), 0, 1e-9);
}

TEST(WalkGround, AgainstAWallOneSlidesAlongIt) {
  const Layout layout = roomWithPillar();
  glm::dvec2 at(2.5, 3.5);
  for (int i = 0; i < 60; ++i) {
    const glm::dvec2 next = walkTo(layout, at, at + glm::dvec2(0.01, 0.02));
    EXPECT_TRUE(mayStand(layout, next));
    at = next;
  }
  EXPECT_GT(at.x, 3.0) << "what leads along the wall is kept, or nearly so";
  EXPECT_GT(at.y, 3.95);
}

TEST(WalkGround, HeadOnOneStopsAndAConvexCornerDoesNotHoldOne) {
  const Layout layout = roomWithPillar();
  const glm::dvec2 stopped = walkTo(layout, {0.5, 1.5}, {1.5, 1.5});
  EXPECT_LT(stopped.x, 1.0);
  EXPECT_NEAR(stopped.y, 1.5, 0.05);
  glm::dvec2 at(0.9, 1.9);  // past the pillar's corner
  for (int i = 0; i < 150; ++i) at = walkTo(layout, at, at + glm::dvec2(0.015, 0.01));
  EXPECT_GT(at.x, 2.2);
}

TEST(WalkGround, NoWallIsWalkedThroughHoweverFastAndWhicheverWay) {
  const Layout layout = roomWithPillar();
  test::Random random(11);
  for (int walk = 0; walk < 10; ++walk) {
    glm::dvec2 at(random(2.2, 3.9), random(0.1, 2.5));
    for (int i = 0; i < 12; ++i) {
      const glm::dvec2 next = walkTo(layout, at, at + glm::dvec2(random(-0.2, 2), random(-1, 0.2)));
      EXPECT_TRUE(mayStand(layout, next));
      EXPECT_FALSE(at.x < 4 && next.x > 4.05 && at.y < 2.9 && next.y < 2.9) << "through the thin wall";
      at = next;
      at.y = std::min(at.y, 2.5);
      if (!mayStand(layout, at)) break;
    }
  }
}

TEST(WalkGround, RandomWalksNeverLeaveTheGroundNorGetStuck) {
  for (const Configuration configuration : test::kAllConfigurations) {
    const Layout layout = roomWithPillar(configuration);
    test::Random random(unsigned(configuration) + 1);
    glm::dvec2 at = nearestStanding(layout, {3, 3});
    for (int i = 0; i < 300; ++i) {
      at = walkTo(layout, at, at + glm::dvec2(random(-0.3, 0.3), random(-0.3, 0.3)));
      ASSERT_TRUE(mayStand(layout, at));
      if (i % 30 != 0) continue;
      double farthest = 0;  // some way is always open
      for (int k = 0; k < 8; ++k)
        farthest =
            std::max(farthest, glm::distance(at, walkTo(layout, at, at + 0.1 * directionOf(kTwoPi * k / 8))));
      EXPECT_GT(farthest, 0.05);
    }
  }
}

}  // namespace
}  // namespace acentric
