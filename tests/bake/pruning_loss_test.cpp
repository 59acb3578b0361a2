#include "engine/bake/pruning_loss.h"

#include <gtest/gtest.h>

#include "engine/bake/test_eyes.h"
#include "tests/bake/layout_builder.h"
#include "tests/bake/scene_builder.h"

namespace acentric {
namespace {

using test::matte;
using test::SceneBuilder;
using test::square;

/// Of test eyes placed evenly.
PruningLoss lossOf(const RayScene& scene, int testEyes, std::uint64_t seed,
                   const ConvexPolygon& grown = square(1), int workers = 0) {
  BakeSettings settings;
  settings.testEyes = testEyes;
  settings.eyeRange = 0;
  const ConvexPolygon region = square(1);
  TaskRunner runner(workers);
  RayCounts rays;
  return RandomLooks(scene, region, grown, 1.6, settings)
      .loss(placedEyes(region, 1.6, settings), 4000, seed, runner, rays);
}

TEST(PruningLoss, LimitsAreThoseOfTheTables) {
  EXPECT_NEAR((PruningLoss{100, 0}.atMost()), 1 - std::pow(0.05, 0.01), 1e-6);
  EXPECT_NEAR((PruningLoss{10, 1}.atMost()), 0.394163, 1e-5);
  EXPECT_NEAR((PruningLoss{100, 5}.atMost()), 0.102253, 1e-5);
  EXPECT_LT((PruningLoss{1'000'000, 500}.atMost()), 5.4e-4);
  EXPECT_EQ((PruningLoss{0, 0}.atMost()), 1);
  EXPECT_EQ((PruningLoss{7, 7}.atMost()), 1);
}

TEST(PruningLoss, IsNoneInARoomThatHidesNothing) {
  SceneBuilder builder;
  builder.box(builder.material(matte()), {-6, -5, 0}, {6, 5, 3}, true);
  const auto loss = lossOf(*builder.rays(), 1, 1);
  EXPECT_EQ(loss.looks, 4000u);
  EXPECT_EQ(loss.lost, 0u);
}

/// Slats with gaps between them: each eye sees other strips of the wall behind.
TEST(PruningLoss, FallsWithTheNumberOfTestEyes) {
  SceneBuilder builder;
  const int material = builder.material(matte());
  builder.box(material, {-9, -9, 0}, {9, 9, 3}, true);
  for (int n = -20; n < 20; ++n)
    builder.box(material, {0.15f * float(n), 2, 0}, {0.15f * float(n) + 0.12f, 2.1f, 3}, false);
  const auto rays = builder.rays();
  double before = 1;
  for (const int count : {1, 4, 16, 64}) {
    const auto loss = lossOf(*rays, count, 7);
    EXPECT_EQ(lossOf(*rays, count, 7, square(1), 2), loss) << "on more threads";
    EXPECT_LT(loss.share(), before) << count;
    EXPECT_GT(loss.atMost(), loss.share());
    before = loss.share();
  }
  EXPECT_LT(before, 0.002);
}

/// What is near is drawn as polygons and cannot be lost.
TEST(PruningLoss, IsNotOfWhatLiesInTheNearBand) {
  SceneBuilder builder;
  const int material = builder.material(matte());
  builder.box(material, {-1.9f, -1.9f, 0}, {1.9f, 1.9f, 3}, true);
  for (int n = -8; n < 8; ++n)
    builder.box(material, {0.15f * float(n), 1, 0}, {0.15f * float(n) + 0.12f, 1.1f, 3}, false);
  const auto rays = builder.rays();
  EXPECT_GT(lossOf(*rays, 1, 3).lost, 0u);
  EXPECT_EQ(lossOf(*rays, 1, 3, square(4)).lost, 0u);
}

}  // namespace
}  // namespace acentric
