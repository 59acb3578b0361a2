#include "engine/image/capture.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace acentric {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Three columns of four rows: column 0 has a pane of glass over a wall, column 1 nothing, column 2 sky.
Capture smallCapture() {
  Capture capture;
  capture.camera = {{1, 2, 1.6}, 0.5, 1.0, 0.6, -0.6, 3, 4};
  capture.columnStart = {0, 3, 3, 4};
  capture.row = {1, 1, 3, 0};
  capture.inverseDistance = {0.5f, 0.25f, 1.0f, 0.0f};
  const HalfColour wall = packColour({0.5f, 0.25f, 2, 1});
  capture.colour = {packColour({0.1f, 0.2f, 0.3f, 0.25f}), wall, wall, wall};
  capture.roles = {1, 3, 2, 0x80};
  return capture;
}

/// Column 2 shows a wall in mirror 4.
Capture withReflection() {
  Capture capture = smallCapture();
  capture.mirror = {0, 0, 4, 0};
  capture.reflections = {{0, 0, 0, 1}, {2}, {0.125f}, {packColour({1, 1, 1, 1})}, {2}, {4}};
  return capture;
}

TEST(PackColour, KeepsElevenBitsAndExactHalves) {
  const glm::vec4 exact(0.5f, 65504, 0.000060975551605224609375f, 1);
  EXPECT_EQ(unpackColour(packColour(exact)), exact);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> exponent(-14, 15);
  for (int i = 0; i < 100000; ++i) {
    const float value = std::exp2(exponent(random));
    const float back = unpackColour(packColour(glm::vec4(value, 0, 0, 1))).x;
    ASSERT_LE(std::abs(back - value), value * 0x1p-11f);
  }
}

TEST(PackColour, EveryHalfSurvives) {
  for (std::uint32_t code = 0; code < 0x7c00; ++code) {
    const HalfColour colour(std::uint16_t(code), 0, 0, 0x3c00);
    ASSERT_EQ(packColour(unpackColour(colour)), colour) << code;
  }
}

TEST(PackColour, MakesEveryColourStorable) {
  EXPECT_EQ(unpackColour(packColour({kNan, -2, kInfinity, 5})), glm::vec4(0, 0, 65504, 1));
  EXPECT_EQ(unpackColour(packColour({1e30f, 65519, -0.0f, kNan})), glm::vec4(65504, 65504, 0, 0));
  EXPECT_EQ(packColour({-0.0f, 0, 0, -1}), HalfColour(0));
}

TEST(StoredInverseDistance, IsOffByHalfAStepOrBySixteenBitsAtMost) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> exponent(-30, 30);
  for (const double step : {0.0, 0x1p-15, 0x1p-3})
    for (int i = 0; i < 20000; ++i) {
      const double w = std::exp2(exponent(random));
      const float stored = storedInverseDistance(w, step);
      ASSERT_EQ(std::bit_cast<std::uint32_t>(stored) & 0xffu, 0u) << w;
      ASSERT_EQ(storedInverseDistance(double(stored), step), stored) << "stored once, stored for good";
      ASSERT_GT(stored, 0);
      if (step > 0 && w < step / 2)
        ASSERT_EQ(double(stored), step) << "a surface stays one, however far";
      else
        ASSERT_LE(std::abs(double(stored) - w), std::max(step / 2, w * 0x1p-16)) << w;
    }
  EXPECT_EQ(storedInverseDistance(0, 0.5), 0) << "sky";
  EXPECT_EQ(storedInverseDistance(-1, 0.5), 0);
}

TEST(Capture, CountsLayersOfAPixel) {
  Capture capture = smallCapture();
  EXPECT_EQ(capture.maxLayers(), 2);
  EXPECT_EQ(Capture{}.maxLayers(), 0);
  capture.columnStart = {0, 0, 0, 0};
  capture.row.clear();
  EXPECT_EQ(capture.maxLayers(), 0);
  // Equal rows of neighbouring columns are different pixels.
  capture.columnStart = {0, 1, 2, 2};
  capture.row = {2, 2};
  EXPECT_EQ(capture.maxLayers(), 1);
}

TEST(Capture, SoundOnesPass) {
  EXPECT_TRUE(smallCapture().check());
  EXPECT_TRUE(withReflection().check());
  EXPECT_TRUE(withReflection().hasReflections());
  EXPECT_FALSE(smallCapture().hasReflections());
  Capture empty = smallCapture();
  empty.columnStart = {0, 0, 0, 0};
  empty.row.clear();
  empty.inverseDistance.clear();
  empty.colour.clear();
  empty.roles.clear();
  EXPECT_TRUE(empty.check());
}

