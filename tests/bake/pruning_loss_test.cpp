#include "engine/bake/pruning_loss.h"

#include <gtest/gtest.h>

#include "tests/bake/layout_builder.h"
#include "tests/bake/scene_builder.h"

namespace acentric {
namespace {

using test::matte;
using test::SceneBuilder;
using test::square;

constexpr int kLooks = 4000;

Region regionOf(double side) {
  Region region;
  region.polygon = region.grown = square(side);
  return region;
}

BakeSettings eyes(int count) {
  BakeSettings settings;
  settings.testEyes = count;
  settings.eyeRange = 0;
  return settings;
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
  const auto loss = pruningLoss(*builder.rays(), regionOf(1), 1.6, eyes(1), kLooks, 1);
  EXPECT_EQ(loss.looks, std::uint64_t(kLooks));
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
    const auto loss = pruningLoss(*rays, regionOf(1), 1.6, eyes(count), kLooks, 7);
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
  Region region = regionOf(1);
  EXPECT_GT(pruningLoss(*rays, region, 1.6, eyes(1), kLooks, 3).lost, 0u);
  region.grown = square(4);
  EXPECT_EQ(pruningLoss(*rays, region, 1.6, eyes(1), kLooks, 3).lost, 0u);
}

}  // namespace
}  // namespace acentric
