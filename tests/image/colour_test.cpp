#include "engine/image/colour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace acentric {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();
constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();

/// IEC 61966-2-1, written down a second time in double.
double referenceDecode(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }
double referenceEncode(double v) { return v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }

/// Hue in [0, 6), of a colour that is not grey.
double hueOf(const glm::dvec3& c) {
  const double high = std::max({c.x, c.y, c.z}), range = high - std::min({c.x, c.y, c.z});
  double hue = 0;
  if (high == c.x)
    hue = (c.y - c.z) / range;
  else if (high == c.y)
    hue = 2 + (c.z - c.x) / range;
  else
    hue = 4 + (c.x - c.y) / range;
  return hue < 0 ? hue + 6 : hue;
}

TEST(Srgb, EveryCodeSurvivesTheRoundTrip) {
  for (int code = 0; code < 256; ++code) {
    const float linear = linearFromSrgbTable()[static_cast<std::size_t>(code)];
    EXPECT_NEAR(linear, referenceDecode(code / 255.0), 1e-7);
    EXPECT_FLOAT_EQ(linear, linearFromSrgb(static_cast<float>(code) / 255.0f)) << code;
    EXPECT_EQ(std::lround(srgbFromLinear(linear) * 255.0f), code);
    EXPECT_EQ(srgbCodeFromLinear(linear), code);
  }
}

TEST(Srgb, TableCodesAreTheNearestOnes) {
  for (int i = 0; i <= 1000000; ++i) {
    const float linear = static_cast<float>(i) / 1000000.0f;
    const double exact = referenceEncode(linear) * 255;
    ASSERT_LE(std::abs(srgbCodeFromLinear(linear) - exact), 0.5 + 1e-4) << linear;
  }
}

TEST(Srgb, ValuesOutsideTheRangeAreClamped) {
  EXPECT_EQ(srgbCodeFromLinear(-1), 0);
  EXPECT_EQ(srgbCodeFromLinear(kNotANumber), 0);
  EXPECT_EQ(srgbCodeFromLinear(1), 255);
  EXPECT_EQ(srgbCodeFromLinear(std::nextafter(1.0f, 0.0f)), 255);
  EXPECT_EQ(srgbCodeFromLinear(kInfinite), 255);
  EXPECT_EQ(srgbFromLinear(2), 1);
  EXPECT_EQ(linearFromSrgb(-3), 0);
}

TEST(ToneMap, IsTheIdentityBelowTheShoulder) {
  for (const glm::vec3 c :
       {glm::vec3(0), glm::vec3(0.18f), glm::vec3(0.76f, 0, 0.3f), glm::vec3(0.1f, 0.7f, 0.2f)})
    EXPECT_EQ(toneMap(c, 1), c);
  EXPECT_EQ(toneMap(glm::vec3(0.1f, 0.2f, 0.3f), 2), glm::vec3(0.1f, 0.2f, 0.3f) * 2.0f)
      << "exposure is a factor";
}

TEST(ToneMap, RisesWithoutJumpsAndStaysWithinTheDisplay) {
  // Along a grey and a saturated ramp, through the shoulder's start: slope between 0 and about 1.
  for (const glm::vec3 tint : {glm::vec3(1), glm::vec3(1, 0.3f, 0.1f), glm::vec3(0.2f, 1, 0.9f)}) {
    glm::vec3 last(0);
    constexpr float step = 1.0f / 4096;
    for (int i = 0; i <= 40 * 4096; ++i) {
      const glm::vec3 mapped = toneMap(tint, step * static_cast<float>(i));
      for (int channel = 0; channel < 3; ++channel) {
        ASSERT_GE(mapped[channel], last[channel] - 2e-7f) << i;
        ASSERT_LE(mapped[channel], last[channel] + 1.01f * step) << i;
        ASSERT_LE(mapped[channel], 1.0f);
      }
      last = mapped;
    }
    EXPECT_GT(std::max({last.x, last.y, last.z}), 0.99f);
  }
}

