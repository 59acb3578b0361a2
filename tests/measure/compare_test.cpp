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

/// Wang, Simoncelli and Bovik 2003, equation 7, from the definitions: windows by sums over their pixels.
double slowMsSsim(Image<double> a, Image<double> b) {
  const double weights[] = {0.0448, 0.2856, 0.3001, 0.2363, 0.1333};
  const double c1 = 6.5025, c2 = 58.5225;
  double product = 1;
  for (int scale = 0; scale < 5; ++scale) {
    const int across = std::min(11, a.width), down = std::min(11, a.height);
    double whole = 0, structure = 0;
    int windows = 0;
    for (int y = 0; y + down <= a.height; ++y)
      for (int x = 0; x + across <= a.width; ++x, ++windows) {
        double norm = 0, sumA = 0, sumB = 0, squareA = 0, squareB = 0, both = 0;
        for (int j = 0; j < down; ++j)
          for (int i = 0; i < across; ++i) {
            const double u = i - 0.5 * (across - 1), v = j - 0.5 * (down - 1);
            const double w = std::exp(-(u * u + v * v) / 4.5), p = a.at(x + i, y + j), q = b.at(x + i, y + j);
            norm += w, sumA += w * p, sumB += w * q;
            squareA += w * p * p, squareB += w * q * q, both += w * p * q;
          }
        const double ma = sumA / norm, mb = sumB / norm;
        const double va = squareA / norm - ma * ma, vb = squareB / norm - mb * mb,
                     cov = both / norm - ma * mb;
        const double s = (2 * cov + c2) / (va + vb + c2);
        structure += s;
        whole += s * (2 * ma * mb + c1) / (ma * ma + mb * mb + c1);
      }
    product *= std::pow((scale == 4 ? whole : structure) / windows, weights[scale]);
    const auto half = [](const Image<double>& image) {
      Image<double> small((image.width + 1) / 2, (image.height + 1) / 2);
      for (int y = 0; y < small.height; ++y)
        for (int x = 0; x < small.width; ++x)
          for (int k = 0; k < 4; ++k)
            small.at(x, y) += 0.25 * image.at(std::min(2 * x + k % 2, image.width - 1),
                                              std::min(2 * y + k / 2, image.height - 1));
      return small;
    };
    a = half(a), b = half(b);
  }
  return product;
}

TEST(MultiScaleSimilarity, IsTheDefinition) {
  const ColourImage a = smoothImage(97, 64), b = withNoise(a, 40, 5);
  const auto lumaImage = [](const ColourImage& image) {
    Image<double> out(image.width, image.height);
    for (std::size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] = luma(image.pixels[i]);
    return out;
  };
  EXPECT_NEAR(msSsimOf(a, b), slowMsSsim(lumaImage(a), lumaImage(b)), 1e-9);
  EXPECT_LT(msSsimOf(a, b), 0.99);
}

TEST(MultiScaleSimilarity, IsOneForTheSameFallsWithNoiseAndMindsFineNoiseLessThanSsimDoes) {
  const ColourImage a = smoothImage(180, 180);
  EXPECT_NEAR(msSsimOf(a, a), 1, 1e-12);
  const double little = msSsimOf(a, withNoise(a, 10, 1)), much = msSsimOf(a, withNoise(a, 60, 1));
  EXPECT_LT(much, little);
  EXPECT_LT(little, 1);
  EXPECT_GT(much, ssimOf(a, withNoise(a, 60, 1)));
  EXPECT_GE(msSsimOf(randomImage(40, 40, 1), randomImage(40, 40, 2)), 0);
}

/// A wall square to the view, `metres` ahead, as drawn.
struct Wall {
  PerspectiveView view;
  Frame frame;
  FloatImage inverseZDepth, truth;
  Wall(double drawn, double real) {
    view.width = 32, view.height = 18;
    view.yawRadians = 0.7, view.pitchRadians = 0.2;
    frame.source = Image<PixelSource>(32, 18, 1);
    inverseZDepth = FloatImage(32, 18, float(1 / drawn));
    truth = FloatImage(32, 18);
    const glm::dvec3 forward = view.rayThrough(16, 9);
    for (int y = 0; y < 18; ++y)
      for (int x = 0; x < 32; ++x)
        truth.at(x, y) = float(real / glm::dot(forward, view.rayThrough(x + 0.5, y + 0.5)));
  }
  double error() const { return depthErrorOf(frame, inverseZDepth, view, truth); }
};

TEST(DepthError, IsNoneWhereSurfacesAreWhereTheyAre) { EXPECT_NEAR(Wall(3, 3).error(), 0, 1e-6); }

TEST(DepthError, IsTheShareByWhichDistancesDifferEitherWay) {
  EXPECT_NEAR(Wall(2, 4).error(), 0.5, 1e-6);
  EXPECT_NEAR(Wall(4, 2).error(), 0.5, 1e-6);
}

TEST(DepthError, CountsSkyForASurfaceInFullAndSkyForSkyNotAtAll) {
  Wall wall(2, 2);
  wall.truth = FloatImage(32, 18, std::numeric_limits<float>::infinity());
  EXPECT_EQ(wall.error(), 1);
  wall.inverseZDepth = FloatImage(32, 18, 0);
  EXPECT_EQ(wall.error(), 0);
}

TEST(DepthError, LeavesHolesOut) {
  Wall wall(2, 4);
  for (int y = 0; y < 18; ++y) wall.frame.source.at(y, y) = kSourceInvented, wall.inverseZDepth.at(y, y) = -1;
  EXPECT_NEAR(wall.error(), 0.5, 1e-6);
  for (PixelSource& source : wall.frame.source.pixels) source = kSourceHole;
  EXPECT_EQ(wall.error(), 0);
}

}  // namespace
}  // namespace acentric
