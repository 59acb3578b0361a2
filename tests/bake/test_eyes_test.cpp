#include "engine/bake/test_eyes.h"

#include <gtest/gtest.h>

#include "tests/bake/layout_builder.h"
#include "tests/bake/scene_builder.h"

namespace acentric {
namespace {

using test::matte;
using test::SceneBuilder;
using test::square;

constexpr double kEyeZ = 1.6;
constexpr std::uint64_t kFreshSeed = 4242;

TEST(TestEyes, BeginWithTheCornersAndStayInTheRegion) {
  const ConvexPolygon triangle{{{0, 0}, {2, 0}, {0.5, 1.5}}};
  for (const int count : {1, 2, 3, 4, 7, 20}) {
    BakeSettings settings;
    settings.testEyes = count;
    settings.eyeRange = 0.2;
    const auto eyes = placedEyes(triangle, 1.6, settings);
    ASSERT_EQ(eyes.size(), std::size_t(count));
    for (std::size_t i = 0; i < eyes.size(); ++i) {
      EXPECT_LT(glm::distance(triangle.nearestPoint(glm::dvec2(eyes[i])), glm::dvec2(eyes[i])), 1e-5);
      EXPECT_NEAR(eyes[i].z, 1.6, 0.2 + 1e-12);
      for (std::size_t j = 0; j < i; ++j) EXPECT_GT(glm::distance(eyes[i], eyes[j]), 0.05) << i << " " << j;
      if (count >= 3 && i < 3) {
        EXPECT_LT(glm::distance(glm::dvec2(eyes[i]), triangle.corners[i]), 1e-5);
      }
    }
  }
}

TEST(TestEyes, AreSharedByRegionsThatMeetInACorner) {
  const auto left = placedEyes(square(0.5, {-0.5 + 1e-13, 0.3}), 1.6, {});
  const auto right = placedEyes(square(0.5, {0.5, 0.3}), 1.6, {});
  int shared = 0;
  for (const glm::dvec3& eye : left) shared += int(std::ranges::count(right, eye));
  EXPECT_EQ(shared, 2);
}

/// A hall behind a screen of slats, and a doorway in its side: much is seen from few places alone.
RayScenePtr hallBehindSlats() {
  SceneBuilder builder;
  const int material = builder.material(matte());
  builder.box(material, {-9, -9, 0}, {9, 9, 3}, true);
  for (int n = -20; n < 20; ++n)
    builder.box(material, {0.15f * float(n), 2, 0}, {0.15f * float(n) + 0.12f, 2.1f, 3}, false);
  builder.box(material, {2, -9, 0}, {2.2f, -0.3f, 3}, false);
  builder.box(material, {2, 0.3f, 0}, {2.2f, 2, 3}, false);
  return builder.rays();
}

RegionEyes found(const RayScene& scene, double mayBeLost, int workers = 0, int placed = 4) {
  BakeSettings settings;
  settings.testEyes = placed;
  settings.pruningLoss = mayBeLost;
  TaskRunner runner(workers);
  RayCounts rays;
  return findTestEyes(scene, square(1), square(1), kEyeZ, settings, runner, rays);
}

TEST(TestEyes, AreAddedUntilNoMoreIsLostThanMayBe) {
  const RayScenePtr scene = hallBehindSlats();
  const ConvexPolygon region = square(1);
  const RandomLooks fresh(*scene, region, region, kEyeZ, {});
  TaskRunner runner;
  RayCounts rays;
  std::size_t before = 0;
  for (const double mayBeLost : {0.01, 0.003, 0.001}) {
    const RegionEyes eyes = found(*scene, mayBeLost);
    EXPECT_EQ(eyes.placed, 4u);
    EXPECT_GT(eyes.eyes.size(), before);
    ASSERT_LT(eyes.eyes.size(), std::size_t(kMostTestEyes));
    EXPECT_LE(eyes.loss.atMost(), mayBeLost);
    EXPECT_LE(fresh.loss(eyes.eyes, 60'000, kFreshSeed, runner, rays).share(), mayBeLost)
        << "looks that no eye was chosen by";
    for (const glm::dvec3& eye : eyes.eyes) {
      EXPECT_LT(glm::distance(region.nearestPoint(glm::dvec2(eye)), glm::dvec2(eye)), 1e-5);
      EXPECT_NEAR(eye.z, kEyeZ, BakeSettings{}.eyeRange + 1e-9);
    }
    before = eyes.eyes.size();
  }
  const std::vector<glm::dvec3> placed = found(*scene, 0).eyes;
  EXPECT_GT(fresh.loss(placed, 60'000, kFreshSeed, runner, rays).share(), 0.015) << "before any is added";
}

TEST(TestEyes, AreTheSameOnAnyNumberOfThreadsAndAskedAgain) {
  const RayScenePtr scene = hallBehindSlats();
  const RegionEyes alone = found(*scene, 0.003), together = found(*scene, 0.003, 3);
  EXPECT_EQ(alone.eyes, together.eyes);
  EXPECT_EQ(alone.loss, together.loss);
  BakeSettings settings;
  settings.testEyes = 4, settings.pruningLoss = 0.003;
  TestEyes eyes(*scene, settings);
  TaskRunner runner;
  RayCounts rays;
  const auto first = eyes.of(square(1), square(1), kEyeZ, runner, rays);
  EXPECT_EQ(first->eyes, alone.eyes);
  const std::uint64_t traced = rays.visibility;
  EXPECT_EQ(eyes.of(square(1), square(1), kEyeZ, runner, rays), first);
  EXPECT_EQ(rays.visibility, traced) << "known already";
  EXPECT_NE(eyes.of(square(1), square(2), kEyeZ, runner, rays), first) << "another near band";
  EXPECT_EQ(eyes.summary().regions, 2u);
  EXPECT_EQ(eyes.summary().most, first->eyes.size());
  EXPECT_LE(eyes.summary().worstLimit, 0.003);
}

TEST(TestEyes, AreThosePlacedWhereNothingIsLostOrMayNotBeLookedFor) {
  SceneBuilder builder;
  builder.box(builder.material(matte()), {-6, -5, 0}, {6, 5, 3}, true);
  const RayScenePtr room = builder.rays();
  const RegionEyes enough = found(*room, 0.001, 0, 1);
  EXPECT_EQ(enough.eyes.size(), 1u);
  EXPECT_EQ(enough.loss.lost, 0u);
  EXPECT_EQ(enough.loss.looks, 12'000u);
  const RegionEyes unasked = found(*hallBehindSlats(), 0, 0, 1);
  EXPECT_EQ(unasked.eyes.size(), 1u);
  EXPECT_EQ(unasked.loss.looks, 0u);
}

/// Where not even the most eyes are enough, the loss that is left is told.
TEST(TestEyes, SayWhatIsLostWhereSixtyFourAreNotEnough) {
  const RegionEyes eyes = found(*hallBehindSlats(), 2e-5);
  EXPECT_EQ(eyes.eyes.size(), std::size_t(kMostTestEyes));
  EXPECT_GT(eyes.loss.atMost(), 2e-5);
}

TEST(TestEyes, AreNotFoundWhenStopped) {
  const RayScenePtr scene = hallBehindSlats();
  TestEyes eyes(*scene, {});
  TaskRunner runner;
  RayCounts rays;
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(eyes.of(square(1), square(1), kEyeZ, runner, rays, stop.get_token()), nullptr);
  EXPECT_NE(eyes.of(square(1), square(1), kEyeZ, runner, rays), nullptr) << "nothing half done is kept";
}

}  // namespace
}  // namespace acentric
