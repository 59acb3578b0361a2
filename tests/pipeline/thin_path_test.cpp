#include "engine/pipeline/thin_path.h"

#include <gtest/gtest.h>

#include <random>

namespace acentric {
namespace {

constexpr double kRate = 60;

/// Recorded at 60 poses a second for so long.
template <class At>
CameraPath recorded(double seconds, At at) {
  CameraPath path;
  for (int i = 0; i <= int(seconds * kRate); ++i) {
    PathPose pose = at(i / kRate);
    pose.seconds = i / kRate;
    path.poses.push_back(pose);
  }
  return path;
}

void expectWithin(const CameraPath& thin, const CameraPath& all, const PathTolerance& tolerance) {
  for (const PathPose& pose : all.poses) {
    const PathPose kept = poseAt(thin, pose.seconds);
    EXPECT_LE(glm::distance(kept.eye, pose.eye), tolerance.metres * (1 + 1e-9));
    EXPECT_LE(std::abs(std::remainder(kept.yawRadians - pose.yawRadians, kTwoPi)),
              tolerance.turnRadians * (1 + 1e-9));
  }
}

TEST(ThinPath, AStraightSteadyWalkIsTwoKeyPoses) {
  const CameraPath walk = recorded(20, [](double t) { return PathPose{{1.4 * t, -0.7 * t, 1.6}, 1, 0}; });
  EXPECT_EQ(thinned(walk).poses, (std::vector{walk.poses.front(), walk.poses.back()}));
}

TEST(ThinPath, KeepsCornersAndRests) {
  const CameraPath walk = recorded(6, [](double t) {
    return PathPose{{std::min(t, 2.0), std::max(0.0, t - 4), 1.6}, 0, 0};  // 2 s east, 2 s still, 2 s north
  });
  const CameraPath thin = thinned(walk);
  ASSERT_EQ(thin.poses.size(), 4u);
  EXPECT_EQ(thin.poses[1].seconds, 2);
  EXPECT_EQ(thin.poses[2].seconds, 4);
}

TEST(ThinPath, ASteadyTurnAllRoundKeepsItsSense) {
  const CameraPath turn = recorded(8, [](double t) { return PathPose{{0, 0, 1.6}, 1.6 * t, 0}; });
  const CameraPath thin = thinned(turn);
  EXPECT_LE(thin.poses.size(), 8u);
  expectWithin(thin, turn, {});
}

TEST(ThinPath, StaysWithinTheToleranceOfARandomWalk) {
  std::mt19937 random(7);
  std::normal_distribution<double> step(0, 0.01);
  PathPose pose{{0, 0, 1.6}, 0, 0};
  const CameraPath walk = recorded(30, [&](double) {
    pose.eye += glm::dvec3(step(random), step(random), 0);
    pose.yawRadians += step(random);
    return pose;
  });
  for (const PathTolerance tolerance : {PathTolerance{}, PathTolerance{0.1, 0.1}}) {
    const CameraPath thin = thinned(walk, tolerance);
    EXPECT_LT(thin.poses.size(), walk.poses.size());
    EXPECT_TRUE(thin.check());
    expectWithin(thin, walk, tolerance);
  }
}

TEST(ThinPath, GrowsTheToleranceWhereTooManyWouldBeLeft) {
  const CameraPath circle = recorded(60, [](double t) {
    return PathPose{{3 * std::cos(t), 3 * std::sin(t), 1.6}, t, 0};
  });
  EXPECT_GT(thinned(circle).poses.size(), 20u);
  EXPECT_LE(thinned(circle, {}, 20).poses.size(), 20u);
}

}  // namespace
}  // namespace acentric
