#include "engine/geometry/perspective_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

TEST(PerspectiveView, LooksAlongItsYawAndPitch) {
  PerspectiveView view;
  view.yawRadians = radians(30), view.pitchRadians = radians(20);
  const glm::dvec3 forward = view.rayThrough(0.5 * view.width, 0.5 * view.height);
  EXPECT_LT(glm::distance(
                forward, glm::dvec3(std::cos(radians(20)) * directionOf(radians(30)), std::sin(radians(20)))),
            1e-12);
  // The left border lies counter-clockwise, the upper border higher.
  EXPECT_GT(cross(glm::dvec2(forward), glm::dvec2(view.rayThrough(0, 270))), 0);
  EXPECT_GT(view.rayThrough(480, 0).z, forward.z);
  const glm::dmat3 m = view.viewFromWorld();
  EXPECT_NEAR(glm::determinant(m), 1, 1e-12);
  EXPECT_LT(glm::distance(m * forward, glm::dvec3(0, 0, 1)), 1e-12);
}

TEST(PerspectiveView, TheHorizontalFieldOfViewSpansTheWidth) {
  for (const double fov : {0.1, 1.0, 59.999, 60.0, 120.0, 179.0, 179.9}) {
    PerspectiveView view;
    view.fovRadians = radians(fov);
    ASSERT_TRUE(view.check());
    const double middle = 0.5 * view.height;
    const double angle = std::acos(glm::dot(view.rayThrough(0, middle), view.rayThrough(view.width, middle)));
    EXPECT_NEAR(degrees(angle), fov, 1e-5);
  }
}

TEST(PerspectiveView, RefusesHostileNumbers) {
  const auto refuses = [](auto change) {
    PerspectiveView view;
    change(view);
    return !view.check();
  };
  EXPECT_TRUE(refuses([](auto& v) { v.eye.y = NAN; }));
  EXPECT_TRUE(refuses([](auto& v) { v.yawRadians = INFINITY; }));
  EXPECT_TRUE(refuses([](auto& v) { v.pitchRadians = 1.6; }));
  EXPECT_TRUE(refuses([](auto& v) { v.fovRadians = 0; }));
  EXPECT_TRUE(refuses([](auto& v) { v.fovRadians = kPi; }));
  EXPECT_TRUE(refuses([](auto& v) { v.width = 0; }));
  EXPECT_TRUE(refuses([](auto& v) { v.height = 20000; }));
}

/// The azimuths of the picture's border, relative to the yaw: extremes of the whole picture unless it holds a
/// pole.
struct Extent {
  double low = 0, high = 0;
};

TEST(AzimuthRange, IsThatOfThePicturesPixelsAtEveryPitchAndWidth) {
  for (const double fov : {1.0, 30.0, 59.999, 90.0, 120.0, 179.0})
    for (const auto& [width, height] :
         {std::pair{96, 54}, std::pair{30, 90}, std::pair{1, 1}, std::pair{200, 3}})
      for (double pitch = -90; pitch <= 90; pitch += 2.5)
        for (const double yaw : {0.0, 100.0, 179.99, -135.0, 400.0}) {
          PerspectiveView view;
          view.fovRadians = radians(fov), view.pitchRadians = radians(pitch), view.yawRadians = radians(yaw);
          view.width = width, view.height = height;
          const AzimuthRange range = azimuthRange(view);
          ASSERT_GE(range.low, 0);
          ASSERT_LT(range.low, kTwoPi);
          ASSERT_LE(range.width, kTwoPi);
          Extent extent;
          bool holdsPole = false;
          for (int row = 0; row <= height; ++row)
            for (int column = 0; column <= width; ++column) {
              const glm::dvec3 ray = view.rayThrough(column, row);
              const double offset = std::remainder(std::atan2(ray.y, ray.x) - view.yawRadians, kTwoPi);
              holdsPole |= std::abs(offset) > kPi / 2 + 1e-9;
              extent.low = std::min(extent.low, offset), extent.high = std::max(extent.high, offset);
              // Every point of the picture lies in the range.
              const double within = wrapAngle(std::atan2(ray.y, ray.x) - range.low);
              ASSERT_TRUE(within <= range.width + 1e-9 || within >= kTwoPi - 1e-9)
                  << "fov " << fov << " pitch " << pitch << " yaw " << yaw << " at " << column << ", " << row;
            }
          // And the range is no wider than it must be.
          if (range.width < kTwoPi) {
            EXPECT_FALSE(holdsPole);
            EXPECT_NEAR(range.width, extent.high - extent.low, 1e-9);
          } else {
            const double poleAt = view.focalPixels() * std::tan(kPi / 2 - std::abs(view.pitchRadians));
            EXPECT_LE(poleAt, 0.5 * height + 1e-6) << "only a picture that holds a pole sees every azimuth";
          }
        }
}

TEST(AzimuthRange, OfALevelViewIsItsFieldOfView) {
  PerspectiveView view;
  view.yawRadians = 1;
  for (const double fov : {0.1, 60.0, 179.9}) {
    view.fovRadians = radians(fov);
    const AzimuthRange range = azimuthRange(view);
    EXPECT_NEAR(range.width, radians(fov), 1e-9);
    EXPECT_NEAR(std::remainder(range.low + 0.5 * range.width - 1, kTwoPi), 0, 1e-9);
  }
}

TEST(AzimuthRange, OfAPitchedViewIsWiderAndWithTheZenithAllRound) {
  PerspectiveView view;
  double last = azimuthRange(view).width;
  for (const double pitch : {10.0, 30.0, 50.0, 70.0}) {
    view.pitchRadians = radians(pitch);
    EXPECT_GT(azimuthRange(view).width, last);
    last = azimuthRange(view).width;
  }
  view.pitchRadians = radians(85);
  EXPECT_EQ(azimuthRange(view).width, kTwoPi);
  view.pitchRadians = radians(-90);
  EXPECT_EQ(azimuthRange(view).width, kTwoPi);
}

TEST(WrapAngle, GivesAnglesFromZeroToBelowTwoPi) {
  for (const double angle : {0.0, -1e-300, -1e-17, kTwoPi, -kTwoPi, 1e6, -1e6, 3 * kTwoPi - 1e-15}) {
    const double wrapped = wrapAngle(angle);
    EXPECT_GE(wrapped, 0);
    EXPECT_LT(wrapped, kTwoPi);
    EXPECT_NEAR(std::cos(wrapped), std::cos(angle), 1e-9);
  }
}

}  // namespace
}  // namespace acentric
