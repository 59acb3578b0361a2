#include "engine/view/splat_painter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "engine/view/walk_scene.h"

namespace acentric {
namespace {

TEST(PaintSplats, PaintsByCornersWhatItPaintsPixelByPixel) {
  constexpr int kWidth = 40, kHeight = 30, kCount = 500;
  std::mt19937 random(8);
  for (const PaintMode mode : {PaintMode::over, PaintMode::overBlended, PaintMode::nearest,
                               PaintMode::blendOnNearest, PaintMode::reflect})
    for (const std::uint32_t openBelow : {0u, 4u}) {
      if (mode == PaintMode::reflect && openBelow != 0) continue;
      Canvas before;
      before.x0 = 100, before.width = kWidth, before.height = kHeight;
      for (int i = 0; i < kWidth * kHeight; ++i) {
        before.pixels.push_back(canvasPixel(std::uint32_t(random() % 6) << 24, float(random() % 100)));
        before.mirrors.push_back(static_cast<std::uint8_t>(random() % 3));
      }
      before.stamps.resize(before.pixels.size());
      before.blended.resize(before.pixels.size());
      before.mirrorPixels = before.pixels;

      // Samples straight ahead of a camera that is the eye, one column each.
      ProjectColumn column{};
      column.z[1] = -20, column.a[2] = 1;
      column.maxInverseDistance = 1000, column.maxSide = 4, column.roles = 1;
      column.x0 = 100, column.x1 = 100 + kWidth, column.y1 = kHeight;
      column.slot = 5;
      std::vector<float> tangents;
      for (int i = 0; i < 64; ++i) tangents.push_back(float(2 - i) / 40);
      Canvas corners = before, pixels = before;
      std::uint64_t counts[2] = {};
      int wholes = 0;
      for (int round = 0; round < kCount; ++round) {
        column.a[0] = 98 + float(random() % 4400) / 100;
        column.footprint = float(random() % 300) / 100;
        std::vector<PackedSample> samples;
        std::vector<Rgba8> colour;
        std::vector<std::uint8_t> mirror;
        for (std::uint16_t row = 0; row < 64; row = static_cast<std::uint16_t>(row + random() % 3)) {
          samples.push_back(packSample(float(random() % 50), 1, row));
          const bool clear = mode != PaintMode::over && random() % 8 == 0;
          colour.push_back(
              colourOf(std::uint32_t(random() & 0x7fffffu) | (clear ? 0x80800000u : 0xff000000u)));
          mirror.push_back(static_cast<std::uint8_t>(random() % 3));
        }
        SplatMemory memory;
        SplatArrays splats = memory.room(samples.size());
        const int count =
            projectSamplesScalar(column, sampleColumn(tangents.data(), samples.data(), colour.data()),
                                 std::uint32_t(samples.size()), splats);
        wholes += int(count - std::count(splats.steps, splats.steps + count, 0u));
        const bool reversed = round % 2 == 0, pixelByPixel = round % 4 < 2;
        const auto paint = [&](Canvas& canvas) {
          const PaintTarget target{&canvas,  colour.data(), samples.data(), mirror.data(), column.slot,
                                   7,        25.0f,         {0, 100},       100,           120,
                                   openBelow};
          return paintSplats(target, mode, splats, 0, count, reversed, pixelByPixel);
        };
        counts[0] += paint(corners);
        std::fill(splats.steps, splats.steps + count, 0u);
        counts[1] += paint(pixels);
      }
      corners.settleMirrors();
      pixels.settleMirrors();
      ASSERT_GT(wholes, 1000);
      EXPECT_GT(counts[0], mode == PaintMode::blendOnNearest ? 10u : 100u);
      EXPECT_EQ(counts[0], counts[1]);
      EXPECT_NE(corners.pixels, before.pixels);
      if (mode == PaintMode::reflect) {
        EXPECT_TRUE(std::ranges::none_of(corners.pixels, [](CanvasPixel p) { return (p & 0x800000) != 0; }))
            << "clear ones are left out";
      }
      EXPECT_EQ(corners.pixels, pixels.pixels) << int(mode) << openBelow;
      EXPECT_EQ(corners.mirrors, pixels.mirrors) << int(mode) << openBelow;
    }
}

}  // namespace
}  // namespace acentric
