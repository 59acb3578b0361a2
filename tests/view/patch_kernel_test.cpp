#include "engine/view/patch_kernel.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "engine/view/display_patches.h"
#include "engine/view/kernels.h"

namespace acentric {
namespace {

constexpr int kRows = 64;  ///< of the canvas

/// A column of the picture with everything that kernels write.
struct CanvasColumn {
  std::vector<std::uint32_t> open, source, mirror;
  std::vector<float> red, green, blue, clear, inverseZDepth;

  CanvasColumn()
      : open(kRows + kPatchRoom, kAllParts),
        source(open.size()),
        mirror(open.size()),
        red(open.size()),
        green(open.size()),
        blue(open.size()),
        clear(open.size(), 1),
        inverseZDepth(open.size()) {}
  PatchCanvasColumn view() {
    return {open.data(),  red.data(),           green.data(),  blue.data(),
            clear.data(), inverseZDepth.data(), source.data(), mirror.data()};
  }
  bool operator==(const CanvasColumn&) const = default;
};

/// A patch of columns x rows samples, one pixel of the picture each at `scale` 1, seen from where the capture
/// was taken: the picture's row y shows the patch's row y * scale + shift, at its column `column`.
class FlatPatch {
 public:
  FlatPatch(int columns, int rows) : columns_(columns), rows_(rows) {
    const auto texels = std::size_t(columns + 2) * std::size_t(rows + 2);
    cover_.assign(texels, 0);
    colour_.assign(texels, 0xff000000u | 64u | 64u << 8 | 64u << 16);
  }
  void set(int column, int row, std::uint32_t parts, std::uint32_t colour, std::uint32_t roles = 1) {
    const auto at = std::size_t(column + 1) * std::size_t(rows_ + 2) + std::size_t(row + 1);
    cover_[at] = parts | roles << kTexelRoles;
    colour_[at] = colour;
  }
  void setAll(std::uint32_t parts, std::uint32_t colour) {
    std::fill(colour_.begin(), colour_.end(), colour);  // of the border too
    for (int i = 0; i < columns_; ++i)
      for (int j = 0; j < rows_; ++j) set(i, j, parts, colour);
  }
  PatchColumn column(double column, double scale, double shift) const {
    constexpr double kPitch = 0.001;  // radians: all is near the axis
    PatchColumn out{};
    out.start[0] = 1, out.start[1] = float(std::tan((column - 0.5 * columns_) * kPitch));
    out.start[2] = float(-((0.5 * scale + shift) - 0.5 * rows_) * kPitch);  // pixels' centres
    out.step[2] = float(-scale * kPitch);
    out.across[1] = float(scale * kPitch);
    out.depthStart = 0.25f;
    out.columnsPerRadian = out.rowsPerRadian = float(1 / kPitch);
    out.columnOffset = 0.5f * float(columns_), out.rowOffset = 0.5f * float(rows_);
    out.columns = columns_, out.rows = rows_;
    out.cover = cover_.data(), out.colour = colour_.data();
    out.wantedRoles = 1u << kTexelRoles;
    out.slot = 7;
    return out;
  }

