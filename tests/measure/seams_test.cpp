#include "engine/measure/seams.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace acentric {
namespace {

constexpr int kSeamWidth = 40, kSeamHeight = 20, kSeam = 15;
constexpr PixelSource kSeamCamera = 3;

/// A floor with a gradient, local geometry left of kSeam, exactly as the truth.
struct Seam {
  Frame frame;
  ColourImage truth{kSeamWidth, kSeamHeight};
  FloatImage distance{kSeamWidth, kSeamHeight};
  Seam() {
    frame.source = Image<PixelSource>(kSeamWidth, kSeamHeight, kSeamCamera);
    for (int y = 0; y < kSeamHeight; ++y)
      for (int x = 0; x < kSeamWidth; ++x) {
        truth.at(x, y) = Rgba8(100 + x, 80 + 2 * y, 90, 255);
        distance.at(x, y) = 40.0f / float(10 + y);  // a floor: inverse distances grow evenly
        if (x < kSeam) frame.source.at(x, y) = kSourceLocal;
      }
    frame.colour = truth;
  }
  SeamSums measure() const { return measureSeam(frame, truth, distance); }
};

TEST(Seam, CannotBeSeenWhereThePictureIsTheTruth) {
  const SeamSums sums = Seam().measure();
  EXPECT_EQ(sums.across.pairs, std::size_t(kSeamHeight));
  EXPECT_EQ(sums.across.meanExcess(), 0);
  EXPECT_EQ(sums.localError(), 0);
  EXPECT_EQ(sums.capturedError(), 0);
  EXPECT_EQ(sums.silhouettes, 0u);
  EXPECT_EQ(sums.within.pairs, std::size_t(kSeamHeight * (kSeamWidth - 2) + kSeamWidth * (kSeamHeight - 1)));
}

TEST(Seam, ShowsAMisshadedSide) {
  Seam seam;
  for (int y = 0; y < kSeamHeight; ++y)
    for (int x = 0; x < kSeam; ++x) seam.frame.colour.at(x, y) -= Rgba8(20, 20, 20, 0);
  const SeamSums sums = seam.measure();
  EXPECT_NEAR(sums.localError(), 20, 1e-6);
  EXPECT_EQ(sums.capturedError(), 0);
  // Red rises by one code across the border in the truth, by 21 in the picture.
  const double expected = std::sqrt((21.0 * 21 + 20 * 20 + 20 * 20) / 3) - std::sqrt(1.0 / 3);
  EXPECT_NEAR(sums.across.meanExcess(), expected, 1e-6);
  EXPECT_EQ(sums.across.visibleShare(), 1);
  EXPECT_EQ(sums.within.visible, 0u) << "away from the border it shades as evenly as the truth";
}

TEST(Seam, CountsNoErrorThatBothSidesShare) {
  Seam seam;
  for (Rgba8& pixel : seam.frame.colour.pixels) pixel += Rgba8(30, 30, 30, 0);
  const SeamSums sums = seam.measure();
  EXPECT_NEAR(sums.localError(), 30, 1e-6);
  EXPECT_NEAR(sums.capturedError(), 30, 1e-6);
  EXPECT_EQ(sums.across.meanExcess(), 0) << "wrong, but no seam";
}

TEST(Seam, LeavesOutSilhouettesSkyAndHoles) {
  Seam seam;
  // A nearer thing begins at the border in the upper half; the lower half is sky beyond it, but for a hole.
  for (int y = 0; y < kSeamHeight; ++y)
    for (int x = 0; x < kSeamWidth; ++x) {
      if (y < kSeamHeight / 2 && x < kSeam) seam.distance.at(x, y) *= 0.5f;
      if (y >= kSeamHeight / 2 && x >= kSeam) seam.distance.at(x, y) = std::numeric_limits<float>::infinity();
    }
  SeamSums sums = seam.measure();
  EXPECT_EQ(sums.across.pairs, 0u);
  EXPECT_EQ(sums.silhouettes, std::size_t(kSeamHeight / 2));

  Seam open;
  for (int y = 0; y < kSeamHeight; ++y)
    open.frame.source.at(kSeam, y) = y % 2 == 0 ? kSourceHole : kSourceInvented;
  sums = open.measure();
  EXPECT_EQ(sums.across.pairs, 0u);
  EXPECT_EQ(sums.silhouettes, 0u);
}

TEST(Seam, SumsOverFrames) {
  Seam good, bad;
  for (int y = 0; y < kSeamHeight; ++y) bad.frame.colour.at(kSeam, y) += Rgba8(40, 40, 40, 0);
  SeamSums both = good.measure();
  both += bad.measure();
  EXPECT_EQ(both.across.pairs, std::size_t(2 * kSeamHeight));
  EXPECT_DOUBLE_EQ(both.across.visibleShare(), 0.5);
  EXPECT_NEAR(both.capturedError(), 40 / std::sqrt(2.0), 1e-6);
}

TEST(Change, IsNoneBetweenEqualPictures) {
  const Seam seam;
  const Change none = changeBetween(seam.truth, seam.truth);
  EXPECT_EQ(none.psnr, 99);
  EXPECT_NEAR(none.ssim, 1, 1e-12);
  EXPECT_EQ(none.changedShare, 0);
}

TEST(Change, CountsPixelsThatJump) {
  const Seam seam;
  ColourImage after = seam.truth;
  for (int x = 0; x < kSeamWidth; ++x)
    after.at(x, 3) += Rgba8(9, 9, 9, 0), after.at(x, 4) += Rgba8(7, 7, 7, 0);
  const Change change = changeBetween(seam.truth, after);
  EXPECT_DOUBLE_EQ(change.changedShare, 1.0 / kSeamHeight);
  EXPECT_NEAR(change.psnr, 10 * std::log10(255 * 255 / ((81 + 49) / double(kSeamHeight))), 1e-9);
}

}  // namespace
}  // namespace acentric
