#include "engine/measure/attribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "engine/measure/compare.h"

namespace acentric {
namespace {

constexpr int kWidth = 40, kHeight = 24, kBorder = 12, kSky = 6, kThing = 30;
constexpr PixelSource kCamera = 3;

/// Sky above, a floor below it with local polygons at the left and a nearer thing at the right; a metal plate
/// and a hole in it.
struct Scene {
  Frame frame;
  ColourImage truth{kWidth, kHeight};
  FloatImage distance{kWidth, kHeight};
  Image<std::uint8_t> viewDependent{kWidth, kHeight};
  Scene() {
    frame.source = Image<PixelSource>(kWidth, kHeight, kCamera);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        truth.at(x, y) = Rgba8(100 + x, 80 + 2 * y, 90, 255);
        distance.at(x, y) = y < kSky      ? std::numeric_limits<float>::infinity()
                            : x >= kThing ? 0.5f
                                          : 40.0f / float(10 + y);
        if (x < kBorder && y >= kSky) frame.source.at(x, y) = kSourceLocal;
      }
    viewDependent.at(20, 15) = 1;
    frame.source.at(22, 15) = kSourceInvented;
    frame.colour = truth;
  }
  /// Makes one pixel wrong by 10 codes in each colour; what is told of it.
  ErrorSource sourceOf(int x, int y) const {
    Frame wrong = frame;
    wrong.colour.at(x, y) += Rgba8(10, 10, 10, 0);
    const Attribution told = attribute(wrong, truth, distance, viewDependent);
    for (std::size_t s = 0; s < kErrorSources; ++s)
      if (told.parts[s].squares > 0) {
        EXPECT_DOUBLE_EQ(told.parts[s].squares, 300);
        EXPECT_DOUBLE_EQ(told.share(ErrorSource(s)), 1);
        EXPECT_DOUBLE_EQ(told.psnrWithout(ErrorSource(s)), 99);
        return ErrorSource(s);
      }
    ADD_FAILURE() << "no error was found";
    return {};
  }
};

TEST(Attribution, LaysEachPixelToItsSource) {
  const Scene scene;
  EXPECT_EQ(scene.sourceOf(22, 15), ErrorSource::holes);
  EXPECT_EQ(scene.sourceOf(kThing, 15), ErrorSource::silhouettes);
  EXPECT_EQ(scene.sourceOf(kThing - 1, 15), ErrorSource::silhouettes);
  EXPECT_EQ(scene.sourceOf(5, kSky), ErrorSource::silhouettes) << "the horizon";
  EXPECT_EQ(scene.sourceOf(kBorder, 15), ErrorSource::seams);
  EXPECT_EQ(scene.sourceOf(kBorder - 1, 15), ErrorSource::seams);
  EXPECT_EQ(scene.sourceOf(20, 15), ErrorSource::viewDependent);
  EXPECT_EQ(scene.sourceOf(4, 15), ErrorSource::polygons);
  EXPECT_EQ(scene.sourceOf(4, 2), ErrorSource::background);
  EXPECT_EQ(scene.sourceOf(17, 15), ErrorSource::resampling);
}

TEST(Attribution, AddsUpToTheComparison) {
  Scene scene;
  std::mt19937 random(3);
  for (Rgba8& pixel : scene.frame.colour.pixels) pixel.g = std::uint8_t(random() % 200);
  Attribution all = attribute(scene.frame, scene.truth, scene.distance, scene.viewDependent);
  EXPECT_EQ(all.pixels(), scene.truth.pixels.size());
  EXPECT_NEAR(all.psnr(), psnrOf(scene.frame.colour, scene.truth), 1e-9);
  double shares = 0;
  for (std::size_t s = 0; s < kErrorSources; ++s) {
    shares += all.share(ErrorSource(s));
    EXPECT_GE(all.psnrWithout(ErrorSource(s)), all.psnr());
  }
  EXPECT_NEAR(shares, 1, 1e-12);
  all += all;
  EXPECT_NEAR(all.psnr(), psnrOf(scene.frame.colour, scene.truth), 1e-9) << "of two equal frames";
}

TEST(AtSampleRate, KeepsWhatCoarseSamplesCanTell) {
  ColourImage even(24, 12, Rgba8(10, 200, 90, 255));
  EXPECT_EQ(atSampleRate(even, 2.6).pixels, even.pixels);
  const Scene scene;
  EXPECT_EQ(atSampleRate(scene.truth, 1).pixels, scene.truth.pixels) << "a sample for each pixel";
  // A slope survives but for its ends, where there is no sample beyond the last one.
  const ColourImage slope = atSampleRate(scene.truth, 2);
  for (int y = 2; y < kHeight - 2; ++y)
    for (int x = 2; x < kWidth - 2; ++x) {
      EXPECT_NEAR(slope.at(x, y).r, scene.truth.at(x, y).r, 1);
      EXPECT_NEAR(slope.at(x, y).g, scene.truth.at(x, y).g, 1);
    }
}

TEST(AtSampleRate, AveragesWhatIsFiner) {
  ColourImage stripes(30, 30);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 30; ++x)
      stripes.at(x, y) = x % 2 == 0 ? Rgba8(0, 0, 0, 255) : Rgba8(200, 100, 50, 255);
  const ColourImage grey = atSampleRate(stripes, 2);
  for (const Rgba8& pixel : grey.pixels) EXPECT_EQ(pixel, Rgba8(100, 50, 25, 255));
  EXPECT_LT(psnrOf(atSampleRate(stripes, 3), stripes), 12);
}

}  // namespace
}  // namespace acentric