 private:
  int columns_, rows_;
  std::vector<std::uint32_t> cover_, colour_;
};

TEST(PatchKernel, CoversTheSharesOfPixelsThatAnEdgeLeaves) {
  FlatPatch patch(4, 32);
  patch.setAll(kTexelParts, 0xffffffff);
  CanvasColumn canvas;
  // The patch begins at row 10.25 of the picture and ends at row 42.25.
  const PatchColumn column = patch.column(2, 1, -10.25);
  const int painted = paintPatchColumnScalar(column, 0, kRows, canvas.view());
  EXPECT_EQ(painted, 33);
  for (int y = 0; y < kRows; ++y) {
    const double share = std::clamp(y + 1 - 10.25, 0.0, 1.0) - std::clamp(y + 1 - 42.25, 0.0, 1.0);
    const int covered = kPixelParts - std::popcount(canvas.open[std::size_t(y)]);
    EXPECT_NEAR(covered, share * kPixelParts, 1) << y;
    EXPECT_NEAR(canvas.red[std::size_t(y)], 255.0f * 255 * float(covered), 1) << y;
    if (covered == kPixelParts) {
      EXPECT_EQ(canvas.source[std::size_t(y)], 7u << 8 | kPixelParts) << y;
      EXPECT_EQ(canvas.inverseZDepth[std::size_t(y)], 0.25f) << y;
    }
  }
}

TEST(PatchKernel, PaintsWhatIsStillOpenAndNothingElse) {
  FlatPatch patch(4, 32);
  patch.setAll(kTexelParts, 0xffffffff);
  CanvasColumn canvas;
  canvas.open[20] = 0;
  canvas.open[21] = 0x0f;
  paintPatchColumnScalar(patch.column(2, 1, -10), 0, kRows, canvas.view());
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
  paintPatchColumnScalar(patch.column(2, 0.25, 0), 0, kRows, canvas.view());
  for (int y = 4; y < kRows - 4; ++y) {
    const double code = 8 * ((y + 0.5) * 0.25 - 0.5);
    EXPECT_NEAR(std::sqrt(canvas.red[std::size_t(y)] / kPixelParts), code, 0.05) << y;
  }
}

TEST(PatchKernel, LeavesOutSamplesOfOtherRoles) {
  FlatPatch patch(4, 32);
  patch.setAll(kTexelParts, 0xffffffff);
  for (int i = 0; i < 4; ++i) patch.set(i, 12, kTexelParts, 0xffffffff, 2);
  CanvasColumn canvas;
  paintPatchColumnScalar(patch.column(2, 1, 0), 0, kRows, canvas.view());
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
  paintPatchColumnScalar(pane, 0, kRows, canvas.view());
  EXPECT_EQ(canvas.open[10], kAllParts);
  EXPECT_EQ(canvas.source[10], 0u);
  paintPatchColumnScalar(wall.column(2, 1, 0), 0, kRows, canvas.view());
  EXPECT_NEAR(canvas.red[10], 255.0 * 255 * 8 * (1 - 128 / 255.0), 10);
}

TEST(PatchKernel, AMirrorWaitsForWhatItShows) {
  FlatPatch mirror(4, 32), image(4, 32);
  mirror.setAll(kTexelParts, 0xffffffff);
  image.setAll(kTexelParts, 0xff0000ff);
  CanvasColumn canvas;
  PatchColumn surface = mirror.column(2, 1, 0);
  surface.mirror = 3;
  paintPatchColumnScalar(surface, 0, kRows, canvas.view());
  EXPECT_EQ(canvas.mirror[10], 3u << 16 | kAllParts);
  EXPECT_EQ(canvas.red[10], 0);
  PatchColumn shown = image.column(2, 1, -16);
  shown.mirror = 3, shown.reflects = true;
  paintPatchColumnScalar(shown, 0, kRows, canvas.view());
  EXPECT_EQ(canvas.mirror[10], 3u << 16 | kAllParts);  // not there
  EXPECT_EQ(canvas.mirror[20], 3u << 16);
  EXPECT_EQ(canvas.red[20], 255.0f * 255 * 8);
  EXPECT_EQ(canvas.green[20], 0);
  surface.reflects = true;  // its own colour where nothing is known of what it shows
  paintPatchColumnScalar(surface, 0, kRows, canvas.view());
  EXPECT_EQ(canvas.green[10], 255.0f * 255 * 8);
  EXPECT_EQ(canvas.green[20], 0);
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
    PatchColumn column =
        patch.column(between(-2, float(size.columns) + 2), between(0.1f, 3), between(-20, 20));
    column.step[1] = between(-0.001f, 0.001f), column.depthStep = between(-0.01f, 0.01f);
    column.blended = random() % 4 == 0;
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
    const int painted = supportedKernels().front().paintPatchColumn(column, first, end, expected.view());
    for (const Kernels& kernels : supportedKernels().subspan(1)) {
      CanvasColumn canvas = before;
      ASSERT_EQ(kernels.paintPatchColumn(column, first, end, canvas.view()), painted) << kernels.name;
      ASSERT_EQ(canvas, expected) << kernels.name << ", trial " << trial;
    }
  }
}

}  // namespace
}  // namespace acentric
