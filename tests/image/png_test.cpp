/// Textures as PNG.

#include "engine/image/png.h"

#include <gtest/gtest.h>

#include <random>

namespace acentric {
namespace {

TEST(Png, KeepsEveryBitAndNoAlphaWhereAllIsOpaque) {
  std::mt19937 random(1);
  for (const glm::ivec2 size : {glm::ivec2(1), glm::ivec2(97, 3), glm::ivec2(300, 200)}) {
    ColourImage image(size.x, size.y);
    for (Rgba8& p : image.pixels) p = Rgba8(random() % 256, random() % 4, 7, 255);
    const auto opaque = encodePng(image);
    ASSERT_TRUE(opaque);
    constexpr std::size_t kColourType = 25;
    EXPECT_EQ((*opaque)[kColourType], std::byte(2)) << "red, green and blue";
    EXPECT_EQ(decodePng(*opaque, size.x, size.y, "picture")->pixels, image.pixels);
    image.pixels.back().a = 3;
    const auto clear = encodePng(image);
    ASSERT_TRUE(clear);
    EXPECT_EQ((*clear)[kColourType], std::byte(6)) << "and alpha";
    EXPECT_EQ(decodePng(*clear, size.x, size.y, "picture")->pixels, image.pixels);
    EXPECT_FALSE(decodePng(*clear, size.x + 1, size.y, "picture"));
  }
  EXPECT_FALSE(encodePng(ColourImage())) << "a PNG has pixels";
}

}  // namespace
}  // namespace acentric
