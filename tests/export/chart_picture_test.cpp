/// Pictures of charts, against slow ways to the same.

#include "engine/export/chart_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace acentric {
namespace {

using Corners = std::array<glm::dvec2, 3>;

glm::dvec2 placeOf(const Corners& t, const glm::dvec2& b) {
  return (1 - b.x - b.y) * t[0] + b.x * t[1] + b.y * t[2];
}

TEST(ChartPicture, TheNearestTriangleOwnsATexel) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(-1, 41), y(-1, 23), small(-3, 3);
  const glm::ivec2 size(40, 22);
  for (int round = 0; round < 20; ++round) {
    std::vector<Corners> triangles;
    for (int k = 0; k < 12; ++k) {
      const glm::dvec2 from(x(random), y(random));
      triangles.push_back(k % 3 == 0 ? Corners{from, {x(random), y(random)}, {x(random), y(random)}}
                                     : Corners{from, from + small(random), {from.x + small(random), from.y}});
    }
    const auto owners = ownersOf(triangles, size);
    const glm::ivec2 all = size + 2 * kChartBorder;
    ASSERT_EQ(owners.size(), std::size_t(all.x * all.y));
    int owned = 0, free = 0;
    for (int row = 0; row < all.y; ++row)
      for (int column = 0; column < all.x; ++column) {
        const glm::dvec2 p = glm::dvec2(column, row) - double(kChartBorder) + 0.5;
        double nearest = HUGE_VAL;
        for (const Corners& t : triangles)
          nearest = std::min(nearest, glm::distance(p, placeOf(t, nearestWithin(t, p))));
        const TexelOwner& owner = owners[std::size_t(row * all.x + column)];
        if (owner.triangle == TexelOwner::kNone) {
          ++free;
          ASSERT_GT(nearest, double(kOwnedWithin) - 1e-6);
          continue;
        }
        ++owned;
        ASSERT_NEAR(owner.distance, nearest, 1e-5);
        ASSERT_NEAR(glm::distance(p, placeOf(triangles[owner.triangle], glm::dvec2(owner.barycentric))),
                    nearest, 1e-4);
      }
    EXPECT_GT(owned, 100);
    EXPECT_GT(owned + free, free);
  }
}

TEST(ChartPicture, NoPlaceOfATriangleIsNearer) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> at(0, 10);
  for (int round = 0; round < 300; ++round) {
    const Corners t{glm::dvec2(at(random), at(random)), {at(random), at(random)}, {at(random), at(random)}};
    const glm::dvec2 p(at(random), at(random)), found = nearestWithin(t, p);
    EXPECT_GE(std::min({found.x, found.y, 1 - found.x - found.y}), -1e-9);
    const double distance = glm::distance(p, placeOf(t, found));
    for (int i = 0; i <= 40; ++i)
      for (int j = 0; i + j <= 40; ++j)
        ASSERT_LE(distance, glm::distance(p, placeOf(t, glm::dvec2(i, j) / 40.0)) + 1e-9);
  }
  const Corners point{glm::dvec2(1), glm::dvec2(1), glm::dvec2(1)};
  EXPECT_EQ(placeOf(point, nearestWithin(point, {4, 5})), glm::dvec2(1));
}

TEST(ChartPicture, UnknownTexelsTakeTheMeanOfThoseAround) {
  std::mt19937 random(11);
  ColourImage picture(37, 21);
  std::vector<char> known;
  for (Rgba8& p : picture.pixels) {
    p = Rgba8(random() % 256, random() % 256, random() % 256, random() % 256);
    known.push_back(random() % 9 == 0 ? 1 : 0);
  }
  for (int i = 0; i < 21 * 16; ++i)
    if (i % 37 < 16) known[std::size_t(i)] = 0;  // none in the first squares
  ColourImage filled = picture;
  fillUnknown(filled, known);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      if (known[std::size_t(y * 37 + x)] != 0) {
        ASSERT_EQ(filled.at(x, y), picture.at(x, y));
        continue;
      }
      glm::dvec4 sum(0);
      double texels = 0;
      for (int side = 2; texels == 0; side *= 2)
        for (int j = y / side * side; j < std::min(picture.height, y / side * side + side); ++j)
          for (int i = x / side * side; i < std::min(picture.width, x / side * side + side); ++i)
            if (known[std::size_t(j * 37 + i)] != 0) sum += glm::dvec4(picture.at(i, j)), ++texels;
      for (int c = 0; c < 4; ++c) ASSERT_NEAR(filled.at(x, y)[c], sum[c] / texels, 0.51);
    }
  fillUnknown(picture, std::vector<char>(picture.pixels.size()));
}