TEST(ToneMap, KeepsTheHueWhileHighlightsLoseColour) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> channel(0.0f, 6.0f);
  for (int i = 0; i < 20000; ++i) {
    const glm::vec3 radiance(channel(random), channel(random), channel(random));
    const float range =
        std::max({radiance.x, radiance.y, radiance.z}) - std::min({radiance.x, radiance.y, radiance.z});
    if (range < 0.2f) continue;
    const glm::vec3 mapped = toneMap(radiance, 1);
    double turn = std::abs(hueOf(glm::dvec3(radiance)) - hueOf(glm::dvec3(mapped)));
    turn = std::min(turn, 6 - turn);
    ASSERT_LT(turn, 1e-4);
  }
  const glm::vec3 dim = toneMap(glm::vec3(1, 0.1f, 0.1f), 1), bright = toneMap(glm::vec3(1, 0.1f, 0.1f), 100);
  EXPECT_LT(dim.y / dim.x, 0.2f);
  EXPECT_GT(bright.y / bright.x, 0.9f) << "a very bright red goes to white";
}

TEST(ToneMap, SurvivesRadianceThatIsNoNumber) {
  EXPECT_EQ(toneMap(glm::vec3(kNotANumber, -1, -kInfinite), 1), glm::vec3(0));
  EXPECT_EQ(toneMap(glm::vec3(kNotANumber, 0.5f, 0), 1), glm::vec3(0, 0.5f, 0));
  EXPECT_EQ(toneMap(glm::vec3(0, 0.5f, 1), kNotANumber), glm::vec3(0));
  const glm::vec3 blinding = toneMap(glm::vec3(kInfinite), 1);
  EXPECT_NEAR(blinding.x, 1, 1e-6);
  EXPECT_EQ(blinding.x, blinding.z);
  const glm::vec3 mixed = toneMap(glm::vec3(kInfinite, 0, kNotANumber), 1e30f);
  for (int channel = 0; channel < 3; ++channel) {
    EXPECT_GE(mixed[channel], 0);
    EXPECT_LE(mixed[channel], 1);
  }
}

TEST(EncodeForDisplay, IsToneMapThenSrgb) {
  EXPECT_EQ(encodeForDisplay(glm::vec3(0, linearFromSrgb(0.5f), 0.5f), 1, 0.5f), Rgba8(0, 128, 188, 128));
  EXPECT_EQ(encodeForDisplay(glm::vec3(1e9f), 1), Rgba8(255));
  EXPECT_EQ(encodeForDisplay(glm::vec3(kNotANumber), 1, kNotANumber), Rgba8(0));
}

TEST(BlendOver, AgreesWithADoublePrecisionReference) {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> byte(0, 255);
  const auto draw = [&] { return static_cast<std::uint8_t>(byte(random)); };
  for (int i = 0; i < 100000; ++i) {
    const Rgba8 source(draw(), draw(), draw(), draw()), under(draw(), draw(), draw(), draw());
    const Rgba8 mixed = blendOver(source, under);
    ASSERT_EQ(mixed.a, 255);
    for (int channel = 0; channel < 3; ++channel) {
      const double a = source.a / 255.0;
      const double linear =
          referenceDecode(source[channel] / 255.0) * a + referenceDecode(under[channel] / 255.0) * (1 - a);
      ASSERT_LE(std::abs(mixed[channel] - 255 * referenceEncode(linear)), 0.501) << i;
    }
  }
}

TEST(BlendOver, OpaqueHidesAndClearShows) {
  EXPECT_EQ(blendOver(Rgba8(1, 2, 3, 255), Rgba8(9, 9, 9, 0)), Rgba8(1, 2, 3, 255));
  EXPECT_EQ(blendOver(Rgba8(1, 2, 3, 0), Rgba8(7, 8, 9, 40)), Rgba8(7, 8, 9, 255));
}

}  // namespace
}  // namespace acentric
