#include "engine/measure/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace acentric {
namespace {

ColourImage randomImage(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  ColourImage image(width, height);
  for (Rgba8& pixel : image.pixels) pixel = Rgba8(random() & 255, random() & 255, random() & 255, 255);
  return image;
}

ColourImage smoothImage(int width, int height) {
  ColourImage image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.at(x, y) =
          Rgba8(128 + 60 * std::sin(0.3 * x), 128 + 50 * std::cos(0.2 * y), (3 * x + 2 * y) % 256, 255);
  return image;
}

ColourImage withNoise(ColourImage image, int amplitude, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> noise(-amplitude, amplitude);
  for (Rgba8& pixel : image.pixels)
    for (int channel = 0; channel < 3; ++channel)
      pixel[channel] = static_cast<std::uint8_t>(std::clamp(pixel[channel] + noise(random), 0, 255));
  return image;
}

double luma(const Rgba8& p) { return 0.299 * p.r + 0.587 * p.g + 0.114 * p.b; }

/// Wang et al. 2004, equation 13, window by window with a two-dimensional Gaussian and centred moments.
double slowSsim(const ColourImage& a, const ColourImage& b) {
  constexpr int n = 11;
  double total = 0, norm = 0;
  int windows = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) norm += std::exp(-((i - 5) * (i - 5) + (j - 5) * (j - 5)) / (2 * 1.5 * 1.5));
  for (int y = 0; y + n <= a.height; ++y)
    for (int x = 0; x + n <= a.width; ++x, ++windows) {
      const auto mean = [&](auto&& value) {
        double sum = 0;
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < n; ++i)
            sum += std::exp(-((i - 5) * (i - 5) + (j - 5) * (j - 5)) / (2 * 1.5 * 1.5)) / norm *
                   value(luma(a.at(x + i, y + j)), luma(b.at(x + i, y + j)));
        return sum;
      };
      const double ma = mean([](double p, double) { return p; }),
                   mb = mean([](double, double q) { return q; });
      const double va = mean([&](double p, double) { return (p - ma) * (p - ma); });
      const double vb = mean([&](double, double q) { return (q - mb) * (q - mb); });
      const double cov = mean([&](double p, double q) { return (p - ma) * (q - mb); });
      constexpr double c1 = 2.55 * 2.55, c2 = 7.65 * 7.65;
      total += (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
    }
  return total / windows;
}

TEST(Psnr, OfAConstantOffsetIsKnown) {
  const ColourImage black(30, 20, Rgba8(0, 0, 0, 255));
  for (const int offset : {1, 5, 20, 255}) {
    const ColourImage grey(30, 20, Rgba8(offset, offset, offset, 0));
    EXPECT_NEAR(psnrOf(black, grey), 20 * std::log10(255.0 / offset), 1e-12);
  }
  const ColourImage red(30, 20, Rgba8(10, 0, 0, 255));
  EXPECT_NEAR(psnrOf(black, red), 10 * std::log10(255.0 * 255.0 * 3 / 100), 1e-12)
      << "one channel of three differs";
}

TEST(Psnr, OfIdenticalPicturesIs99) {
  const ColourImage image = randomImage(9, 9, 1);
  EXPECT_EQ(psnrOf(image, image), 99);
  ColourImage clear = image;
  for (Rgba8& pixel : clear.pixels) pixel.a = 7;
  EXPECT_EQ(psnrOf(image, clear), 99) << "alpha is not looked at";
}

TEST(Ssim, OfAPictureWithItselfIsOne) {
  EXPECT_NEAR(ssimOf(randomImage(40, 30, 2), randomImage(40, 30, 2)), 1, 1e-12);
  EXPECT_NEAR(ssimOf(ColourImage(20, 20), ColourImage(20, 20)), 1, 1e-12);
}

TEST(Ssim, AgreesWithTheDirectFormula) {
  const ColourImage smooth = smoothImage(37, 29);
  for (const ColourImage& other :
       {withNoise(smooth, 30, 3), randomImage(37, 29, 4), ColourImage(37, 29, Rgba8(128))})
    EXPECT_NEAR(ssimOf(smooth, other), slowSsim(smooth, other), 1e-9);
  EXPECT_NEAR(ssimOf(randomImage(11, 11, 5), randomImage(11, 11, 6)),
              slowSsim(randomImage(11, 11, 5), randomImage(11, 11, 6)), 1e-9);
}

