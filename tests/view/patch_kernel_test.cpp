#include "engine/view/patch_kernel.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <random>

#include "engine/view/canvas.h"
#include "engine/view/display_patches.h"
#include "engine/view/kernels.h"
#include "engine/view/patch_plan.h"
#include "flat_patch.h"

namespace acentric {
namespace {

using test::FlatPatch;

constexpr int kRows = 64;  ///< of the canvas

/// A column of the picture with everything that kernels write.
struct CanvasColumn {
  int rows = kRows;
  std::vector<std::uint32_t> open, source, mirror;
  std::vector<float> red, green, blue, clear, inverseZDepth;
  std::uint64_t cells = ~std::uint64_t(0), reached = ~std::uint64_t(0);

  explicit CanvasColumn(int count = kRows)
      : rows(count),
        open(std::size_t(count) + kPatchRoom, kAllParts),
        source(open.size()),
        mirror(open.size()),
        red(open.size()),
        green(open.size()),
        blue(open.size()),
        clear(open.size(), 1),
        inverseZDepth(open.size()) {}
  PatchCanvasColumn view() {
    return {rows,         open.data(),          red.data(),    green.data(),  blue.data(),
            clear.data(), inverseZDepth.data(), source.data(), mirror.data(), &cells,
            &reached,     cellShiftOf(rows)};
  }
  bool showsTheSame(const CanvasColumn& other) const {
    return open == other.open && source == other.source && mirror == other.mirror && red == other.red &&
           green == other.green && blue == other.blue && clear == other.clear &&
           inverseZDepth == other.inverseZDepth;
  }
  /// Those that must be set.
  std::uint64_t cellsThatAreOpen(bool reflections) const {
    std::uint64_t found = 0;
    for (int y = 0; y < rows; ++y) {
      const std::uint32_t word = (reflections ? mirror : open)[std::size_t(y)];
      if ((word & kAllParts) != 0) found |= std::uint64_t(1) << (y >> cellShiftOf(rows));
    }
    return found;
  }
};

int paintPatch(const PatchColumn& patch, int first, int end, const PatchCanvasColumn& canvas) {
  return kPatchKernelScalar.paint(patch, first, end, canvas);
}

TEST(PatchKernel, CoversTheSharesOfPixelsThatAnEdgeLeaves) {
  FlatPatch patch(4, 32);
  patch.setAll(kTexelParts, 0xffffffff);
  CanvasColumn canvas;
  // The patch begins at row 10.25 of the picture and ends at row 42.25.
  const PatchColumn column = patch.column(2, 1, -10.25);
  const int painted = paintPatch(column, 0, kRows, canvas.view());
  EXPECT_EQ(painted, 33);
  for (int y = 0; y < kRows; ++y) {
    const double share = std::clamp(y + 1 - 10.25, 0.0, 1.0) - std::clamp(y + 1 - 42.25, 0.0, 1.0);
    const int covered = kPixelParts - std::popcount(canvas.open[std::size_t(y)]);
    EXPECT_NEAR(covered, share * kPixelParts, 1) << y;
    EXPECT_NEAR(canvas.red[std::size_t(y)], 255.0f * 255 * float(covered), 1) << y;
    if (covered == kPixelParts) {
      const std::uint32_t source = canvas.source[std::size_t(y)];
      EXPECT_EQ(source & 0xffffu, 7u << kSourceSlot | kPixelParts) << y;
      EXPECT_NEAR(densityOf(source), std::sqrt(0.5) * kMostDensity, 2) << y;  // a pixel is a sample
      EXPECT_EQ(canvas.inverseZDepth[std::size_t(y)], 0.25f) << y;
    }
  }
}

TEST(PatchKernel, TellsHowDenselyASurfaceIsSampled) {
  FlatPatch patch(8, 32);
  patch.setAll(kTexelParts, 0xffffffff);
  for (const double across : {0.1, 0.25, 0.5, 1.0, 3.0})
    for (const double down : {0.2, 0.5, 0.8}) {
      CanvasColumn canvas;
      PatchColumn column = patch.column(4, down, 0);
      column.across[1] *= float(across / down);
      paintPatch(column, 0, kRows, canvas.view());
      const double expected = std::min(1 / std::hypot(1 / across, 1 / down), 1.0);
      for (int y = 2; y < 32; ++y)
        EXPECT_NEAR(densityOf(canvas.source[std::size_t(y)]), expected * kMostDensity, 2) << across << down;
    }
}

TEST(PatchKernel, TellsWhatIsSettledAsSampledMostDensely) {
  FlatPatch patch(8, 32);
  patch.setAll(kTexelParts, 0xffffffff);
  for (const Kernels& kernels : supportedKernels()) {
    CanvasColumn canvas;
    PatchColumn column = patch.column(4, 0.25, 0);
    column.settled = true;
    kernels.patches->paint(column, 0, kRows, canvas.view());
    EXPECT_EQ(densityOf(canvas.source[10]), kMostDensity) << kernels.name;
  }
}

TEST(PatchKernel, PaintsWhatIsStillOpenAndNothingElse) {
  FlatPatch patch(4, 32);
  patch.setAll(kTexelParts, 0xffffffff);
  CanvasColumn canvas;
  canvas.open[20] = 0;
  canvas.open[21] = 0x0f;
  paintPatch(patch.column(2, 1, -10), 0, kRows, canvas.view());
  EXPECT_EQ(canvas.red[20], 0);
  EXPECT_EQ(canvas.red[21], 255.0f * 255 * 4);
  EXPECT_EQ(canvas.open[21], 0u);
  EXPECT_EQ(canvas.red[22], 255.0f * 255 * 8);
}

TEST(PatchKernel, InterpolatesBetweenSamples) {
  FlatPatch patch(4, 32);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 32; ++j) patch.set(i, j, kTexelParts, 0xff000000u | std::uint32_t(8 * j));
  CanvasColumn canvas;
  paintPatch(patch.column(2, 0.25, 0), 0, kRows, canvas.view());
  for (int y = 4; y < kRows - 4; ++y) {
    const double code = 8 * ((y + 0.5) * 0.25 - 0.5);
    EXPECT_NEAR(std::sqrt(canvas.red[std::size_t(y)] / kPixelParts), code, 0.05) << y;
  }
}

TEST(PatchKernel, CoversNothingBeyondWhatReachesIntoItsBorder) {
  FlatPatch patch(4, 32);
  patch.setAll(kTexelParts, 0xffffffff);
  for (int i = 0; i < 4; ++i) patch.set(i, -1, 0xf000, 0xffffffff), patch.set(i, 32, 0x000f, 0xffffffff);
  for (const double scale : {1.0, 0.3, 3.0}) {
    CanvasColumn canvas;
    const double shift = -13.4 * scale;
    paintPatch(patch.column(2, scale, shift), 0, kRows, canvas.view());
    for (int y = 0; y < kRows; ++y) {
      const double low = y * scale + shift, high = low + scale;
      const bool inside = low > 0 && high < 32, outside = high < -0.25 || low > 32.25;
      if (inside) {
        EXPECT_EQ(canvas.open[std::size_t(y)], 0u) << y << " " << scale;
      }
      if (outside) {
        EXPECT_EQ(canvas.open[std::size_t(y)], kAllParts) << y << " " << scale;
      }
    }
  }
}

TEST(PatchKernel, LeavesOutSamplesOfOtherRoles) {
  FlatPatch patch(4, 32);
  patch.setAll(kTexelParts, 0xffffffff);
  for (int i = 0; i < 4; ++i) patch.set(i, 12, kTexelParts, 0xffffffff, 2);
  CanvasColumn canvas;
  paintPatch(patch.column(2, 1, 0), 0, kRows, canvas.view());
  EXPECT_EQ(canvas.open[11], 0u);
  EXPECT_EQ(canvas.open[12], kAllParts);
  EXPECT_EQ(canvas.open[13], 0u);
}

TEST(PatchKernel, TintsWhatLiesBehindGlass) {
  FlatPatch glass(4, 32), wall(4, 32);
  glass.setAll(kTexelParts, 0x80000000u);  // black, alpha 128
  wall.setAll(kTexelParts, 0xffffffff);
  CanvasColumn canvas;
  PatchColumn pane = glass.column(2, 1, 0);
  pane.blended = true;
  paintPatch(pane, 0, kRows, canvas.view());
  EXPECT_EQ(canvas.open[10], kAllParts);
  EXPECT_EQ(canvas.source[10], 0u);
  paintPatch(wall.column(2, 1, 0), 0, kRows, canvas.view());
  EXPECT_NEAR(canvas.red[10], 255.0 * 255 * 8 * (1 - 128 / 255.0), 10);
}

TEST(PatchKernel, AMirrorWaitsForWhatItShows) {
  FlatPatch mirror(4, 32), image(4, 32);
  mirror.setAll(kTexelParts, 0xffffffff);
  image.setAll(kTexelParts, 0xff0000ff);
  CanvasColumn canvas;
  PatchColumn surface = mirror.column(2, 1, 0);
  surface.mirror = 3;
  paintPatch(surface, 0, kRows, canvas.view());
  EXPECT_EQ(canvas.mirror[10], 3u << 16 | kAllParts);
  EXPECT_EQ(canvas.red[10], 0);
  PatchColumn shown = image.column(2, 1, -16);
  shown.mirror = 3, shown.reflects = true;
  kPatchKernelScalar.findCells(canvas.view(), true);
  paintPatch(shown, 0, kRows, canvas.view());
  EXPECT_EQ(canvas.mirror[10], 3u << 16 | kAllParts);  // not there
  EXPECT_EQ(canvas.mirror[20], 3u << 16);
  EXPECT_EQ(canvas.red[20], 255.0f * 255 * 8);
  EXPECT_EQ(canvas.green[20], 0);
  surface.reflects = true;  // its own colour where nothing is known of what it shows
  paintPatch(surface, 0, kRows, canvas.view());
  EXPECT_EQ(canvas.green[10], 255.0f * 255 * 8);
  EXPECT_EQ(canvas.green[20], 0);
}

TEST(PatchKernel, GlassInAMirrorTintsWhatTheMirrorShowsBehindIt) {
  FlatPatch mirror(4, 32), pane(4, 32), image(4, 32);
  mirror.setAll(kTexelParts, 0xffffffff);
  pane.setAll(kTexelParts, 0x800000ff);
  image.setAll(kTexelParts, 0xff00ff00);
  CanvasColumn canvas;
  PatchColumn surface = mirror.column(2, 1, 0), glass = pane.column(2, 1, 0), shown = image.column(2, 1, 0);
  surface.mirror = glass.mirror = shown.mirror = 3;
  glass.reflects = shown.reflects = glass.blended = true;
  paintPatch(surface, 0, kRows, canvas.view());
  kPatchKernelScalar.findCells(canvas.view(), true);
  paintPatch(glass, 0, kRows, canvas.view());
  EXPECT_EQ(canvas.mirror[10], 3u << 16 | kAllParts) << "what is behind it is still wanted";
  paintPatch(shown, 0, kRows, canvas.view());
  EXPECT_EQ(canvas.mirror[10], 3u << 16);
  EXPECT_NEAR(canvas.red[10], 255.0 * 255 * 8 * 128 / 255, 10);
  EXPECT_NEAR(canvas.green[10], 255.0 * 255 * 8 * (1 - 128 / 255.0), 10);
}

TEST(PatchKernel, EveryVariantGivesTheSameBits) {
  std::mt19937 random(7);
  const auto between = [&](float low, float high) {
    return low + (high - low) * float(random() & 0xffff) / 65535.0f;
  };
  for (int trial = 0; trial < 400; ++trial) {
    FlatPatch patch(1 + int(random() % 20), 1 + int(random() % 40));
    const PatchColumn size = patch.column(0, 1, 0);
    for (int i = 0; i < size.columns; ++i)
      for (int j = 0; j < size.rows; ++j)
        patch.set(i, j, random() % 3 == 0 ? random() & kTexelParts : kTexelParts, std::uint32_t(random()),
                  1 + random() % 3);
    for (int j = -1; j <= size.rows && random() % 2 == 0; ++j)  // what reaches into the border
      patch.set(random() % 2 == 0 ? -1 : size.columns, j, random() & kTexelParts, std::uint32_t(random()));
    if (random() % 2 == 0) patch.markWhole();
    PatchColumn column =
        patch.column(between(-2, float(size.columns) + 2), between(0.1f, 3), between(-20, 20));
    column.step[1] = between(-0.001f, 0.001f), column.depthStep = between(-0.01f, 0.01f);
    column.blended = random() % 4 == 0;
    column.settled = random() % 4 == 0;
    column.mirror = random() % 3;
    column.reflects = random() % 4 == 0;
    column.limited = random() % 4 == 0, column.eitherSide = random() % 2 == 0;
    column.lowStart = between(-1, 1), column.lowStep = between(-0.1f, 0.1f);
    column.highStart = between(-1, 1), column.highStep = between(-0.1f, 0.1f);
    CanvasColumn before;
    for (int y = 0; y < kRows; ++y) {
      before.open[std::size_t(y)] = random() % 3 == 0 ? random() & kAllParts : kAllParts;
      before.clear[std::size_t(y)] = between(0.2f, 1);
      before.mirror[std::size_t(y)] = random() % 3 == 0 ? (random() % 3) << 16 | (random() & kAllParts) : 0;
    }
    const int first = int(random() % 20), end = first + int(random() % (kRows - 20));
    CanvasColumn expected = before;
    const int painted = paintPatch(column, first, end, expected.view());
    for (const Kernels& kernels : supportedKernels()) {
      CanvasColumn canvas = before;
      kernels.patches->findCells(canvas.view(), column.reflects);
      ASSERT_EQ(canvas.cells, before.cellsThatAreOpen(column.reflects)) << kernels.name;
      ASSERT_EQ(kernels.patches->paint(column, first, end, canvas.view()), painted) << kernels.name;
      ASSERT_TRUE(canvas.showsTheSame(expected)) << kernels.name << ", trial " << trial;
      ASSERT_EQ(canvas.cells | canvas.cellsThatAreOpen(column.reflects), canvas.cells) << kernels.name;
    }
  }
}

TEST(PatchKernel, MarksOfWholeBlocksSaveWorkAndChangeNothing) {
  FlatPatch plain(12, 40);
  plain.setAll(kTexelParts, 0xffffffff);
  for (int j = 10; j < 20; ++j) plain.set(j - 10, j, 0x00ff, 0xffffffff);
  for (int i = 0; i < 12; ++i) plain.set(i, 30, kTexelParts, 0xffffffff, 2);
  FlatPatch marked = plain;
  marked.markWhole();
  EXPECT_GT(marked.countOf(kBlockInner), 60);
  EXPECT_GT(marked.countOf(kBlockWhole), marked.countOf(kBlockInner) + 60);
  for (const Kernels& kernels : supportedKernels())
    for (const double scale : {0.2, 0.6, 0.99, 1.01, 1.7, 2.5})
      for (double column = -0.9; column < 13; column += 0.3) {
        CanvasColumn expected, canvas;
        paintPatch(plain.column(column, scale, -7.3), 0, kRows, expected.view());
        kernels.patches->paint(marked.column(column, scale, -7.3), 0, kRows, canvas.view());
        ASSERT_TRUE(canvas.showsTheSame(expected)) << kernels.name << ", " << scale << ", " << column;
      }
}

TEST(PatchKernel, SettlesOnlyWhatPatchesReached) {
  for (const Kernels& kernels : supportedKernels()) {
    CanvasColumn canvas;
    std::fill(canvas.open.begin(), canvas.open.end(), 0u);
    std::fill(canvas.source.begin(), canvas.source.end(), 7u << 8 | kPixelParts);
    canvas.reached = 0b0100;
    std::vector<CanvasPixel> pixels(kRows, kEmptyPixel);
    kernels.patches->settle(canvas.view(), false, pixels.data());
    for (std::size_t y = 0; y < kRows; ++y)
      EXPECT_EQ(slotOf(pixels[y]), y / 16 == 2 ? 7u : 0u) << kernels.name << ", " << y;
  }
}

TEST(PatchKernel, ClosesTheCellsThatAPatchCovers) {
  FlatPatch patch(4, 100);
  patch.setAll(kTexelParts, 0xffffffff);
  for (const Kernels& kernels : supportedKernels())
    for (const int rows : {720, 1024, 1025, 2160}) {
      CanvasColumn canvas(rows);
      const PatchCanvasColumn view = canvas.view();
      kernels.patches->findCells(view, false);
      ASSERT_EQ(canvas.cells, canvas.cellsThatAreOpen(false)) << rows;
      kernels.patches->paint(patch.column(2, 1, -100), 0, rows, view);
      ASSERT_EQ(canvas.open[99], kAllParts);
      ASSERT_EQ(canvas.open[150], 0u);
      EXPECT_EQ(canvas.cells, canvas.cellsThatAreOpen(false)) << kernels.name << ", " << rows;
    }
}

/// Pixel by pixel, what PatchKernel::settle says.
std::uint64_t settled(const CanvasColumn& canvas, std::size_t y, bool mirrors, std::uint64_t pixel) {
  if ((canvas.mirror[y] != 0) != mirrors) return pixel;
  const int open = std::popcount(canvas.open[y]);
  int painted = kPixelParts - open - std::popcount(canvas.mirror[y] & kAllParts);
  float sums[3] = {canvas.red[y], canvas.green[y], canvas.blue[y]};
  const bool isReal = canvas.source[y] != 0 || (mirrors && painted > 0);
  if (open > 0 && inverseZDepthOf(pixel) >= 0) {
    for (int i = 0; i < 3; ++i) {
      const float code = float(pixel >> (8 * i) & 255);
      sums[i] += code * code * (float(open) * canvas.clear[y]);
    }
    painted += open;
  } else if (!isReal) {
    return pixel;
  }
  if (painted <= 0) return pixel;
  std::uint32_t colour = 0;
  for (int i = 0; i < 3; ++i)
    colour |= std::uint32_t(std::min(std::sqrt(sums[i] / float(painted)) + 0.5f, 255.0f)) << (8 * i);
  const std::uint32_t slot = canvas.source[y] != 0 ? canvas.source[y] >> 8 : std::max(slotOf(pixel), 1u);
  return canvasPixel(colour | slot << 24, canvas.source[y] != 0 ? canvas.inverseZDepth[y] : 0);
}

TEST(PatchKernel, SettlesAndReopensAsPixelByPixel) {
  std::mt19937 random(11);
  constexpr int kCount = 37;  // no multiple of lanes
  constexpr std::uint32_t kFront = 4;
  for (int trial = 0; trial < 100; ++trial) {
    CanvasColumn canvas(kCount);
    std::vector<CanvasPixel> pixels(kCount);
    for (std::size_t y = 0; y < kCount; ++y) {
      const bool hasMirror = random() % 4 == 0, touched = random() % 3 != 0;
      const std::uint32_t covered = touched ? random() & kAllParts : 0;
      canvas.open[y] = random() % 6 == 0 ? 0 : kAllParts & ~covered;
      canvas.source[y] = covered != 0 ? (1 + random() % 9) << 8 | std::uint32_t(std::popcount(covered)) : 0;
      canvas.mirror[y] = hasMirror ? (1 + random() % 3) << 16 | (random() & covered) : 0;
      for (auto* sums : {&canvas.red, &canvas.green, &canvas.blue})
        (*sums)[y] = covered != 0 ? float(random() % (255 * 255 * 8)) : 0;
      canvas.clear[y] = float(random() % 256) / 255;
      canvas.inverseZDepth[y] = float(random() % 1000) / 100;
      const bool isEmpty = random() % 3 == 0;
      pixels[y] = isEmpty ? kEmptyPixel : canvasPixel(std::uint32_t(random()), float(random() % 100) / 10);
    }
    for (const Kernels& kernels : supportedKernels())
      for (const bool mirrors : {false, true}) {
        std::vector<CanvasPixel> drawn = pixels;
        kernels.patches->settle(canvas.view(), mirrors, drawn.data());
        for (std::size_t y = 0; y < kCount; ++y)
          ASSERT_EQ(drawn[y], settled(canvas, y, mirrors, pixels[y])) << kernels.name << ", row " << y;

        CanvasColumn again = canvas;
        kernels.patches->reopen(again.view(), kFront, pixels.data());
        for (std::size_t y = 0; y < kCount; ++y) {
          const bool waits = canvas.mirror[y] != 0;
          const bool wasClosed = canvas.open[y] == 0 && canvas.source[y] == 0;
          const std::uint32_t open = slotOf(pixels[y]) < kFront && !wasClosed ? kAllParts : 0;
          ASSERT_EQ(again.open[y], waits ? canvas.open[y] : open) << kernels.name << ", row " << y;
          ASSERT_EQ(again.source[y], waits ? canvas.source[y] : 0) << kernels.name << ", row " << y;
          if (!waits && open == 0) continue;  // nothing is painted there any more
          ASSERT_EQ(again.green[y], waits ? canvas.green[y] : 0) << kernels.name << ", row " << y;
          ASSERT_EQ(again.clear[y], waits ? canvas.clear[y] : 1) << kernels.name << ", row " << y;
        }
      }
  }
}

TEST(PolygonRows, HoldEveryRowThatThePolygonTouches) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-20, 120);
  std::vector<RowRange> rows;
  int seen = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const glm::dvec2 a(place(random), place(random)), b(place(random), place(random)),
        c(place(random), place(random));
    const std::array<glm::dvec3, 3> corners{{{2.0 * a, 2}, {b, 1}, {3.0 * c, 3}}};
    PolygonRows polygon;
    if (!polygon.set(corners, 100, 80)) continue;
    polygon.rows(polygon.x0(), polygon.x1(), rows);
    std::vector<RowRange> touched(std::size_t(polygon.x1() - polygon.x0()), {80, 0});
    constexpr int kSteps = 300;
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; i + j <= kSteps; ++j) {
        const glm::dvec2 q = a + double(i) / kSteps * (b - a) + double(j) / kSteps * (c - a);
        if (q.x < 0 || q.x >= 100 || q.y < 0 || q.y >= 80) continue;
        ASSERT_GE(int(q.x), polygon.x0());
        ASSERT_LT(int(q.x), polygon.x1());
        RowRange& all = touched[std::size_t(int(q.x) - polygon.x0())];
        all.first = std::min(all.first, int(q.y)), all.end = std::max(all.end, int(q.y) + 1);
      }
    for (std::size_t x = 0; x < rows.size(); ++x)
      if (touched[x].first < touched[x].end) {
        ASSERT_LE(rows[x].first, touched[x].first) << "trial " << trial << ", column " << x;
        ASSERT_GE(rows[x].end, touched[x].end) << "trial " << trial << ", column " << x;
        ++seen;
      }
  }
  EXPECT_GT(seen, 2000);
}

}  // namespace
}  // namespace acentric
