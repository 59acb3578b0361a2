#include "engine/view/background.h"

#include <gtest/gtest.h>

#include "engine/view/render.h"
#include "tests/view/analytic_scene.h"

namespace acentric {
namespace {

/// A layout under a sky, of which nothing is captured; the scene reaches from z = 0 to z = 3.
WalkScene underTheSky() {
  WalkScene walk;
  walk.layout = test::layoutAroundOrigin(Configuration::b);
  Scene scene;
  scene.bounds.add({-9, -9, 0});
  scene.bounds.add({9, 9, 3});
  scene.sky = {{0.1f, 0.2f, 0.7f}, {0.6f, 0.6f, 0.6f}, {0.2f, 0.1f, 0.1f}};
  walk.scene = std::make_shared<const Scene>(std::move(scene));
  walk.plan = planEffects(*walk.scene);
  return walk;
}

PerspectiveView viewWithPitch(const WalkScene& walk, double pitchDegrees) {
  PerspectiveView view;
  view.eye = {0.1, 0.05, walk.layout->eyeZ()};
  view.pitchRadians = radians(pitchDegrees);
  view.width = 90, view.height = 60;
  return view;
}

TEST(Background, BeginsWhereTheSceneEndsAcrossTheNearBand) {
  const WalkScene walk = underTheSky();
  const double eyeZ = walk.layout->eyeZ(), band = walk.layout->spec.nearBand;
  const BackgroundLimits limits = backgroundLimits(walk, {0, 0, eyeZ});
  EXPECT_NEAR(limits.above, (3 - eyeZ) / band, 1e-6);
  EXPECT_NEAR(limits.below, -eyeZ / band, 1e-6);
  EXPECT_TRUE(limits.holds({0, 0, 1}));
  EXPECT_TRUE(limits.holds({0.01f, 0, -1}));
  EXPECT_FALSE(limits.holds({1, 0, 0}));
  WalkScene without = walk;
  without.scene = nullptr;
  EXPECT_FALSE(backgroundLimits(without, {0, 0, eyeZ}).holds({0, 0, 1}));
}

TEST(Background, IsPaintedThereAndNowhereElseAndIsNoHole) {
  const WalkScene walk = underTheSky();
  TaskRunner runner(1);
  ViewSettings settings;
  settings.fillHoles = false;
  settings.localGeometry = false;
  for (const double pitch : {0.0, 35.0, 60.0, 90.0, -50.0, -89.0}) {
    const PerspectiveView view = viewWithPitch(walk, pitch);
    const BackgroundLimits limits = backgroundLimits(walk, view.eye);
    const auto frame = renderFrame(walk, view, settings, runner);
    ASSERT_TRUE(frame) << frame.error().describe();
    std::size_t painted = 0;
    for (int y = 0; y < view.height; ++y)
      for (int x = 0; x < view.width; ++x) {
        const glm::vec3 direction(view.rayThrough(x + 0.5, y + 0.5));
        const bool expected = limits.holds(direction);
        ASSERT_EQ(frame->source.at(x, y), expected ? kSourceBackground : kSourceHole) << pitch;
        if (!expected) continue;
        const Rgba8 colour = frame->colour.at(x, y);
        const Rgba8 exact = encodeForDisplay(walk.scene->sky.radiance(glm::normalize(direction)), 1);
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(int(colour[c]), int(exact[c]), 1);
        ++painted;
      }
    EXPECT_EQ(painted > 0, showsBackground(limits, view)) << pitch;
    EXPECT_EQ(frame->holeCount(), std::size_t(view.width) * std::size_t(view.height) - painted);
  }
  EXPECT_FALSE(showsBackground(backgroundLimits(walk, {0, 0, 1.6}), viewWithPitch(walk, 0)));
}

}  // namespace
}  // namespace acentric
