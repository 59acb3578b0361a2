/// Textures as WebP.

#include "engine/export/webp.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/image/colour_quality.h"
#include "engine/measure/compare.h"

namespace acentric {
namespace {

ColourImage picture(bool clear) {
  ColourImage image(96, 64);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const bool hole = clear && (x / 7 + y / 5) % 3 == 0;
      image.at(x, y) = Rgba8(60 + 100 * x / 96, 40 + x * y / 51, 200 - 2 * y, hole ? 0 : 255);
    }
  return image;
}

ColourImage back(const Result<std::vector<std::byte>>& bytes) {
  EXPECT_TRUE(bytes);
  const auto image = decodeColourImage(*bytes, "picture.webp");
  EXPECT_TRUE(image) << image.error().describe();
  return *image;
}

TEST(Webp, KeepsEveryBitIfItIsTold) {
  const ColourImage image = picture(false);
  EXPECT_EQ(back(encodeWebp(image, kLosslessColours)).pixels, image.pixels);
}

TEST(Webp, IsTruerAndLargerTheHigherItsQuality) {
  const ColourImage image = picture(false);
  double truth = 0;
  std::size_t size = 0;
  for (const int quality : {20, 60, 92}) {
    const auto bytes = encodeWebp(image, quality);
    const double decibels = psnrOf(back(bytes), image);
    EXPECT_GT(decibels, truth);
    EXPECT_GT(bytes->size(), size);
    truth = decibels, size = bytes->size();
  }
  EXPECT_GT(truth, 30);
}

TEST(Webp, KeepsMasksExactly) {
  const ColourImage image = picture(true);
  for (const int quality : {10, 92, kLosslessColours}) {
    const ColourImage decoded = back(encodeWebp(image, quality));
    ASSERT_EQ(decoded.pixels.size(), image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); ++i) ASSERT_EQ(decoded.pixels[i].a, image.pixels[i].a);
  }
}

TEST(Webp, RefusesWhatItCannotHold) {
  const auto refused = encodeWebp(ColourImage(kLargestWebp + 1, 1), 90);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, testing::HasSubstr("take PNG"));
}

}  // namespace
}  // namespace acentric
