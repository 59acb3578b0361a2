#include "engine/scene/texture_pyramid.h"

#include <gtest/gtest.h>

namespace acentric {
namespace {

constexpr Rgba8 kBlack{0, 0, 0, 255}, kWhite{255, 255, 255, 255};

ColourImage checker(int width, int height) {
  ColourImage image(width, height, kBlack);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if ((x + y) % 2 == 0) image.at(x, y) = kWhite;
  return image;
}

TEST(TexturePyramid, HalvesDownToOneTexel) {
  const auto levels = halvings(ColourImage(12, 5), TexelKind::colour);
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_EQ(levels[0].width, 6);
  EXPECT_EQ(levels[0].height, 2);
  EXPECT_EQ(levels[1].width, 3);
  EXPECT_EQ(levels[1].height, 1);
  EXPECT_EQ(levels[2].width, 1);
  EXPECT_EQ(levels[2].height, 1);
  EXPECT_TRUE(halvings(ColourImage(1, 1), TexelKind::colour).empty());
}

TEST(TexturePyramid, AveragesColoursInLinearLightAndDataAsTheyAre) {
  for (const ColourImage& level : halvings(checker(4, 4), TexelKind::colour))
    for (const Rgba8& texel : level.pixels) EXPECT_EQ(texel, Rgba8(188, 188, 188, 255));  // half the light
  for (const ColourImage& level : halvings(checker(4, 4), TexelKind::data))
    for (const Rgba8& texel : level.pixels) EXPECT_EQ(texel, Rgba8(128, 128, 128, 255));
}

TEST(TexturePyramid, GivesWhatIsCutAwayNoColour) {
  ColourImage leaf(2, 2, {255, 0, 255, 0});
  leaf.at(0, 0) = {0, 200, 0, 255};
  EXPECT_EQ(halvings(leaf, TexelKind::cutColour).front().at(0, 0), Rgba8(0, 200, 0, 64));
  EXPECT_NE(halvings(leaf, TexelKind::colour).front().at(0, 0), Rgba8(0, 200, 0, 64));
  // Nothing left at all: the mean is as good as any.
  EXPECT_EQ(halvings(ColourImage(2, 2, {10, 20, 30, 0}), TexelKind::cutColour).front().at(0, 0),
            Rgba8(10, 20, 30, 0));
}

TEST(TexturePyramid, CountsEveryTexelOfAnOddSizeOnce) {
  // One bright texel, wherever it is, brightens each coarser level by its share of the area it falls in.
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 7; ++x) {
      ColourImage image(7, 3, {0, 0, 0, 0});
      image.at(x, y) = {0, 0, 0, 252};
      const auto levels = halvings(image, TexelKind::data);
      ASSERT_EQ(levels.front().width, 3);
      ASSERT_EQ(levels.front().height, 1);
      int bright = 0;
      for (const Rgba8& texel : levels.front().pixels) {
        if (texel.a == 0) continue;
        ++bright;
        EXPECT_TRUE(texel.a == 42 || texel.a == 28) << int(texel.a);  // of 2 x 3 or 3 x 3 texels
      }
      EXPECT_EQ(bright, 1) << x << " " << y;
    }
}

TEST(TexturePyramid, IsMadeOfWhatTheMaterialsReadAlone) {
  Scene scene;
  for (int i = 0; i < 3; ++i) {
    scene.images.push_back(std::make_shared<ColourImage>(checker(4, 4)));
    scene.textures.emplace_back();
    scene.textures.back().image = i;
  }
  Material material;
  material.baseColourTexture.texture = 0;
  material.normalTexture.texture = 1;
  scene.materials.push_back(material);
  TaskRunner runner(0);
  const auto& image = [&](int i) -> const ColourImage& { return *scene.images[std::size_t(i)]; };
  const TexturePyramids textures(scene, {.textures = true}, runner);
  ASSERT_TRUE(textures.any());
  EXPECT_EQ(&textures.level(image(0), TexelKind::colour, 0), &image(0));
  EXPECT_EQ(textures.level(image(0), TexelKind::colour, 1).width, 2);
  EXPECT_EQ(textures.level(image(0), TexelKind::colour, 2).width, 1);
  EXPECT_EQ(textures.level(image(0), TexelKind::colour, 30).width, 1);
  EXPECT_EQ(textures.level(image(1), TexelKind::data, 1).width, 4) << "normal maps are off";
  EXPECT_EQ(textures.level(image(2), TexelKind::colour, 1).width, 4) << "no material reads it";
  EXPECT_FALSE(TexturePyramids(scene, {}, runner).any());
}

}  // namespace
}  // namespace acentric
