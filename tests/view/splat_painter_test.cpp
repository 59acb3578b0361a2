#include "engine/view/splat_painter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "engine/view/walk_scene.h"

namespace acentric {
namespace {

/// A canvas of 8 x 6 pixels, columns 100 to 107, and splats of two samples to paint on it.
struct PaintedSplats {
  static constexpr Rgba8 kRed{255, 0, 0, 255}, kGreen{0, 255, 0, 255}, kGlass{0, 0, 255, 128};
  Canvas canvas;
  std::vector<Rgba8> colour{kRed, kGreen};
  std::vector<PackedSample> samples{packSample(1, 1, 0), packSample(0.5f, 1, 1)};
  std::vector<std::uint8_t> mirror{0, 0};
  std::uint32_t openBelow = 0;

  PaintedSplats() {
    canvas.x0 = 100, canvas.width = 8, canvas.height = 6;
    canvas.pixels.assign(48, canvasPixel(2u << 24, 0.75f));
    canvas.stamps.resize(48), canvas.blended.resize(48), canvas.mirrors.resize(48);
    canvas.mirrorPixels.resize(48);
  }

  /// Those of the samples, each of 3 pixels, the second two to the right and one down.
  std::uint64_t paint(PaintMode mode, int x, int y, bool reversed = false) {
    std::vector<Splat> splats;
    for (std::uint32_t i = 0; i < 2; ++i)
      splats.push_back(
          {x + int(2 * i), y + int(i), 3, i,
           canvasPixel((wordOf(colour[i]) & 0xffffffu) | 5u << 24, inverseDistanceOf(samples[i]))});
    const PaintTarget target{&canvas, colour.data(), samples.data(), mirror.data(), 5, 7, 25.0f, {0, 100},
                             100,     104,           openBelow};
    return paintSplats(target, mode, splats, reversed, false);
  }
  Rgba8 at(int x, int y) const { return colourOf(0xff000000u | std::uint32_t(canvas.column(x)[y])); }
  auto ofSlot(std::uint32_t slot) const {
    return std::ranges::count_if(canvas.pixels, [=](CanvasPixel p) { return slotOf(p) == slot; });
  }
};

TEST(PaintSplats, LaterOnesLieOnTopWhateverTheirDepth) {
  PaintedSplats forth, back;
  EXPECT_EQ(forth.paint(PaintMode::over, 101, 1), 2u);
  back.paint(PaintMode::over, 101, 1, true);
  EXPECT_EQ(forth.at(103, 2), PaintedSplats::kGreen);
  EXPECT_EQ(back.at(103, 2), PaintedSplats::kRed);
  for (const PaintedSplats* p : {&forth, &back}) {
    EXPECT_EQ(p->ofSlot(5), 16);
    EXPECT_EQ(p->at(101, 1), PaintedSplats::kRed);
    EXPECT_EQ(p->at(105, 4), PaintedSplats::kGreen);
  }
}

TEST(PaintSplats, AreClippedAndCountedWhereTheyBegin) {
  PaintedSplats p;
  EXPECT_EQ(p.paint(PaintMode::over, 98, -1), 1u) << "the first begins left of the columns that count";
  EXPECT_EQ(p.ofSlot(5), 9) << "what is left of the first lies below the second";
  EXPECT_EQ(p.paint(PaintMode::over, 104, 4), 0u) << "right of them";
}

TEST(PaintSplats, TheNearestWinWithADepthTest) {
  PaintedSplats p;
  p.paint(PaintMode::nearest, 101, 1);
  EXPECT_EQ(p.ofSlot(5), 9) << "what was there is nearer than the second";
  EXPECT_EQ(p.at(103, 2), PaintedSplats::kRed);
}

TEST(PaintSplats, PaintOnlyWhatIsOpen) {
  PaintedSplats p;
  p.openBelow = 4;
  p.canvas.column(101)[1] = canvasPixel(4u << 24, 0.1f);
  EXPECT_EQ(p.paint(PaintMode::over, 101, 1), 0u) << "the first pixels of both are not";
  EXPECT_EQ(p.ofSlot(5), 8 + 8 - 1) << "the second does not cover the first, which is in front now";
}

TEST(PaintSplats, BlendedOnesTintOnce) {
  PaintedSplats p;
  p.colour = {PaintedSplats::kGlass, PaintedSplats::kGlass};
  p.samples[1] = p.samples[0];
  p.paint(PaintMode::overBlended, 101, 1);
  EXPECT_EQ(p.ofSlot(5), 0) << "they keep the slot of what lies behind";
  EXPECT_EQ(p.at(103, 2), p.at(101, 1)) << "of one surface: no darker where they overlap";
  EXPECT_NE(p.at(101, 1), p.at(107, 5));
  EXPECT_EQ(p.at(101, 1).b, 188) << "half of its light";

  PaintedSplats depth;
  depth.colour[1] = PaintedSplats::kGlass;
  depth.paint(PaintMode::nearest, 101, 1);
  EXPECT_EQ(depth.ofSlot(5), 9) << "blended ones are left out";
  depth.samples[1] = packSample(2, 1, 1);
  depth.paint(PaintMode::blendOnNearest, 101, 1);
  EXPECT_EQ(depth.at(105, 4).b, 188) << "and come then";
}

TEST(PaintSplats, MirrorsAreToldAndReflectionsStayInThem) {
  PaintedSplats p;
  p.mirror = {1, 2};
  p.paint(PaintMode::over, 101, 1);
  EXPECT_EQ(std::ranges::count(p.canvas.mirrors, 1), 7);
  EXPECT_EQ(std::ranges::count(p.canvas.mirrors, 2), 9);
  p.canvas.column(101)[1] = canvasPixel(6u << 24, 3);  // painted over without saying so
  p.canvas.settleMirrors();
  EXPECT_EQ(std::ranges::count(p.canvas.mirrors, 1), 6);
  const float depth = inverseZDepthOf(p.canvas.column(105)[4]);
  p.colour = {PaintedSplats::kGreen, PaintedSplats::kRed};
  p.samples[1] = packSample(9, 1, 1);
  EXPECT_EQ(p.paint(PaintMode::reflect, 102, 1), 1u) << "the second begins where none is seen";
  EXPECT_EQ(p.at(102, 1), PaintedSplats::kGreen);
  EXPECT_EQ(p.at(103, 2), PaintedSplats::kGreen) << "another mirror's";
  EXPECT_EQ(p.at(105, 4), PaintedSplats::kRed);
  EXPECT_EQ(inverseZDepthOf(p.canvas.column(105)[4]), depth) << "the mirror's own";
}

}  // namespace
}  // namespace acentric
