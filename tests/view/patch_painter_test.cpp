#include "engine/view/patch_painter.h"

#include <gtest/gtest.h>

#include "engine/view/kernels.h"
#include "flat_patch.h"

namespace acentric {
namespace {

constexpr int kFrameWidth = 12, kFrameHeight = 24;
constexpr std::uint32_t kSecondSlot = 4, kFirstSlot = 6;
constexpr std::uint32_t kOfFirst = 0xff0000ff, kOfSecond = 0xff00ff00;

/// Samples per pixel, the inverse depth, the number of the mirror that it is, and PatchColumn::settled.
struct Wall {
  double density = 1;
  float inverseDepth = 0.25f;
  std::uint32_t mirror = 0;
  bool settled = false;
};

/// One cover of a frame: a wall that fills it.
class WallCover {
 public:
  WallCover(const Wall& wall, std::uint32_t slot, std::uint32_t colour) : patch_(64, 64) {
    patch_.setAll(kTexelParts, colour);
    PatchDraw draw;
    draw.column = patch_.column(8, wall.density, 16);
    draw.column.slot = slot;
    draw.column.depthStart = wall.inverseDepth;
    draw.column.mirror = wall.mirror;
    draw.column.settled = wall.settled;
    const std::vector<glm::dvec3> corners{
        {0, 0, 1}, {kFrameWidth, 0, 1}, {kFrameWidth, kFrameHeight, 1}, {0, kFrameHeight, 1}};
    EXPECT_TRUE(draw.polygon.set(corners, kFrameWidth, kFrameHeight));
    strip_.patches.push_back(draw);
    strip_.x0 = 0, strip_.x1 = kFrameWidth;
  }
  const StripDraw& strip() const { return strip_; }

 private:
  test::FlatPatch patch_;
  StripDraw strip_;
};

/// The slot and the inverse depth that all pixels of the frame agree on.
struct Shown {
  std::uint32_t slot = 0;
  float inverseDepth = 0;
};
Shown shownOf(const Wall& first, const Wall& second) {
  const WallCover front(first, kFirstSlot, kOfFirst), behind(second, kSecondSlot, kOfSecond);
  PatchPlan plan;
  plan.surfaces = {front.strip()}, plan.behind = {behind.strip()};
  plan.frontSlot = kFirstSlot;
  if (second.mirror != 0) plan.reflections.emplace_back();
  std::optional<Shown> shown;
  for (const Kernels& kernels : supportedKernels()) {
    Canvas canvas;
    canvas.width = kFrameWidth, canvas.height = kFrameHeight;
    canvas.pixels.assign(std::size_t(kFrameWidth) * kFrameHeight, kEmptyPixel);
    PatchCanvas memory;
    memory.mirror = {1};  // of a smaller frame before, which had a mirror
    paintPatches(plan, *kernels.patches, nullptr, {}, 0, kFrameWidth, memory, canvas);
    for (const CanvasPixel pixel : canvas.pixels) {
      if (!shown) shown = {slotOf(pixel), inverseZDepthOf(pixel)};
      EXPECT_EQ(slotOf(pixel), shown->slot);
      EXPECT_EQ(inverseZDepthOf(pixel), shown->inverseDepth);
      const std::uint32_t colour = slotOf(pixel) == kFirstSlot ? kOfFirst : kOfSecond;
      EXPECT_EQ(std::uint32_t(pixel) & 0xffffffu, colour & 0xffffffu);
    }
  }
  return shown.value_or(Shown());
}

TEST(PatchPainter, ShowsTheSecondCoverWhereTheFirstIsThinAndTheSecondDenser) {
  EXPECT_EQ(shownOf({0.3}, {0.6}).slot, kSecondSlot);
  EXPECT_EQ(shownOf({0.3}, {0.4}).slot, kSecondSlot);
  EXPECT_EQ(shownOf({0.3}, {0.33}).slot, kFirstSlot) << "hardly denser";
  EXPECT_EQ(shownOf({0.6}, {0.3}).slot, kFirstSlot) << "thinner";
  EXPECT_EQ(shownOf({0.9}, {2}).slot, kFirstSlot) << "the first is dense enough";
  EXPECT_EQ(shownOf({0.3, 0.25f, 0, true}, {0.6}).slot, kFirstSlot) << "not worth a look";
}

TEST(PatchPainter, ShowsTheSecondCoverOfTheSameSurfaceAlone) {
  EXPECT_EQ(shownOf({0.3, 0.25f}, {0.6, 0.27f}).slot, kFirstSlot) << "something before it";
  EXPECT_EQ(shownOf({0.3, 0.25f}, {0.6, 0.23f}).slot, kFirstSlot) << "something behind it";
  EXPECT_EQ(shownOf({0.3}, {0.6, 0.25f, 1}).slot, kFirstSlot) << "a mirror";
  // The nearer of both, as with a depth test.
  EXPECT_EQ(shownOf({0.3, 0.25f}, {0.6, 0.252f}).inverseDepth, 0.252f);
  EXPECT_EQ(shownOf({0.3, 0.25f}, {0.6, 0.248f}).inverseDepth, 0.25f);
}

}  // namespace
}  // namespace acentric
