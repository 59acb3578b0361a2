#include "engine/view/surface_kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/image/colour.h"
#include "engine/scene/surface_alpha.h"
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
    }
    shade_.linearFromSrgb = linearFromSrgbTable().data();
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
  const SurfaceShade& surface() const { return shade_; }
  const SurfaceRun& run() const { return run_; }

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

  double inverseZDepthAt(int pixel) const {
    const glm::dvec3 values = edgesAt(pixel, run_.start);
    return (values.x + values.y + values.z) * run_.perDepth;
  }
  /// As slowly as can be.
  Rgba8 expectedAt(int pixel) const {
    glm::vec3 base;
    return expectedAt(pixel, run_.start, base);
  }
  /// With edge functions that start elsewhere; also the base colour.
  Rgba8 expectedAt(int pixel, const double (&start)[3], glm::vec3& base) const {
    const glm::dvec3 values = edgesAt(pixel, start), weights = values / (values.x + values.y + values.z);
    const auto mean = [&](const float(&at)[3][2]) {
      glm::dvec2 total(0);
      for (int c = 0; c < 3; ++c) total += weights[c] * glm::dvec2(at[c][0], at[c][1]);
      return glm::vec2(total);
    };
    glm::vec3 radiance(shade_.colour[0], shade_.colour[1], shade_.colour[2]);
    if (shade_.texels != nullptr) radiance *= glm::vec3(sampleColour(scene_, use_, mean(shade_.uv)));
    base = radiance;
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
  glm::dvec3 edgesAt(int pixel, const double (&start)[3]) const {
    glm::dvec3 values;
    for (int i = 0; i < 3; ++i) values[i] = start[i] + run_.slope[i] * (run_.x0 + pixel);
    return values;
  }
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
      const double inverseZDepth = triangle.inverseZDepthAt(i);
      const Rgba8 expected = triangle.expectedAt(i), got = colourOf(pixels.colour[std::size_t(i)]);
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

/// A clear triangle over random pixels with random sources.
struct BlendedRow {
  ClearShade shade;
  ClearRow row;
  std::vector<std::uint32_t> colour;
  std::vector<std::uint16_t> source;
  std::vector<float> nearest;

  BlendedRow(const ShadedTriangle& triangle, const SurfaceRun& run, std::mt19937& random) {
    const auto between = [&](float low, float high) {
      return std::uniform_real_distribution<float>(low, high)(random);
    };
    shade.surface = triangle.surface();
    shade.opacity = random() % 2 == 0 ? 1 : between(0, 1);
    shade.glass = random() % 2 == 0;
    shade.transmission = between(0, 1);
    for (int c = 0; c < 3; ++c)
      for (int axis = 0; axis < 3; ++axis) {
        shade.normal[c][axis] = random() % 9 == 0 ? 0 : between(-1, 1);
        shade.toEye[c][axis] = between(-2, 2);
      }
    for (int i = 0; i < 3; ++i) {
      row.slope[i] = run.slope[i], row.start[i] = run.start[i];
      if (random() % 2 == 0) row.start[i] -= 0.3;  // not all covered
      row.ownsBorder[i] = true;
    }
    row.perDepth = run.perDepth, row.mostInverse = 1e7;
    row.x0 = run.x0, row.count = run.count;
    const std::size_t count = std::size_t(run.count) + 20;
    for (std::size_t i = 0; i < count; ++i) {
      colour.push_back(std::uint32_t(random()) | 0xff000000u);
      source.push_back(std::uint16_t(random() % 4 == 0 ? row.hole : random() % 3 == 0 ? row.local : 7));
      nearest.push_back(between(0, 10));
    }
  }

  std::vector<std::uint32_t> blended(BlendRow blendRow) const {
    std::vector<std::uint32_t> result = colour;
    ClearRow own = row;
    own.colour = result.data(), own.source = source.data(), own.nearest = nearest.data();
    blendRow(shade, own);
    return result;
  }

  /// Pixel i as slowly as can be, from the colour that the triangle has there.
  Rgba8 expectedAt(std::size_t i, Rgba8 own, const glm::vec3& base) const {
    const Rgba8 before = colourOf(colour[i]);
    glm::dvec3 weights;
    for (int c = 0; c < 3; ++c) weights[c] = row.start[c] + row.slope[c] * (row.x0 + int(i));
    const double inverse = (weights.x + weights.y + weights.z) * row.perDepth;
    if (weights.x < 0 || weights.y < 0 || weights.z < 0 || !(inverse > 0) || source[i] == row.hole ||
        (source[i] == row.local && float(inverse) <= nearest[i]))
      return before;
    weights /= weights.x + weights.y + weights.z;
    const auto mean = [&](const float(&at)[3][3]) {
      glm::dvec3 sum(0);
      for (int c = 0; c < 3; ++c) sum += weights[c] * glm::dvec3(at[c][0], at[c][1], at[c][2]);
      return glm::vec3(sum);
    };
    float alpha = shade.opacity;
    if (shade.glass) {
      const float cosine =
          std::abs(glm::dot(glm::normalize(mean(shade.normal)), glm::normalize(mean(shade.toEye))));
      alpha *= glassAlpha(shade.transmission, base, cosine).alpha();
    }
    own.a = alpha == 1 ? 255 : std::uint8_t(std::clamp(alpha, 0.0f, 1.0f) * 255 + 0.5f);
    return blendOver(own, before);
  }
};

TEST(BlendRow, LaysWhatIsClearOverWhatDoesNotHideIt) {
  std::mt19937 random(15);
  int blended = 0, kept = 0;
  for (int round = 0; round < 1000; ++round) {
    ShadedTriangle triangle(random);
    if (triangle.nearest()) continue;
    const BlendedRow row(triangle, triangle.run(), random);
    const std::vector<std::uint32_t> got = row.blended(blendRowScalar);
    for (std::size_t i = 0; i < got.size(); ++i) {
      if (i >= std::size_t(triangle.count())) {
        ASSERT_EQ(got[i], row.colour[i]);
        continue;
      }
      glm::vec3 base;
      const Rgba8 own = triangle.expectedAt(int(i), row.row.start, base),
                  expected = row.expectedAt(i, own, base), pixel = colourOf(got[i]);
      for (int c = 0; c < 4; ++c)
        ASSERT_LE(std::abs(int(pixel[c]) - int(expected[c])), 2) << "round " << round << ", pixel " << i;
      ++(got[i] == row.colour[i] ? kept : blended);
    }
  }
  EXPECT_GT(blended, 3000);
  EXPECT_GT(kept, 3000);
}

TEST(BlendRow, GivesTheSameCodesWhateverTheProcessor) {
  std::mt19937 random(16);
  for (int round = 0; round < 2000; ++round) {
    const ShadedTriangle triangle(random);
    const BlendedRow row(triangle, triangle.run(), random);
    for (const Kernels& kernels : supportedKernels())
      ASSERT_EQ(row.blended(kernels.blendRow), row.blended(blendRowScalar))
          << kernels.name << ", round " << round;
  }
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