TEST(Capture, EveryBrokenInvariantIsFound) {
  const std::pair<const char*, std::function<void(Capture&)>> breakages[] = {
      {"camera", [](Capture& c) { c.camera.fovRadians = kNan; }},
      {"columns", [](Capture& c) { c.camera.columns = 4; }},
      {"no offsets", [](Capture& c) { c.columnStart.clear(); }},
      {"first offset", [](Capture& c) { c.columnStart[0] = 1; }},
      {"last offset", [](Capture& c) { c.columnStart[3] = 5; }},
      {"falling offsets", [](Capture& c) { c.columnStart[1] = 4, c.columnStart[2] = 3; }},
      {"offset beyond the end", [](Capture& c) { c.columnStart[1] = 900; }},
      {"fewer distances", [](Capture& c) { c.inverseDistance.pop_back(); }},
      {"more colours", [](Capture& c) { c.colour.emplace_back(); }},
      {"row outside", [](Capture& c) { c.row[3] = 4; }},
      {"rows unsorted", [](Capture& c) { c.row[2] = 0; }},
      {"layers unsorted", [](Capture& c) { std::swap(c.inverseDistance[0], c.inverseDistance[1]); }},
      {"negative distance", [](Capture& c) { c.inverseDistance[2] = -1; }},
      {"distance NaN", [](Capture& c) { c.inverseDistance[1] = kNan; }},
      {"distance infinite", [](Capture& c) { c.inverseDistance[0] = kInfinity; }},
      {"distance too fine", [](Capture& c) { c.inverseDistance[0] = std::nextafter(0.5f, 1.0f); }},
      {"step NaN", [](Capture& c) { c.distanceStep = double(kNan); }},
      {"step negative", [](Capture& c) { c.distanceStep = -1; }},
      {"fewer roles", [](Capture& c) { c.roles.pop_back(); }},
      {"needed by nobody", [](Capture& c) { c.roles[1] = 0; }},
      {"radiance infinite", [](Capture& c) { c.colour[2].r = 0x7c00; }},
      {"radiance NaN", [](Capture& c) { c.colour[2].b = 0x7e00; }},
      {"radiance negative", [](Capture& c) { c.colour[2].g = 0xbc00; }},
      {"alpha above 1", [](Capture& c) { c.colour[2].a = 0x3c01; }},
  };
  for (const auto& [name, damage] : breakages) {
    Capture capture = smallCapture();
    damage(capture);
    const Status status = capture.check();
    ASSERT_FALSE(status) << name;
    EXPECT_EQ(status.error().kind, ErrorKind::malformed) << name;
  }
}

TEST(Capture, EveryBrokenReflectionIsFound) {
  const std::pair<const char*, std::function<void(Capture&)>> breakages[] = {
      {"surfaces without mirrors", [](Capture& c) { c.mirror.clear(); }},
      {"mirrors without reflections", [](Capture& c) { c.reflections = {}; }},
      {"fewer mirrors", [](Capture& c) { c.mirror.pop_back(); }},
      {"blended mirror", [](Capture& c) { c.mirror[0] = 4; }},
      {"a list of nothing",
       [](Capture& c) {
         c.mirror.clear();
         c.reflections = {{0, 0, 0, 0}, {}, {}, {}, {}, {}};
       }},
      {"columns", [](Capture& c) { c.reflections.columnStart.pop_back(); }},
      {"offset", [](Capture& c) { c.reflections.columnStart[1] = 9; }},
      {"fewer distances", [](Capture& c) { c.reflections.inverseDistance.clear(); }},
      {"fewer colours", [](Capture& c) { c.reflections.colour.clear(); }},
      {"fewer roles", [](Capture& c) { c.reflections.roles.clear(); }},
      {"fewer mirrors that show", [](Capture& c) { c.reflections.mirror.clear(); }},
      {"no mirror", [](Capture& c) { c.reflections.mirror[0] = 0; }},
      {"row", [](Capture& c) { c.reflections.row[0] = 4; }},
      {"distance", [](Capture& c) { c.reflections.inverseDistance[0] = -1; }},
      {"nobody's", [](Capture& c) { c.reflections.roles[0] = 0; }},
      {"radiance", [](Capture& c) { c.reflections.colour[0].r = 0x7c00; }},
      {"blended", [](Capture& c) { c.reflections.colour[0].a = 0x3800; }},
  };
  for (const auto& [name, damage] : breakages) {
    Capture capture = withReflection();
    damage(capture);
    const Status status = capture.check();
    ASSERT_FALSE(status) << name;
    EXPECT_EQ(status.error().kind, ErrorKind::malformed) << name;
  }
}

}  // namespace
}  // namespace acentric
