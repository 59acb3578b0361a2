#include "engine/image/keep_samples.h"

#include <gtest/gtest.h>

#include <random>
#include <tuple>

namespace acentric {
namespace {

constexpr int kColumns = 12, kRows = 9;

/// With silhouettes, runs of the background and, in some rounds, a mirror; all of them needed at random.
Capture randomCapture(std::mt19937& random, bool mirrors) {
  Capture capture;
  capture.camera = {{1, 2, 1.6}, 0.5, 1.0, 0.6, -0.6, kColumns, kRows};
  capture.planeTolerance = 0.01;
  BackgroundBuilder background;
  for (CaptureSamples* list : {static_cast<CaptureSamples*>(&capture), &capture.reflections}) {
    if (list == &capture.reflections && !mirrors) break;
    list->columnStart = {0};
    for (int column = 0; column < kColumns; ++column) {
      for (int row = 0; row < kRows; ++row) {
        const std::uint32_t layers = random() % 3;
        for (std::uint32_t layer = 0; layer < layers; ++layer) {
          list->row.push_back(std::uint16_t(row));
          list->inverseDistance.push_back(0.5f / float(1 + layer));
          list->colour.push_back(packColour(glm::vec4(float(random() % 100) / 50, 0, 0, 1)));
          list->roles.push_back(std::uint8_t(1 + random() % 255));
          list->coverage.push_back(std::uint16_t(1 + random() % 0xffff));
          list->plane.push_back(std::uint32_t(list->planes.size()));
          list->planes.push_back({{float(random() % 100), 0, 1}, 0});
          if (mirrors) list->mirror.push_back(list == &capture ? std::uint8_t(random() % 2) : 1);
        }
        if (list == &capture && random() % 2) background.add(row, std::uint8_t(1 + random() % 255));
      }
      list->columnStart.push_back(std::uint32_t(list->row.size()));
      if (list == &capture) background.closeColumn();
    }
  }
  capture.background = std::move(background).finish({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}});
  return capture;
}

using Told = std::vector<std::tuple<int, int, float, std::uint16_t, std::uint8_t, glm::vec3>>;

/// Of a list what the roles need, one sample after the other.
Told neededOf(const CaptureSamples& samples, std::uint8_t roles) {
  Told told;
  for (std::size_t column = 0; column + 1 < samples.columnStart.size(); ++column)
    for (std::size_t i = samples.columnStart[column]; i < samples.columnStart[column + 1]; ++i)
      if ((samples.roles[i] & roles) != 0)
        told.emplace_back(int(column), samples.row[i], samples.inverseDistance[i], samples.coverage[i],
                          std::uint8_t(samples.roles[i] & roles), samples.planes[samples.plane[i]].normal);
  return told;
}

std::vector<int> needOf(const CaptureBackground& background, std::uint8_t roles) {
  std::vector<int> pixels(kColumns * kRows);
  for (std::size_t column = 0; column + 1 < background.columnStart.size(); ++column)
    for (std::size_t i = background.columnStart[column]; i < background.columnStart[column + 1]; ++i)
      for (std::size_t row = background.firstRow[i]; row < background.endRow[i]; ++row)
        pixels[column * kRows + row] = background.roles[i] & roles;
  return pixels;
}

TEST(KeepRoles, LeavesJustWhatTheseRolesNeed) {
  std::mt19937 random(17);
  for (int round = 0; round < 60; ++round) {
    const Capture all = randomCapture(random, round % 2 == 0);
    ASSERT_TRUE(all.check()) << all.check().error().describe();
    const auto roles = std::uint8_t(round % 3 == 0 ? 1u << (random() % 8) : random() % 256);
    Capture few = all;
    keepRoles(few, roles);
    ASSERT_TRUE(few.check()) << few.check().error().describe();
    EXPECT_EQ(neededOf(few, 0xff), neededOf(all, roles));
    EXPECT_EQ(neededOf(few.reflections, 0xff), neededOf(all.reflections, roles));
    EXPECT_EQ(needOf(few.background, 0xff), needOf(all.background, roles));
  }
}

TEST(KeepRoles, OfAllRolesChangesNothing) {
  std::mt19937 random(18);
  const Capture all = randomCapture(random, true);
  Capture same = all;
  keepRoles(same, 0xff);
  EXPECT_EQ(same, all);
}

TEST(KeepRoles, OfNoneLeavesAnEmptyCapture) {
  std::mt19937 random(19);
  Capture none = randomCapture(random, true);
  keepRoles(none, 0);
  ASSERT_TRUE(none.check()) << none.check().error().describe();
  EXPECT_EQ(none.sampleCount() + none.background.runCount(), 0u);
  EXPECT_FALSE(none.hasReflections());
}

}  // namespace
}  // namespace acentric
