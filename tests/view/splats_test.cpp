#include "engine/view/splats.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace acentric {
namespace {

template <class T>
void fill(ProjectColumn<T>& column, const ProjectColumn<double>& from) {
  const auto copy = [](const auto& a, auto& b) {
    for (std::size_t i = 0; i < std::size(b); ++i) b[i] = static_cast<T>(a[i]);
  };
  copy(from.a, column.a), copy(from.z, column.z), copy(from.b, column.b);
  copy(from.direction, column.direction), copy(from.baseline, column.baseline);
  copy(from.low, column.low), copy(from.high, column.high);
  column.maxInverseDistance = static_cast<T>(from.maxInverseDistance);
  column.minInverseDistance = static_cast<T>(from.minInverseDistance);
  column.footprint = static_cast<T>(from.footprint), column.maxSide = static_cast<T>(from.maxSide);
  column.roles = from.roles, column.canvas = from.canvas;
  column.centreX = static_cast<T>(from.centreX), column.centreY = static_cast<T>(from.centreY);
  column.inverseFocal = static_cast<T>(from.inverseFocal);
  column.slot = from.slot, column.partTest = from.partTest;
}

TEST(ProjectSamples, GivesTheSamplesThatTouchTheCanvasInFloatsAsInDoubles) {
  std::mt19937 random(21);
  int all = 0, differ = 0;
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<float> tangents(300);
  for (float& t : tangents) t = static_cast<float>(uniform(-2, 2));
  const std::vector<double> preciseTangents(tangents.begin(), tangents.end());
  for (int round = 0; round < 3000; ++round) {
    ProjectColumn<double> precise{};
    for (int i = 0; i < 3; ++i)
      precise.a[i] = uniform(-300, 300), precise.z[i] = uniform(-300, 300), precise.b[i] = uniform(-300, 300);
    for (double* p : {precise.a, precise.z, precise.b}) p[2] /= 300;
    precise.maxInverseDistance = round % 3 == 0 ? 0.5 : std::numeric_limits<double>::infinity();
    precise.minInverseDistance = round % 7 == 0 ? 0.2 : 0;
    precise.footprint = round % 5 == 0 ? 0 : uniform(0, 20);
    precise.maxSide = 16;
    precise.roles = round % 4 == 0 ? 0xffu : std::uint32_t(random() % 256);
    precise.centreX = 320, precise.centreY = 200, precise.inverseFocal = 1 / uniform(100, 500);
    precise.canvas = {0, 50, 640, 300};
    precise.slot = 1 + random() % kMaxSlots;
    precise.partTest = static_cast<PartTest>(round % 3);
    for (double* p : {precise.direction, precise.baseline, precise.low, precise.high})
      p[0] = uniform(-1, 1), p[1] = uniform(-1, 1);
    ProjectColumn<float> column{};
    fill(column, precise);
    std::vector<PackedSample> samples;
    std::vector<Rgba8> colour;
    const std::size_t rowStep = 1 + random() % 6;
    for (int i = 0; i < 1 + round % 70; ++i) {
      const std::size_t next = samples.empty() ? random() % 50 : samples.back().row + random() % rowStep;
      const float specials[] = {0, 1e30f, std::numeric_limits<float>::infinity(), std::nanf(""), 1e-40f};
      samples.push_back(packSample(
          random() % 8 == 0 ? specials[random() % 5] : static_cast<float>(uniform(0, 1)),
          static_cast<std::uint8_t>(random()), std::uint32_t(std::min(next, tangents.size() - 1))));
      colour.push_back(colourOf(static_cast<std::uint32_t>(random())));
    }
    std::vector<Splat> memory, preciseMemory;
    const auto splats = projectSamples(column, {tangents.data(), samples, colour.data()}, memory);
    const auto expected =
        projectSamples(precise, {preciseTangents.data(), samples, colour.data()}, preciseMemory);
    std::size_t next = 0;
    for (const Splat& splat : splats) {
      const PackedSample& sample = samples[splat.index];
      ASSERT_NE(rolesOf(sample) & column.roles, 0u);
      ASSERT_LE(inverseDistanceOf(sample), column.maxInverseDistance);
      ASSERT_GE(inverseDistanceOf(sample), column.minInverseDistance);
      ASSERT_GE(splat.side, 1);
      ASSERT_LE(splat.side, 16);
      ASSERT_TRUE(splat.x < 640 && splat.x + splat.side > 0 && splat.y < 300 && splat.y + splat.side > 50);
      ASSERT_EQ(static_cast<std::uint32_t>(splat.pixel),
                (wordOf(colour[splat.index]) & 0xffffffu) | column.slot << 24);
      ASSERT_TRUE(&splat == splats.data() || (&splat)[-1].index < splat.index);
      while (next < expected.size() && expected[next].index < splat.index) ++next;
      const bool same = next < expected.size() && expected[next].index == splat.index &&
                        expected[next].x == splat.x && expected[next].y == splat.y &&
                        expected[next].side == splat.side;
      ++all, differ += !same;
      if (same && std::abs(inverseZDepthOf(expected[next].pixel)) < 100) {
        ASSERT_NEAR(inverseZDepthOf(splat.pixel), inverseZDepthOf(expected[next].pixel), 0.05);
      }
    }
  }
  EXPECT_GT(all, 1000);
  EXPECT_LT(differ, all / 50);
}

}  // namespace
}  // namespace acentric
