#include "engine/view/surface_kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/image/colour.h"
#include "engine/scene/surface_light.h"
#include "engine/scene/texture_lookup.h"
#include "engine/view/canvas.h"
#include "engine/view/kernels.h"

namespace acentric {
namespace {

/// A triangle with a random texture and random light, and a row of its pixels.
class ShadedTriangle {
 public:
  explicit ShadedTriangle(std::mt19937& random) : random_(random) {
    const auto wrap = [&] { return static_cast<Wrap>(random_() % 3); };
    if (flip()) {
      auto image = std::make_shared<ColourImage>(1 + int(random_() % 9), 1 + int(random_() % 9));
      for (Rgba8& texel : image->pixels)
        texel = Rgba8(random_() & 255, random_() & 255, random_() & 255, random_() & 255);
      scene_.images.push_back(image);
      Texture texture;
      texture.image = 0;
      texture.wrapU = wrap(), texture.wrapV = wrap(), texture.nearest = flip();
      scene_.textures.push_back(texture);
      use_.texture = 0;
      shade_.texels = reinterpret_cast<const std::uint32_t*>(image->pixels.data());
      shade_.width = image->width, shade_.height = image->height;
      shade_.wrapU = static_cast<TextureWrap>(texture.wrapU);
      shade_.wrapV = static_cast<TextureWrap>(texture.wrapV);
      shade_.nearest = texture.nearest;
      shade_.linearFromSrgb = linearFromSrgbTable().data();
    }
    lit_ = flip();
    if (lit_) {
      shade_.resolution = int(random_() % 6);  // 0: black
      light_.resize(surfaceSampleCount(std::uint32_t(shade_.resolution)));
      for (HalfColour& sample : light_)
        sample = packColour({between(0, 1) * between(0, 1), between(0, 4), between(0, 1e-5f), 0});
      shade_.light = reinterpret_cast<const std::uint32_t*>(light_.data());
    }
    for (int c = 0; c < 3; ++c) {
      for (int axis = 0; axis < 2; ++axis) {
        shade_.uv[c][axis] = between(-3, 3);
        shade_.barycentric[c][axis] = between(0, 0.6f);
      }
      shade_.colour[c] = between(0, 1);
      shade_.emission[c] = flip() ? 0 : between(0, 2);
    }
    shade_.exposure = between(0.1f, 3);
    const DisplayCodes codes = displayCodes();
    shade_.threshold = codes.threshold, shade_.firstCode = codes.firstCode;
    run_.x0 = int(random_() % 1000);
    run_.count = 1 + int(random_() % 40);
    run_.perDepth = between(0.01f, 10);
    for (int i = 0; i < 3; ++i) {  // positive along the run
      const double first = between(0.01f, 1), last = between(0.01f, 1);
      run_.slope[i] = (last - first) / run_.count;
      run_.start[i] = first - run_.slope[i] * run_.x0;
    }
  }

  SurfaceShade& shade() { return shade_; }

  struct Pixels {
    std::vector<std::uint32_t> colour, depth;  ///< Rgba8 words, float bits
    bool operator==(const Pixels&) const = default;
  };
  static constexpr std::uint32_t kUntouched = 0x12345678;

  Pixels shaded(ShadeRun shadeRun) const {
    const std::size_t count = std::size_t(run_.count) + 20;
    Pixels pixels{std::vector<std::uint32_t>(count, kUntouched), {}};
    std::vector<float> depth(count, std::bit_cast<float>(kUntouched));
    SurfaceRun run = run_;
    run.colour = pixels.colour.data(), run.inverseZDepth = depth.data();
    shadeRun(shade_, run);
    for (const float d : depth) pixels.depth.push_back(std::bit_cast<std::uint32_t>(d));
    return pixels;
  }

  /// As slowly as can be.
  Rgba8 expectedAt(int pixel, double& inverseZDepth) const {
    glm::dvec3 weights;
    for (int i = 0; i < 3; ++i) weights[i] = run_.start[i] + run_.slope[i] * (run_.x0 + pixel);
    const double sum = weights.x + weights.y + weights.z;
    inverseZDepth = sum * run_.perDepth;
    weights /= sum;
    const auto mean = [&](const float(&at)[3][2]) {
      glm::dvec2 total(0);
      for (int c = 0; c < 3; ++c) total += weights[c] * glm::dvec2(at[c][0], at[c][1]);
      return glm::vec2(total);
    };
    glm::vec3 radiance(shade_.colour[0], shade_.colour[1], shade_.colour[2]);
    if (shade_.texels != nullptr) radiance *= glm::vec3(sampleColour(scene_, use_, mean(shade_.uv)));
    if (lit_)
      radiance *= shade_.resolution == 0 ? glm::vec3(0)
                                         : interpolatedLight(light_.data(), std::uint32_t(shade_.resolution),
                                                             mean(shade_.barycentric));
    radiance += glm::vec3(shade_.emission[0], shade_.emission[1], shade_.emission[2]);
    return encodeForDisplay(radiance, shade_.exposure);
  }

  int count() const { return run_.count; }
  bool nearest() const { return shade_.texels != nullptr && shade_.nearest; }

 private:
  bool flip() { return random_() % 2 == 0; }
  float between(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }

  std::mt19937& random_;
  Scene scene_;
  TextureUse use_;
  std::vector<HalfColour> light_;
  bool lit_ = false;
  SurfaceShade shade_;
  SurfaceRun run_{};
};

TEST(SurfaceKernel, ShowsTextureTimesLightPlusEmission) {
  std::mt19937 random(11);
  int compared = 0, apart = 0;
  for (int round = 0; round < 1000; ++round) {
    const ShadedTriangle triangle(random);
    const ShadedTriangle::Pixels pixels = triangle.shaded(shadeRunScalar);
    for (int i = 0; i < triangle.count(); ++i) {
      double inverseZDepth = 0;
      const Rgba8 expected = triangle.expectedAt(i, inverseZDepth),
                  got = colourOf(pixels.colour[std::size_t(i)]);
      ASSERT_NEAR(std::bit_cast<float>(pixels.depth[std::size_t(i)]), inverseZDepth, 1e-6 * inverseZDepth);
      ASSERT_EQ(got.a, 255);
      int most = 0;
      for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(int(got[c]) - int(expected[c])));
      // Weights are rounded otherwise here, and near a texel's border that chooses the other texel.
      if (!triangle.nearest()) {
        ASSERT_LE(most, 1) << "round " << round << ", pixel " << i;
      }
      ++compared, apart += most > 1;
    }
    for (std::size_t i = std::size_t(triangle.count()); i < pixels.colour.size(); ++i) {
      ASSERT_EQ(pixels.colour[i], ShadedTriangle::kUntouched);
      ASSERT_EQ(pixels.depth[i], ShadedTriangle::kUntouched);
    }
  }
  EXPECT_GT(compared, 15000);
  EXPECT_LE(apart, compared / 1000);
}

TEST(SurfaceKernel, GivesTheSameCodesWhateverTheProcessor) {
  std::mt19937 random(12);
  for (int round = 0; round < 2000; ++round) {
    const ShadedTriangle triangle(random);
    for (const Kernels& kernels : supportedKernels())
      ASSERT_TRUE(triangle.shaded(kernels.shadeRun) == triangle.shaded(shadeRunScalar))
          << kernels.name << ", round " << round;
  }
}

/// A row of pixels that many triangles may cover, in a picture with earlier ones.
struct CoveredRow {
  std::vector<std::uint32_t> visible;
  std::vector<float> nearest;

  void cover(TriangleRow row, CoverRow coverRow) {
    row.visible = visible.data() + row.x0, row.nearest = nearest.data() + row.x0;
    coverRow(row);
  }
};

TEST(CoverRow, ShowsTheNearestTriangleAtEachPixel) {
  constexpr int kWidth = 90;
  std::mt19937 random(14);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int covered = 0, onBorder = 0;
  for (int round = 0; round < 500; ++round) {
    const std::size_t room = kWidth + 20;
    CoveredRow expected{std::vector<std::uint32_t>(room, ~0u), std::vector<float>(room, 0.0f)};
    std::vector<CoveredRow> got(supportedKernels().size(), expected);
    for (std::uint32_t t = 0; t < 12; ++t) {
      TriangleRow row;
      // Whole numbers, so that edges run through pixel centres.
      for (int i = 0; i < 3; ++i) {
        row.slope[i] = int(random() % 5) - 2;
        row.start[i] = -row.slope[i] * int(random() % kWidth);
        row.ownsBorder[i] = random() % 2 == 0;
      }
      row.start[random() % 3] += between(0, 40);
      row.perDepth = between(0.001, 0.1), row.mostInverse = 5;
      row.x0 = int(random() % kWidth), row.count = 1 + int(random() % std::uint32_t(kWidth - row.x0));
      row.triangle = t;
      for (int x = row.x0; x < row.x0 + row.count; ++x) {
        double sum = 0;
        bool inside = true;
        for (int i = 0; i < 3; ++i) {
          const double value = row.slope[i] * x + row.start[i];
          sum += value;
          inside = inside && (value > 0 || (value == 0 && row.ownsBorder[i]));
          onBorder += value == 0;
        }
        const double inverse = sum * row.perDepth;
        const std::size_t pixel = std::size_t(x);
        if (!inside || !(inverse > 0) || inverse > row.mostInverse ||
            float(inverse) <= expected.nearest[pixel])
          continue;
        expected.visible[pixel] = t, expected.nearest[pixel] = float(inverse);
        ++covered;
      }
      for (std::size_t k = 0; k < got.size(); ++k) got[k].cover(row, supportedKernels()[k].coverRow);
    }
    for (std::size_t k = 0; k < got.size(); ++k) {
      ASSERT_EQ(got[k].visible, expected.visible) << supportedKernels()[k].name << ", round " << round;
      ASSERT_EQ(got[k].nearest, expected.nearest) << supportedKernels()[k].name << ", round " << round;
    }
  }
  EXPECT_GT(covered, 10000);
  EXPECT_GT(onBorder, 1000);
}

TEST(SurfaceKernel, StaysDefinedForCoordinatesAndRadianceOutOfAnyRange) {
  std::mt19937 random(13);
  const float wild[] = {HUGE_VALF, -HUGE_VALF, std::nanf(""), 3e38f, -1e20f, 0x1p23f, -0.0f, 1e-40f};
  for (int round = 0; round < 2000; ++round) {
    ShadedTriangle triangle(random);
    const auto any = [&] { return wild[random() % std::size(wild)]; };
    SurfaceShade& shade = triangle.shade();
    for (int c = 0; c < 3; ++c) {
      if (random() % 2 == 0) shade.uv[c][random() % 2] = any();
      if (random() % 2 == 0) shade.barycentric[c][random() % 2] = any();
      if (random() % 2 == 0) shade.colour[c] = any();
      if (random() % 2 == 0) shade.emission[c] = any();
    }
    for (const Kernels& kernels : supportedKernels())
      ASSERT_TRUE(triangle.shaded(kernels.shadeRun).colour == triangle.shaded(shadeRunScalar).colour)
          << kernels.name << ", round " << round;
  }
}

}  // namespace
}  // namespace acentric
