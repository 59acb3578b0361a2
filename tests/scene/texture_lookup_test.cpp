#include "engine/scene/texture_lookup.h"

#include <gtest/gtest.h>

#include <limits>

#include "engine/image/colour.h"
#include "engine/scene/surface_light.h"

namespace acentric {
namespace {

/// 2 x 2: black, red / green, white with half alpha.
Scene checkerScene(Wrap wrap, bool nearest) {
  Scene scene;
  ColourImage image(2, 2);
  image.pixels = {{0, 0, 0, 255}, {255, 0, 0, 255}, {0, 255, 0, 255}, {255, 255, 255, 128}};
  scene.images.push_back(std::make_shared<const ColourImage>(image));
  scene.textures.push_back({"checker", 0, wrap, wrap, nearest});
  return scene;
}

TextureUse first() {
  TextureUse use;
  use.texture = 0;
  return use;
}

void expectColour(const glm::vec4& got, const glm::vec4& expected) {
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(got[i], expected[i], 1e-5) << "channel " << i;
}

TEST(TextureLookup, TexelCentresAreExactAndVRunsDown) {
  for (const bool nearest : {false, true}) {
    const Scene scene = checkerScene(Wrap::repeat, nearest);
    expectColour(sampleColour(scene, first(), {0.75f, 0.25f}), {1, 0, 0, 1});
    expectColour(sampleColour(scene, first(), {0.25f, 0.75f}), {0, 1, 0, 1});
    expectColour(sampleColour(scene, first(), {0.75f, 0.75f}), {1, 1, 1, 128 / 255.0f});
  }
}

TEST(TextureLookup, BilinearMixesInLinearLight) {
  const Scene scene = checkerScene(Wrap::clamp, false);
  expectColour(sampleColour(scene, first(), {0.5f, 0.25f}), {0.5f, 0, 0, 1});
  expectColour(sampleColour(scene, first(), {0.5f, 0.5f}), {0.5f, 0.5f, 0.25f, 0.25f * (3 + 128 / 255.0f)});
  expectColour(sampleLinear(scene, first(), {0.75f, 0.5f}), {1, 0.5f, 0.5f, 0.5f * (1 + 128 / 255.0f)});
}

TEST(TextureLookup, ColoursAreDecodedFromSrgbAndDataIsNot) {
  Scene scene = checkerScene(Wrap::repeat, true);
  scene.images[0] = std::make_shared<const ColourImage>(ColourImage(1, 1, {128, 128, 128, 128}));
  expectColour(sampleColour(scene, first(), {0, 0}),
               glm::vec4(glm::vec3(linearFromSrgb(128 / 255.0f)), 128 / 255.0f));
  expectColour(sampleLinear(scene, first(), {0, 0}), glm::vec4(128 / 255.0f));
}

TEST(TextureLookup, WrapModesContinueTheTexture) {
  const auto redAt = [](Wrap wrap, float u) {
    return sampleColour(checkerScene(wrap, false), first(), {u, 0.25f}).r;
  };
  EXPECT_NEAR(redAt(Wrap::repeat, 1.75f), 1, 1e-5);
  EXPECT_NEAR(redAt(Wrap::repeat, -0.25f), 1, 1e-5);
  EXPECT_NEAR(redAt(Wrap::repeat, 0.0f), 0.5, 1e-5);
  EXPECT_NEAR(redAt(Wrap::clamp, 7), 1, 1e-5);
  EXPECT_NEAR(redAt(Wrap::clamp, -7), 0, 1e-5);
  EXPECT_NEAR(redAt(Wrap::mirror, 1.25f), 1, 1e-5);
  EXPECT_NEAR(redAt(Wrap::mirror, 1.75f), 0, 1e-5);
  EXPECT_NEAR(redAt(Wrap::mirror, -0.25f), 0, 1e-5);
  EXPECT_NEAR(redAt(Wrap::mirror, 2.75f), 1, 1e-5);
}

TEST(TextureLookup, TheTransformAppliesBeforeWrapping) {
  const Scene scene = checkerScene(Wrap::repeat, false);
  TextureUse use = first();
  use.transform = glm::mat3x2(2, 0, 0, 2, 0.25f, 0.25f);  // uv' = 2 uv + 0.25
  expectColour(sampleColour(scene, use, {0.25f, 0}), {1, 0, 0, 1});
}

TEST(TextureLookup, NoTextureIsWhiteAndBrokenCoordinatesAreDefined) {
  const Scene scene = checkerScene(Wrap::repeat, false);
  expectColour(sampleColour(scene, TextureUse{}, {0.3f, 0.4f}), glm::vec4(1));
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30f, -1e30f})
    for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
      const glm::vec4 got = sampleColour(checkerScene(wrap, false), first(), {bad, bad});
      EXPECT_TRUE(got.r >= 0 && got.r <= 1 && got.a > 0);
    }
}

