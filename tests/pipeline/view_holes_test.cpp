#include "engine/pipeline/view_holes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/pipeline/coverage.h"
#include "tests/inspect/little_world.h"
#include "tests/pipeline/baked_room.h"

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

/// Pixel by pixel.
TEST(ViewHoles, AreThoseOfRenderedFrames) {
  test::SceneBuilder builder;
  Material grey = test::matte({0.4f, 0.35f, 0.3f});
  grey.unlit = true;
  const int white = builder.material(grey);
  builder.box(white, {-8, -8, 0}, {8, 8, 3}, true);
  builder.box(white, {2.1f, -0.4f, 0}, {2.2f, 0.5f, 2.4f});
  builder.box(white, {-3.1f, 2.2f, 0.8f}, {-2.2f, 2.9f, 0.83f});  // thinner than samples lie apart
  Project project = test::smallProject(1.2, 3);
  project.bake.maxLayers = 1;  // so that holes open behind things
  const test::BakedRoom room(builder.rays(), project);
  const ProjectReach reach(room.open);
  TaskRunner runner(1);
  ViewSettings settings;
  settings.secondaryCover = false;
  int open = 0, predicted = 0, both = 0;
  for (int n = 0; n < 12; ++n) {
    PerspectiveView view;
    view.eye = {0.9 * std::cos(2.4 * n), 0.9 * std::sin(2.4 * n), room.open.layout->eyeZ()};
    view.yawRadians = 0.53 * n;
    view.width = 160, view.height = 90;
    const auto frame = renderFrame(room.walk, view, settings, runner);
    const auto holes = predictHoles(*reach, view, settings, runner);
    ASSERT_TRUE(frame && holes);
    for (std::size_t i = 0; i < holes->openPixels.pixels.size(); ++i) {
      const bool isOpen = test::isOpen(frame->source.pixels[i]),
                 isPredicted = holes->openPixels.pixels[i] != 0;
      open += isOpen ? 1 : 0, predicted += isPredicted ? 1 : 0, both += isOpen && isPredicted ? 1 : 0;
    }
  }
  EXPECT_GT(open, 20);
  EXPECT_GT(both, 0.8 * std::max(open, predicted)) << open << " open, " << predicted << " predicted";
}

}  // namespace
}  // namespace acentric