TEST(Ssim, OfFlatPicturesIsTheLuminanceTermAlone) {
  const ColourImage a(16, 16, Rgba8(100, 100, 100, 255)), b(16, 16, Rgba8(150, 150, 150, 255));
  constexpr double c1 = 2.55 * 2.55;
  EXPECT_NEAR(ssimOf(a, b), (2 * 100 * 150 + c1) / (100 * 100 + 150 * 150 + c1), 1e-9);
}

TEST(Ssim, FallsWithNoiseAndIsSymmetric) {
  const ColourImage image = smoothImage(64, 48);
  double last = 1;
  for (const int amplitude : {4, 16, 48, 120}) {
    const ColourImage noisy = withNoise(image, amplitude, 7);
    const double similarity = ssimOf(image, noisy);
    EXPECT_LT(similarity, last);
    EXPECT_NEAR(similarity, ssimOf(noisy, image), 1e-12);
    last = similarity;
  }
}

TEST(Ssim, WorksOnPicturesSmallerThanItsWindow) {
  EXPECT_NEAR(ssimOf(randomImage(3, 5, 8), randomImage(3, 5, 8)), 1, 1e-12);
  const double similarity = ssimOf(randomImage(4, 30, 9), randomImage(4, 30, 10));
  EXPECT_GT(similarity, -1);
  EXPECT_LT(similarity, 0.9);
}

Frame frameOf(const ColourImage& colour, PixelSource source) {
  Frame frame;
  frame.colour = colour;
  frame.source = Image<PixelSource>(colour.width, colour.height, source);
  return frame;
}

TEST(Compare, CountsHolesWhereTheTruthHasASurface) {
  const ColourImage truth = randomImage(10, 10, 11);
  FloatImage distance(10, 10, 3.0f);
  Frame frame = frameOf(truth, 1);
  frame.source.at(0, 0) = kSourceHole;      // a surface there: counts
  frame.source.at(1, 0) = kSourceInvented;  // counts: invented is not covered
  frame.source.at(2, 0) = kSourceLocal;     // covered
  frame.source.at(3, 0) = kSourceHole;
  distance.at(3, 0) = std::numeric_limits<float>::infinity();  // sky: no hole
  const auto comparison = compare(frame, truth, distance);
  ASSERT_TRUE(comparison);
  EXPECT_DOUBLE_EQ(comparison->holeShare, 0.02);
  EXPECT_EQ(comparison->psnr, 99);
  EXPECT_NEAR(comparison->ssim, 1, 1e-12);
}

TEST(Compare, RefusesPicturesOfDifferentSize) {
  const Frame frame = frameOf(ColourImage(10, 10), 1);
  EXPECT_FALSE(compare(frame, ColourImage(10, 11), FloatImage(10, 11)));
  EXPECT_FALSE(compare(frame, ColourImage(10, 10), FloatImage(5, 10)));
  EXPECT_FALSE(compare(frameOf({}, 1), {}, {}));
  Frame broken = frame;
  broken.source = Image<PixelSource>(3, 3);
  const auto refused = compare(broken, ColourImage(10, 10), FloatImage(10, 10));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::invalidArgument);
}

TEST(DifferenceImage, AmplifiesAndSaturates) {
  const ColourImage a(1, 1, Rgba8(10, 200, 0, 0)), b(1, 1, Rgba8(12, 100, 0, 9));
  EXPECT_EQ(differenceImage(a, b).pixels[0], Rgba8(8, 255, 0, 255));
  EXPECT_EQ(differenceImage(b, a, 1).pixels[0], Rgba8(2, 100, 0, 255));
}

TEST(ContactSheet, LaysPicturesInAGrid) {
  const Rgba8 red(255, 0, 0, 255), blue(0, 0, 255, 255), green(0, 255, 0, 255);
  const ColourImage sheet =
      contactSheet({ColourImage(4, 3, red), ColourImage(2, 3, blue), ColourImage(4, 1, green)}, 2, 5);
  EXPECT_EQ(sheet.width, 13);
  EXPECT_EQ(sheet.height, 11);
  EXPECT_EQ(sheet.at(3, 2), red);
  EXPECT_EQ(sheet.at(9, 0), blue);
  EXPECT_EQ(sheet.at(0, 8), green);
  for (const auto& [x, y] : {std::pair{4, 0}, {11, 0}, {0, 3}, {0, 9}, {12, 10}}) {
    EXPECT_EQ(sheet.at(x, y).a, 255);
    EXPECT_EQ(sheet.at(x, y).r, sheet.at(x, y).b) << "background";
  }
  EXPECT_EQ(contactSheet({ColourImage(4, 3, red)}, 8, 2).width, 4);
  EXPECT_TRUE(contactSheet({}, 3).empty());
}

}  // namespace
}  // namespace acentric