/// Samples of a linear function of the weights on one triangle of resolution R, front and back.
SurfaceLight linearLight(std::uint32_t resolution) {
  SurfaceLight light;
  light.resolution = {std::uint16_t(resolution)};
  light.hasBack = {1};
  for (const float scale : {1.0f, 0.5f})
    for (std::uint32_t i = 0; i <= resolution; ++i)
      for (std::uint32_t j = 0; i + j <= resolution; ++j) {
        const float x = float(i) / float(resolution), y = float(j) / float(resolution);
        light.light.push_back(packColour(glm::vec4(scale * x, scale * y, scale * (1 - x - y), 1)));
      }
  light.firstSample = {0, std::uint32_t(light.light.size())};
  return light;
}

TEST(SurfaceLight, InterpolatesALinearFunctionExactlyOnBothSides) {
  for (const std::uint32_t resolution : {1u, 2u, 3u, 7u}) {
    const SurfaceLight light = linearLight(resolution);
    ASSERT_EQ(light.light.size(), 2 * surfaceSampleCount(resolution));
    for (int a = 0; a <= 20; ++a)
      for (int b = 0; a + b <= 20; ++b) {
        const glm::vec2 weights(float(a) / 20, float(b) / 20);
        const glm::vec3 front = light.at(0, weights, false), back = light.at(0, weights, true);
        const glm::vec3 expected(weights, 1 - weights.x - weights.y);
        EXPECT_LT(glm::distance(front, expected), 2e-3) << resolution << ": " << a << ", " << b;
        EXPECT_LT(glm::distance(back, 0.5f * expected), 2e-3);
      }
  }
}

TEST(SurfaceLight, WeightsJustOutsideReadTheBorderAndNothingBakedIsBlack) {
  SurfaceLight light = linearLight(3);
  EXPECT_LT(glm::distance(light.at(0, {1.0001f, 0.0001f}, false), glm::vec3(1, 0, 0)), 3e-3);
  EXPECT_LT(glm::distance(light.at(0, {-0.001f, 1.001f}, false), glm::vec3(0, 1, 0)), 3e-3);
  light.hasBack = {0};
  EXPECT_EQ(light.at(0, {0.2f, 0.2f}, true), glm::vec3(0));
  light.resolution = {0};
  EXPECT_EQ(light.at(0, {0.2f, 0.2f}, false), glm::vec3(0));
}

TEST(Sky, MixesFromHorizonToZenithAndIsGroundBelow) {
  const Sky sky{{0, 0, 1}, {1, 1, 1}, {0.2f, 0.1f, 0}};
  EXPECT_EQ(sky.radiance({0, 0, 1}), sky.zenith);
  EXPECT_EQ(sky.radiance({1, 0, 0}), sky.horizon);
  EXPECT_EQ(sky.radiance({0, 0, -1}), sky.ground);
  EXPECT_NEAR(sky.radiance(glm::normalize(glm::vec3(0, 1, 1))).r, 1 - std::sqrt(0.5f), 1e-5);
  EXPECT_FALSE(Sky{}.present());
}

}  // namespace
}  // namespace acentric
