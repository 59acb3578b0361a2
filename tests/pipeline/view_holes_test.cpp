#include "engine/pipeline/view_holes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/inspect/little_world.h"

namespace acentric {
namespace {

using test::emptyRoom;
using test::furnishedRoom;
using test::heldSlowly;
using test::World;

PerspectiveView viewFrom(const Layout& layout, const glm::dvec2& place, double yaw) {
  PerspectiveView view;
  view.eye = glm::dvec3(place, layout.eyeZ());
  view.yawRadians = yaw;
  view.width = 96, view.height = 54;
  return view;
}

TEST(ViewHoles, AreNoneInAnEmptyRoomAndFindNothingBehindWalls) {
  const World world(emptyRoom(), Configuration::b);
  TaskRunner runner(1);
  for (int k = 0; k < 8; ++k) {
    const auto holes =
        predictHoles(world.reach(), viewFrom(world.layout, {0.2, 0.3}, kTwoPi * k / 8), {}, runner);
    ASSERT_TRUE(holes);
    EXPECT_EQ(holes->missed, 0);
    EXPECT_EQ(holes->open, 0);
    EXPECT_LT(holes->expected, 0.02) << "splats part at the far ends of floor and ceiling alone";
    for (const float distance : holes->rayDistance.pixels) EXPECT_TRUE(std::isfinite(distance));
  }
}

TEST(ViewHoles, AreTheSharesOfPixelsWhoseSurfaceNoDrawnCoverHolds) {
  const World world(furnishedRoom(), Configuration::b);
  const CaptureReach reach = world.reach(1);
  TaskRunner runner(1);
  double sum = 0, less = 0;
  test::Random random(4);
  for (int k = 0; k < 14; ++k) {
    const glm::dvec2 place =
        random.within(world.layout.regions[std::size_t(random.index(world.layout.regions.size()))].polygon);
    const PerspectiveView view = viewFrom(world.layout, place, random(0, kTwoPi));
    const Region& region =
        world.layout.regions[std::size_t(world.layout.regionAt(glm::dvec2(view.eye)).value())];
    int missed = 0;
    for (int y = 0; y < view.height; ++y)
      for (int x = 0; x < view.width; ++x) {
        const glm::dvec3 direction = view.rayThrough(x + 0.5, y + 0.5);
        const OpaqueHit hit = world.tracer.trace(view.eye, direction, 0, 1e9);
        const glm::dvec3 point = view.eye + hit.distance * direction;
        if (!hit.found() || region.grown.containsClosed(glm::dvec2(point))) continue;
        bool held = false;
        for (const Cover& cover : region.covers)
          for (const Piece& piece : cover.pieces)
            held = held || (piece.holds(glm::dvec2(point)) && heldSlowly(world, piece.camera, point, 1));
        missed += held ? 0 : 1;
      }
    const auto all = predictHoles(reach, view, {}, runner);
    ViewSettings chosenOnly;
    chosenOnly.secondaryCover = false;
    const auto chosen = predictHoles(reach, view, chosenOnly, runner);
    ASSERT_TRUE(all && chosen);
    EXPECT_NEAR(all->missed, double(missed) / (view.width * view.height), 1e-9);
    EXPECT_LE(all->open, all->missed + 1e-12);
    EXPECT_NEAR(all->expected, all->open, 0.004) << "splats reach over the edges of holes";
    EXPECT_GE(chosen->missed, all->missed);
    sum += all->missed, less += chosen->missed;
  }
  EXPECT_GT(sum, 0) << "the furniture opens a hole in some view";
  EXPECT_GT(less, sum) << "the other hand closes some";
}

TEST(ViewHoles, RefuseAnEyeOutsideEveryRegion) {
  const World world(emptyRoom(), Configuration::b);
  TaskRunner runner;
  EXPECT_FALSE(predictHoles(world.reach(), viewFrom(world.layout, {100, 0}, 0), {}, runner));
}

}  // namespace
}  // namespace acentric
