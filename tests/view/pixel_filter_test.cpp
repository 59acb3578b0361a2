#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "engine/view/canvas.h"
#include "engine/view/kernels.h"

namespace acentric {
namespace {

/// Three columns of pixels, as FilterPixels wants them.
struct Columns {
  int count;
  std::array<std::vector<CanvasPixel>, 3> pixels;

  explicit Columns(int rows) : count(rows) {
    for (auto& column : pixels) column.assign(static_cast<std::size_t>(rows) + 18, kEmptyPixel);
  }
  std::vector<std::uint32_t> filtered(FilterPixels filter) const {
    std::vector<std::uint32_t> out(static_cast<std::size_t>(count) + 16);
    filter(pixels[0].data(), pixels[1].data(), pixels[2].data(), count, out.data());
    out.resize(static_cast<std::size_t>(count));
    return out;
  }
};

/// A sample at (x, y) pixels from the pixel's centre.
CanvasPixel pixelOf(const Rgba8& colour, double x, double y, std::uint32_t spread = 0) {
  const auto eighths = [](double place) { return static_cast<int>(std::lround(8 * place)) + 4; };
  return (canvasPixel((wordOf(colour) & 0xffffffu) | 1u << 24, 0.5f) & ~kPlaceBits) |
         placeBits(eighths(x), eighths(y), spread);
}

Columns randomColumns(std::mt19937& random, int count) {
  Columns columns(count);
  for (auto& column : columns.pixels)
    for (int i = 0; i < count + 2; ++i) {
      const CanvasPixel bits = (CanvasPixel(random()) << 32) | random();
      column[static_cast<std::size_t>(i)] = random() % 4 == 0 ? bits & 0xffffffff00ffffffu : bits;
    }
  return columns;
}

TEST(PixelFilter, GivesTheSameCodesWhateverTheProcessor) {
  std::mt19937 random(3);
  for (int round = 0; round < 500; ++round) {
    const Columns columns = randomColumns(random, 1 + round % 40);
    for (const Kernels& kernels : supportedKernels())
      ASSERT_EQ(columns.filtered(kernels.filter), columns.filtered(filterPixelsScalar))
          << kernels.name << ", round " << round;
  }
}

TEST(PixelFilter, IsTheWeightedMeanOfTheNineSamples) {
  std::mt19937 random(4);
  std::uniform_int_distribution<int> eighth(-8, 7), spread(0, 7), code(0, 255);
  for (int round = 0; round < 2000; ++round) {
    Columns columns(1);
    double weights = 0;
    std::array<double, 3> squares{};
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y) {
        const double dx = eighth(random) / 8.0, dy = eighth(random) / 8.0;
        const int s = spread(random);
        const Rgba8 colour(code(random), code(random), code(random), 255);
        columns.pixels[static_cast<std::size_t>(x + 1)][static_cast<std::size_t>(y + 1)] =
            pixelOf(colour, dx, dy, static_cast<std::uint32_t>(s));
        const double apart = 8.0 / (8 - s);
        const double weight =
            std::max(0.0, 1 - std::abs(x + dx) / apart) * std::max(0.0, 1 - std::abs(y + dy) / apart);
        weights += weight;
        for (int c = 0; c < 3; ++c) squares[static_cast<std::size_t>(c)] += weight * colour[c] * colour[c];
      }
    if (weights < 0.3) continue;  // the weights' own steps show
    const Rgba8 got = colourOf(columns.filtered(filterPixelsScalar).front());
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(got[c], std::sqrt(squares[static_cast<std::size_t>(c)] / weights), 4) << round;
    EXPECT_EQ(got.a, 255);
  }
}

TEST(PixelFilter, LeavesOneColourAsItIs) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> place(-1, 0.99);
  for (int code = 0; code < 256; ++code) {
    const Rgba8 colour(code, 255 - code, code / 2, 255);
    Columns columns(20);
    for (auto& column : columns.pixels)
      for (int i = 0; i < 22; ++i)
        column[static_cast<std::size_t>(i)] = pixelOf(colour, place(random), place(random), random() % 8);
    for (std::uint32_t word : columns.filtered(filterPixelsScalar)) EXPECT_EQ(colourOf(word), colour);
  }
}

TEST(PixelFilter, InterpolatesBetweenSamplesOfAGrid) {
  // Light that rises evenly from row to row, sampled a third of a pixel below each centre.
  Columns columns(30);
  const auto light = [](double y) { return 6000 + 1500 * y; };
  for (auto& column : columns.pixels)
    for (int i = 0; i < 32; ++i) {
      const auto code = static_cast<std::uint8_t>(std::lround(std::sqrt(light(i - 1 + 0.375))));
      column[static_cast<std::size_t>(i)] = pixelOf(Rgba8(code, code, code, 255), 0, 0.375);
    }
  const std::vector<std::uint32_t> out = columns.filtered(filterPixelsScalar);
  for (int i = 0; i < 30; ++i)
    EXPECT_NEAR(colourOf(out[static_cast<std::size_t>(i)]).r, std::sqrt(light(i)), 1.01) << i;
}

TEST(PixelFilter, KeepsAColourThatNothingWeighsAgainst) {
  Columns columns(3);
  columns.pixels[1][2] = pixelOf(Rgba8(10, 20, 30, 255), -1, 0);  // a whole pixel off its centre
  const std::vector<std::uint32_t> out = columns.filtered(supportedKernels().back().filter);
  EXPECT_EQ(colourOf(out[1]), Rgba8(10, 20, 30, 255));
  EXPECT_EQ(out, columns.filtered(filterPixelsScalar));
}

}  // namespace
}  // namespace acentric