ChartPicture pictureOf(int width, int height, const std::function<glm::dvec3(double, double)>& at) {
  ChartPicture out;
  out.image = ColourImage(width + 2 * kChartBorder, height + 2 * kChartBorder);
  out.texelsPerMetre = {100, 100};
  for (int y = 0; y < out.image.height; ++y)
    for (int x = 0; x < out.image.width; ++x) {
      const glm::dvec3 value = at(std::clamp(x - kChartBorder + 0.5, 0.0, double(width)),
                                  std::clamp(y - kChartBorder + 0.5, 0.0, double(height)));
      out.image.at(x, y) = Rgba8(glm::round(value.x), glm::round(value.y), glm::round(value.z), 255);
    }
  return out;
}

/// Root of mean squares, of what a linear filter shows of a smaller picture, in the worst 8 x 8 texels.
double worstError(const ChartPicture& small, const ChartPicture& whole) {
  double worst = 0;
  const auto read = [&](const glm::dvec2& at) {
    const glm::dvec2 from = at - 0.5 + double(kChartBorder), low = glm::floor(from);
    glm::dvec3 sum(0);
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) {
        const glm::dvec2 weight = glm::abs(glm::dvec2(1 - i, 1 - j) - (from - low));
        sum += weight.x * weight.y *
               glm::dvec3(small.image.at(std::min(int(low.x) + i, small.image.width - 1),
                                         std::min(int(low.y) + j, small.image.height - 1)));
      }
    return sum;
  };
  for (int top = 0; top < whole.image.height; top += 8)
    for (int left = 0; left < whole.image.width; left += 8) {
      double sum = 0;
      int values = 0;
      for (int y = top; y < std::min(top + 8, whole.image.height); ++y)
        for (int x = left; x < std::min(left + 8, whole.image.width); ++x) {
          const glm::dvec2 metres = (glm::dvec2(x, y) - double(kChartBorder) + 0.5) / whole.texelsPerMetre;
          const glm::dvec3 apart = read(metres * small.texelsPerMetre) - glm::dvec3(whole.image.at(x, y));
          sum += glm::dot(apart, apart), values += 3;
        }
      worst = std::max(worst, std::sqrt(sum / values));
    }
  return worst;
}

TEST(ChartPicture, ShrinksToWhatShowsTheSame) {
  const auto shrink = [](const ChartPicture& picture) {
    return shrunk(picture, std::vector<char>(picture.image.pixels.size(), 1));
  };
  const ChartPicture flat =
      shrink(pictureOf(100, 60, [](double, double) { return glm::dvec3(40, 80, 120); }));
  EXPECT_EQ(flat.size(), glm::ivec2(1));
  EXPECT_EQ(flat.image.at(0, 0), Rgba8(40, 80, 120, 255));

  const ChartPicture stripes =
      shrink(pictureOf(64, 64, [](double x, double) { return glm::dvec3(int(x) % 2 == 0 ? 200 : 50); }));
  EXPECT_EQ(stripes.size(), glm::ivec2(64, 1));

  for (const double waves : {0.02, 0.06, 0.15}) {
    const ChartPicture whole = pictureOf(127, 90, [&](double x, double y) {
      return glm::dvec3(128 + 100 * std::sin(waves * x), 100 + 40 * std::cos(waves * (x + y)), 60 + y / 2);
    });
    const ChartPicture small = shrink(whole);
    EXPECT_LT(small.size().x, 127) << waves;
    EXPECT_LE(worstError(small, whole), kShrinkError + 0.01) << waves;
    EXPECT_NEAR(small.size().x / small.texelsPerMetre.x, 1.27, 1.0 / small.texelsPerMetre.x);
  }
}

TEST(ChartPicture, WhatIsNotShownDoesNotCount) {
  ChartPicture picture = pictureOf(32, 32, [](double, double) { return glm::dvec3(100); });
  std::vector<char> shown(picture.image.pixels.size(), 1);
  for (int y = 20; y < 22; ++y)
    for (int x = 20; x < 22; ++x) picture.image.at(x, y) = Rgba8(255);
  EXPECT_EQ(shrunk(picture, shown).size(), glm::ivec2(32)) << "a spark stays";
  for (int y = 19; y < 23; ++y)  // and those that filters read them for
    for (int x = 19; x < 23; ++x) shown[std::size_t(y * picture.image.width + x)] = 0;
  EXPECT_LT(shrunk(picture, shown).size().x, 32);
}

}  // namespace
}  // namespace acentric
