#include "engine/view/warp_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/view/kernels.h"
#include "engine/view/splats.h"
#include "engine/view/walk_scene.h"

namespace acentric {
namespace {

TEST(ProjectSamples, GivesTheSameBitsWhateverTheProcessor) {
  std::mt19937 random(21);
  int wholes = 0, others = 0;
  const auto uniform = [&](float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
  };
  std::vector<float> tangents(300);
  for (float& t : tangents) t = uniform(-2, 2);
  for (int round = 0; round < 6000; ++round) {
    ProjectColumn column{};
    for (int i = 0; i < 3; ++i)
      column.a[i] = uniform(-300, 300), column.z[i] = uniform(-300, 300), column.b[i] = uniform(-300, 300);
    for (float* p : {column.a, column.z, column.b}) p[2] /= 300;
    column.maxInverseDistance = round % 3 == 0 ? 0.5f : std::numeric_limits<float>::infinity();
    column.footprint = round % 5 == 0 ? 0 : uniform(0, 20);
    column.maxSide = 16;
    column.roles = round % 4 == 0 ? 0xffu : std::uint32_t(random() % 256);
    column.centreX = 320, column.centreY = 200, column.inverseFocal = 1 / uniform(100, 500);
    column.x0 = 0, column.y0 = 50, column.x1 = 640, column.y1 = 300;
    column.slot = 1 + random() % kMaxSlots;
    column.partTest = static_cast<PartTest>(round % 3);
    for (float* p : {column.direction, column.baseline, column.low, column.high})
      p[0] = uniform(-1, 1), p[1] = uniform(-1, 1);
    const int count = 1 + round % 70;
    std::vector<PackedSample> samples;
    const std::size_t rowStep = 1 + random() % 6;
    for (int i = 0; i < count; ++i) {
      const std::size_t next = samples.empty() ? random() % 50 : samples.back().row + random() % rowStep;
      const float specials[] = {0, 1e30f, std::numeric_limits<float>::infinity(), std::nanf(""), 1e-40f};
      const auto roles = static_cast<std::uint8_t>(random());
      samples.push_back(packSample(random() % 8 == 0 ? specials[random() % 5] : uniform(0, 1), roles,
                                   std::uint32_t(std::min(next, tangents.size() - 1))));
    }
    std::vector<Rgba8> colour;
    for (int i = 0; i < count; ++i)
      colour.push_back(
          colourOf((random() & 0xffffffu) | (i % 5 == 0 ? random() & 0xff000000u : 0xff000000u)));
    const auto project = [&](const Kernels& kernels, SplatMemory& memory) {
      const SplatArrays& splats = memory.room(samples.size());
      return kernels.project(column, sampleColumn(tangents.data(), samples.data(), colour.data()),
                             std::uint32_t(count), splats);
    };
    SplatMemory expectedMemory;
    const int expected = project(supportedKernels().front(), expectedMemory);
    const SplatArrays& e = expectedMemory.room(0);
    for (int i = 0; i < expected; ++i) {
      const Splat a = splatAt(e, i);
      ASSERT_NE(rolesOf(samples[a.index]) & column.roles, 0u);
      EXPECT_GE(a.side, 1);
      EXPECT_LE(a.side, 16);
      EXPECT_EQ(static_cast<std::uint32_t>(a.pixel),
                (wordOf(colour[a.index]) & 0xffffffu) | column.slot << 24);
      const bool whole = a.side <= 2 && a.x >= column.x0 && a.y >= column.y0 && a.x + a.side <= column.x1 &&
                         a.y + a.side <= column.y1 && colour[a.index].a == 255;
      ASSERT_EQ(e.steps[i] != 0, whole);
      wholes += whole;
      others += !whole;
    }
    for (const Kernels& kernels : supportedKernels().subspan(1)) {
      SplatMemory memory;
      ASSERT_EQ(project(kernels, memory), expected) << kernels.name;
      const SplatArrays& got = memory.room(0);
      const auto same = [&](const auto* a, const auto* b) { return std::equal(a, a + expected, b); };
      EXPECT_TRUE(same(got.pixels, e.pixels) && same(got.steps, e.steps) && same(got.firsts, e.firsts) &&
                  same(got.corners, e.corners) && same(got.sides, e.sides) && same(got.indices, e.indices))
          << kernels.name << ", round " << round;
    }
  }
  EXPECT_GT(wholes, 300);
  EXPECT_GT(others, 300);
}

}  // namespace
}  // namespace acentric
