#include "engine/image/capture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace acentric {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

const Sky kBlue{{0.25f, 0.5f, 1}, {0.5f, 0.5f, 1}, {0, 0, 0}};

/// Three columns of four rows: column 0 has a pane of glass over a wall, column 1 nothing, column 2 a wall
/// before the sky.
Capture smallCapture() {
  Capture capture;
  capture.camera = {{1, 2, 1.6}, 0.5, 1.0, 0.6, -0.6, 3, 4};
  capture.columnStart = {0, 3, 3, 4};
  capture.row = {1, 1, 3, 2};
  capture.inverseDistance = {0.5f, 0.25f, 1.0f, 0.125f};
  const HalfColour wall = packColour({0.5f, 0.25f, 2, 1});
  capture.colour = {packColour({0.1f, 0.2f, 0.3f, 0.25f}), wall, wall, wall};
  capture.roles = {1, 3, 2, 0x80};
  capture.background = {kBlue, {0, 0, 0, 3}, {0, 1, 3}, {1, 3, 4}, {0x80, 1, 0x80}};
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
      {"infinitely far", [](Capture& c) { c.inverseDistance[3] = 0; }},
  };
  for (const auto& [name, damage] : breakages) {
    Capture capture = smallCapture();
    damage(capture);
    const Status status = capture.check();
    ASSERT_FALSE(status) << name;
    EXPECT_EQ(status.error().kind, ErrorKind::malformed) << name;
  }
}

TEST(Capture, EveryBrokenSilhouetteIsFound) {
  Capture sound = smallCapture();
  sound.coverage = {1, 0xffff, 0x8000, 0x00ff};
  sound.plane = {0, 1, 1, 0};
  sound.planes = {{{0.5f, 0, 0}, 0}, {{0, 0.25f, -1}, 1}};
  sound.planeTolerance = 0.001;
  ASSERT_TRUE(sound.check());
  const auto breaks = [&](const std::function<void(Capture&)>& edit) {
    Capture broken = sound;
    edit(broken);
    return !broken.check();
  };
  EXPECT_TRUE(breaks([](Capture& c) { c.coverage[1] = 0; }));
  EXPECT_TRUE(breaks([](Capture& c) { c.plane[3] = 2; }));
  EXPECT_TRUE(breaks([](Capture& c) { c.coverage.pop_back(); }));
  EXPECT_TRUE(breaks([](Capture& c) { c.plane.pop_back(), c.coverage.pop_back(); }));
  EXPECT_TRUE(breaks([](Capture& c) { c.plane.clear(), c.coverage.clear(); }));
  EXPECT_TRUE(breaks([](Capture& c) { c.planes[0].normal.y = kNan; }));
  EXPECT_TRUE(breaks([](Capture& c) { c.planes[1].normal.z = kInfinity; }));
  EXPECT_TRUE(breaks([](Capture& c) { c.planes[1].away = 2; }));
  EXPECT_TRUE(breaks([](Capture& c) { c.planeTolerance = 0; }));
  EXPECT_TRUE(breaks([](Capture& c) { c.planeTolerance = kInfinity; }));
}

TEST(Capture, EveryBrokenBackgroundIsFound) {
  const std::pair<const char*, std::function<void(Capture&)>> breakages[] = {
      {"a sky that is nowhere seen",
       [](Capture& c) {
         c.background = {kBlue, {}, {}, {}, {}};
       }},
      {"offsets of nothing",
       [](Capture& c) {
         c.background = {{}, {0, 0, 0, 0}, {}, {}, {}};
       }},
      {"radiance NaN", [](Capture& c) { c.background.sky.horizon.y = kNan; }},
      {"radiance negative", [](Capture& c) { c.background.sky.ground.z = -1; }},
      {"radiance infinite", [](Capture& c) { c.background.sky.zenith.x = kInfinity; }},
      {"fewer ends", [](Capture& c) { c.background.endRow.pop_back(); }},
      {"fewer roles", [](Capture& c) { c.background.roles.pop_back(); }},
      {"no offsets", [](Capture& c) { c.background.columnStart.clear(); }},
      {"columns", [](Capture& c) { c.background.columnStart.pop_back(); }},
      {"first offset", [](Capture& c) { c.background.columnStart[0] = 1; }},
      {"last offset", [](Capture& c) { c.background.columnStart[3] = 4; }},
      {"falling offsets",
       [](Capture& c) { c.background.columnStart[1] = 2, c.background.columnStart[2] = 1; }},
      {"no row", [](Capture& c) { c.background.endRow[0] = 0; }},
      {"row outside", [](Capture& c) { c.background.endRow[2] = 5; }},
      {"rows twice", [](Capture& c) { c.background.firstRow[1] = 0; }},
      {"unsorted", [](Capture& c) { c.background.firstRow[2] = 0, c.background.endRow[2] = 1; }},
      {"one run as two", [](Capture& c) { c.background.roles[1] = 0x80; }},
      {"needed by nobody", [](Capture& c) { c.background.roles[0] = 0; }},
  };
  for (const auto& [name, damage] : breakages) {
    Capture capture = smallCapture();
    damage(capture);
    const Status status = capture.check();
    ASSERT_FALSE(status) << name;
    EXPECT_EQ(status.error().kind, ErrorKind::malformed) << name;
  }
}

/// Whatever pixels are told, in parts of any number of columns, the runs hold just these.
TEST(BackgroundBuilder, HoldsThePixelsThatItWasTold) {
  std::mt19937 random(11);
  constexpr int kColumns = 40, kRows = 25;
  for (int round = 0; round < 50; ++round) {
    std::vector<std::uint8_t> told(kColumns * kRows, 0);
    BackgroundBuilder all, part;
    for (int column = 0; column < kColumns; ++column) {
      for (int row = 0; row < kRows; ++row) {
        if (random() % 3 == 0) continue;
        const auto roles = std::uint8_t(1 + random() % 2);
        told[std::size_t(column * kRows + row)] = roles;
        part.add(row, roles);
      }
      part.closeColumn();
      if (random() % 4 == 0 || column + 1 == kColumns) all.append(part), part = {};
    }
    Capture capture;
    capture.camera = {{1, 2, 1.6}, 0.5, 1.0, 0.6, -0.6, kColumns, kRows};
    capture.columnStart.assign(kColumns + 1, 0);
    capture.background = std::move(all).finish(kBlue);
    ASSERT_TRUE(capture.check());
    const CaptureBackground& runs = capture.background;
    std::vector<std::uint8_t> held(told.size(), 0);
    for (std::size_t column = 0; column < kColumns; ++column)
      for (std::size_t i = runs.columnStart[column]; i < runs.columnStart[column + 1]; ++i)
        for (std::size_t row = runs.firstRow[i]; row < runs.endRow[i]; ++row)
          held[column * kRows + row] = runs.roles[i];
    EXPECT_EQ(held, told);
    EXPECT_EQ(runs.pixelCount(), std::size_t(kColumns * kRows) - std::size_t(std::ranges::count(told, 0)));
  }
  BackgroundBuilder nothing;
  nothing.closeColumn();
  EXPECT_EQ(std::move(nothing).finish(kBlue), CaptureBackground{});
}

TEST(Capture, ReflectionsMayBeClearAsGlassIs) {
  Capture capture = withReflection();
  capture.reflections.colour[0].a = 0x3800;
  EXPECT_TRUE(capture.check());
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
      {"blended sky",
       [](Capture& c) {
         c.reflections.inverseDistance[0] = 0;
         c.reflections.colour[0].a = 0x3800;
       }},
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
