#include "engine/view/warp_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <ranges>
#include <span>

#include "engine/geometry/conventions.h"
#include "engine/view/kernels.h"
#include "engine/view/open_tiles.h"
#include "engine/view/picture_axes.h"
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
    std::vector<SampleRun> runs{{0, std::uint32_t(count)}};
    if (count > 20) runs = {{1, 18}, {19, std::uint32_t(count)}};
    std::vector<Rgba8> colour;
    for (int i = 0; i < count; ++i)
      colour.push_back(
          colourOf((random() & 0xffffffu) | (i % 5 == 0 ? random() & 0xff000000u : 0xff000000u)));
    const auto project = [&](const Kernels& kernels, SplatMemory& memory) {
      const SplatArrays& splats = memory.room(samples.size());
      return kernels.project(column, sampleColumn(tangents.data(), samples.data(), colour.data()),
                             runs.data(), int(runs.size()), splats);
    };
    SplatMemory expectedMemory;
    const int expected = project(supportedKernels().front(), expectedMemory);
    const SplatArrays& e = expectedMemory.room(0);
    for (int i = 0; i < expected; ++i) {
      const Splat a = splatAt(e, i);
      ASSERT_NE(rolesOf(samples[a.index]) & column.roles, 0u);
      ASSERT_TRUE(count <= 20 || (a.index != 0 && a.index != 18)) << "in no run";
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

TEST(FindBlocks, LeavesOutNoneThatReachesAnOpenPixelAndIsTheSameWhateverTheProcessor) {
  std::mt19937 random(5);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  constexpr int kBlocks = 37, kPerBlock = 6, kTableRows = kBlocks * kPerBlock;
  const std::vector<Rgba8> colour(kTableRows);
  std::vector<float> tangents(kTableRows);
  for (int row = 0; row < kTableRows; ++row)
    tangents[std::size_t(row)] = float(std::tan(1.3 - row * 2.6 / kTableRows));
  int reached = 0, found = 0, hidden = 0;
  for (int round = 0; round < 1500; ++round) {
    PerspectiveView view;
    view.width = 640, view.height = 360;
    view.yawRadians = uniform(0, kTwoPi), view.pitchRadians = uniform(-1.5, 1.5);
    view.fovRadians = radians(uniform(20, 130));
    const PictureAxes axes(view);
    const PixelRect rect{160, 0, 400, 360};
    constexpr int kMaxSide = 16;
    const glm::dvec3 baseline(uniform(-3, 3), uniform(-3, 3), round % 3 == 0 ? 0 : uniform(-1, 1));
    const glm::dvec2 direction =
        directionOf(round % 4 == 0 ? uniform(0, kTwoPi) : view.yawRadians + uniform(-1, 1));
    ProjectColumn column{};
    axes.project(glm::dvec3(direction, 0), column.a);
    axes.project(glm::dvec3(0, 0, 1), column.z);
    axes.project(baseline, column.b);
    column.footprint = float(view.focalPixels() * uniform(0, 0.01));
    column.maxSide = kMaxSide;
    column.roles = 2;
    column.centreX = 320, column.centreY = 180, column.inverseFocal = float(1 / view.focalPixels());
    column.x0 = rect.x0, column.y0 = rect.y0, column.x1 = rect.x1, column.y1 = rect.y1;
    column.maxInverseDistance = round % 2 == 0 ? std::numeric_limits<float>::infinity() : 0.7f;
    column.minInverseDistance = round % 5 == 0 ? 0.1f : 0;

    std::vector<PackedSample> samples;
    SampleBlocks blocks;
    for (std::size_t b = 0; b < kBlocks; ++b) {
      const double near = uniform(0, 2), spread = b % 3 == 0 ? uniform(0, 2) : 0.02;
      for (std::size_t i = b * kPerBlock; i < (b + 1) * kPerBlock; ++i)
        samples.push_back(packSample(float(near + uniform(0, spread)),
                                     b % 11 == 0 ? 1 : std::uint8_t(1 + random() % 3), std::uint32_t(i)));
      const auto own = std::span(samples).last(kPerBlock);
      const auto [least, most] = std::ranges::minmax(own | std::views::transform(inverseDistanceOf));
      blocks.leastInverse.push_back(least), blocks.mostInverse.push_back(most);
      blocks.highTangent.push_back(tangents[b * kPerBlock]);
      blocks.lowTangent.push_back(tangents[(b + 1) * kPerBlock - 1]);
      blocks.roles.push_back(b % 11 == 0 ? 1 : 3);
    }
    for (auto* v : {&blocks.leastInverse, &blocks.mostInverse, &blocks.highTangent, &blocks.lowTangent})
      v->resize(v->size() + kSampleRoom);
    blocks.roles.resize(blocks.roles.size() + kSampleRoom, 3);

    CoverImage cover(view.width, view.height, 0);
    for (int n = 0; n < 60; ++n)
      cover.at(int(random() % unsigned(view.width)), int(random() % unsigned(view.height))) = kUncovered;
    const OpenTiles open(rect, &cover, 0);
    BlockTest test{};
    const FrustumPlanes planes = frustumPlanes(view, rect, splatMargin(kMaxSide));
    for (std::size_t i = 0; i < 5; ++i) {
      test.a[i] = float(glm::dot(glm::dvec2(planes.normals[i]), direction) + 1e-5);
      test.z[i] = float(planes.normals[i].z), test.b[i] = float(glm::dot(planes.normals[i], baseline));
    }
    test.slack = 1e-5f;
    if (round % 2 == 1) open.tell(test);

    const auto blocksOf = [&](const Kernels& kernels) {
      std::vector<std::uint16_t> out(kBlocks);
      out.resize(std::size_t(
          kernels.findBlocks(column, test,
                             {blocks.leastInverse.data(), blocks.mostInverse.data(), blocks.lowTangent.data(),
                              blocks.highTangent.data(), blocks.roles.data()},
                             kBlocks, out.data())));
      return out;
    };
    const std::vector<std::uint16_t> got = blocksOf(supportedKernels().front());
    for (const Kernels& kernels : supportedKernels()) EXPECT_EQ(blocksOf(kernels), got) << kernels.name;
    found += int(got.size());
    const SampleRun all{0, kTableRows};
    SplatMemory memory;
    const SplatArrays& splats = memory.room(kTableRows);
    const int count = projectSamplesScalar(
        column, sampleColumn(tangents.data(), samples.data(), colour.data()), &all, 1, splats);
    for (int i = 0; i < count; ++i) {
      const Splat splat = splatAt(splats, i);
      bool reaches = test.openTiles == nullptr;
      for (int x = std::max(splat.x, rect.x0); !reaches && x < std::min(splat.x + splat.side, rect.x1); ++x)
        for (int y = std::max(splat.y, 0); y < std::min(splat.y + splat.side, rect.y1); ++y)
          reaches = reaches || cover.at(x, y) == kUncovered;
      const bool kept = std::ranges::binary_search(got, std::uint16_t(splat.index / kPerBlock));
      reached += reaches;
      hidden += !kept;
      ASSERT_TRUE(kept || !reaches) << "round " << round << ", block " << splat.index / kPerBlock;
    }
  }
  EXPECT_GT(reached, 4000);
  EXPECT_GT(hidden, 1500) << "samples on the picture, but on no open pixel";
  EXPECT_LT(found, 1500 * kBlocks / 3);
}

}  // namespace
}  // namespace acentric
