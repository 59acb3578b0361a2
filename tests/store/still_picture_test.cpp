#include "engine/store/still_picture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace acentric {
namespace {

TEST(StillPictures, OfAnotherSizeOrDamagedAreRefused) {
  for (const int bits : {8, 10}) {
    StillPicture picture{32, 16, bits, {}};
    for (auto& plane : picture.planes)
      for (int n = 0; n < 32 * 16; ++n) plane.push_back(std::uint16_t((75 << (bits - 8)) + n % 32));
    const auto file = encodeStill(picture, 90);
    ASSERT_TRUE(file) << file.error().describe();
    const auto back = decodeStill(*file, 32, 16, bits);
    ASSERT_TRUE(back) << back.error().describe();
    for (int p = 0; p < 3; ++p)
      for (std::size_t n = 0; n < 32 * 16; ++n)
        ASSERT_NEAR(back->planes[p][n], picture.planes[p][n], 12) << bits << ' ' << p << ' ' << n;
    for (const auto& [width, height] : {std::pair{16, 32}, {32, 32}, {31, 16}, {64, 8}})
      EXPECT_FALSE(decodeStill(*file, width, height, bits)) << width << 'x' << height;
    EXPECT_FALSE(decodeStill(*file, 32, 16, 18 - bits));
    EXPECT_FALSE(decodeStill(std::span(*file).first(file->size() / 2), 32, 16, bits));
    EXPECT_FALSE(decodeStill({}, 32, 16, bits));
  }
}

/// A wave of colours; every third column clear, if that is asked for.
ColourImage wave(int width, int height, bool clear) {
  ColourImage image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.at(x, y) = Rgba8(60 + 3 * x, 200 - 2 * y, 120 + x - y, clear && x % 3 == 0 ? 40 * (y % 5) : 255);
  return image;
}

TEST(StillColours, AreCloseToWhatTheyWereAndTheirAlphaExact) {
  for (const bool clear : {false, true}) {
    const ColourImage image = wave(48, 20, clear);
    std::size_t bytes = 0;
    for (const int quality : {50, 92}) {
      const auto file = encodeStill(image, quality);
      ASSERT_TRUE(file) << file.error().describe();
      EXPECT_TRUE(isStill(*file));
      EXPECT_GT(file->size(), bytes) << "the truer, the larger";
      bytes = file->size();
      const auto back = decodeStillColours(*file, 48, 20);
      ASSERT_TRUE(back) << back.error().describe();
      double squares = 0;
      for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        ASSERT_EQ(back->pixels[i].a, image.pixels[i].a) << i;
        for (int c = 0; c < 3; ++c) {
          const double off = double(back->pixels[i][c]) - double(image.pixels[i][c]);
          squares += off * off;
        }
      }
      const double rms = std::sqrt(squares / (3 * double(image.pixels.size())));
      EXPECT_LT(rms, quality > 90 ? 2 : 8) << clear << ' ' << quality;
    }
  }
}

TEST(StillColours, OfAnotherSizeOrDamagedAreRefused) {
  const auto file = encodeStill(wave(48, 20, true), 80);
  ASSERT_TRUE(file);
  for (const auto& [width, height] : {std::pair{20, 48}, {48, 48}, {47, 20}, {96, 10}})
    EXPECT_FALSE(decodeStillColours(*file, width, height)) << width << 'x' << height;
  EXPECT_FALSE(decodeStill(*file, 48, 20, 8)) << "three planes have no alpha";
  for (std::size_t bytes = 0; bytes < file->size(); bytes += 7)
    EXPECT_FALSE(decodeStillColours(std::span(*file).first(bytes), 48, 20)) << bytes;
  EXPECT_FALSE(isStill({}));
  EXPECT_FALSE(isStill(std::span(*file).subspan(1)));
}

}  // namespace
}  // namespace acentric
