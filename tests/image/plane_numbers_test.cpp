#include "engine/image/plane_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <tuple>

#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

constexpr double kStep = 0x1p-12;

ColumnCamera camera() { return {{2, 1, 1.6}, 0.3, kPi / 4, radians(60), radians(-70), 300, 400}; }

/// Planes at random, each with a few samples near a pixel at random, where its ray meets them; every tenth
/// reaches far.
CaptureSamples scattered(int planes) {
  std::mt19937 random(7);
  const auto pick = [&](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  };
  struct Sample {
    int column, row;
    std::uint32_t plane;
    float inverseDistance;
  };
  const ColumnCamera columns = camera();
  std::vector<Sample> all;
  CaptureSamples out;
  for (int k = 0; k < planes; ++k) {
    const double size = std::exp2(pick(-5, 3));
    const glm::dvec3 normal = size * glm::normalize(glm::dvec3(pick(-1, 1), pick(-1, 1), pick(-1, 1)));
    out.planes.push_back({glm::vec3(normal), std::uint32_t(k % 2)});
    const double reach = k % 10 == 0 ? 300 : pick(0, 6);
    const double column = pick(0, 300), row = pick(0, 400);
    for (int n = 0; n < 1 + k % 5; ++n) {
      const int c = std::clamp(int(column + pick(-reach, reach)), 0, 299);
      const int r = std::clamp(int(row + pick(-reach, reach)), 0, 399);
      const double met =
          out.planes.back().inverseDistance(columns.directionAt(c + 0.5), columns.tangentAt(r + 0.5));
      all.push_back({c, r, std::uint32_t(k), storedInverseDistance(std::max(met, 0.01), kStep)});
    }
  }
  std::ranges::stable_sort(all, [](const Sample& a, const Sample& b) {
    return std::tuple(a.column, a.row, -a.inverseDistance) < std::tuple(b.column, b.row, -b.inverseDistance);
  });
  for (int column = 0; column <= 300; ++column)
    out.columnStart.push_back(
        std::uint32_t(std::ranges::lower_bound(all, column, {}, &Sample::column) - all.begin()));
  for (const Sample& sample : all)
    out.row.push_back(std::uint16_t(sample.row)), out.plane.push_back(sample.plane),
        out.inverseDistance.push_back(sample.inverseDistance);
  return out;
}

TEST(PlaneNumbers, LeavePlanesWithinAStepOfTheirSamplesEverywhere) {
  CaptureSamples exact = scattered(2000), rounded = exact;
  const ColumnCamera columns = camera();
  roundPlanes(rounded, columns, kStep);
  int changed = 0;
  for (std::size_t column = 0; column < 300; ++column)
    for (std::uint32_t i = exact.columnStart[column]; i < exact.columnStart[column + 1]; ++i)
      for (const double x : {0.0, 0.5, 1.0})
        for (const double y : {0.0, 0.5, 1.0}) {
          const auto at = [&](const CaptureSamples& list) {
            return list.planes[list.plane[i]].inverseDistance(columns.directionAt(double(column) + x),
                                                              columns.tangentAt(list.row[i] + y));
          };
          ASSERT_NEAR(at(exact), at(rounded), 1.6 * planeStep(kStep)) << exact.plane[i];
        }
  for (std::size_t k = 0; k < exact.planes.size(); ++k) {
    EXPECT_EQ(exact.planes[k].away, rounded.planes[k].away);
    changed += exact.planes[k].normal != rounded.planes[k].normal;
  }
  EXPECT_GT(changed, 1900);
}

TEST(PlaneNumbers, TellRoundedPlanesExactly) {
  CaptureSamples samples = scattered(2000);
  const ColumnCamera columns = camera();
  roundPlanes(samples, columns, kStep);
  const std::vector<PlaneReach> reaches = planeReaches(samples);
  int told = 0;
  for (std::size_t k = 0; k < reaches.size(); ++k) {
    const PlaneFrame frame(columns.directionAt(reaches[k].column + 0.5),
                           columns.tangentAt(reaches[k].row + 0.5), planeStep(kStep));
    const PlaneScale scale = reaches[k].scale(columns);
    const auto numbers = frame.exactNumbersOf(samples.planes[k], scale);
    if (!numbers) continue;
    ++told;
    EXPECT_EQ(frame.planeAt(*numbers, scale).normal, samples.planes[k].normal);
  }
  EXPECT_GT(told, 1900);
  CaptureSamples again = samples;
  roundPlanes(again, columns, kStep);
  EXPECT_EQ(again, samples);
}

TEST(PlaneNumbers, TellWhereSamplesAre) {
  const CaptureSamples exact = scattered(2000);
  CaptureSamples placed = exact;
  const ColumnCamera columns = camera();
  roundPlanes(placed, columns, kStep);
  int moved = 0, told = 0;
  for (std::size_t column = 0; column < 300; ++column)
    for (std::uint32_t i = placed.columnStart[column]; i < placed.columnStart[column + 1]; ++i) {
      const float was = exact.inverseDistance[i], is = placed.inverseDistance[i];
      const double met = placed.planes[placed.plane[i]].inverseDistance(
          columns.directionAt(double(column) + 0.5), columns.tangentAt(placed.row[i] + 0.5));
      EXPECT_LE(std::abs(is - was), 3 * std::max(kStep, was * 0x1p-15));
      EXPECT_EQ(is, storedInverseDistance(is, kStep)) << "of those that can be stored";
      const bool first = i == placed.columnStart[column] || placed.row[i] != placed.row[i - 1];
      if (!first) {
        EXPECT_LE(is, placed.inverseDistance[i - 1]) << "nearest first";
      }
      moved += is != was, told += is == storedInverseDistance(met, kStep);
    }
  EXPECT_GT(moved, 50);
  EXPECT_GT(told, int(0.4 * double(exact.row.size()))) << "all but the half that is behind the camera";
}

TEST(PlaneNumbers, LeaveSamplesOffTheirPlanesAndTheSkyInMirrors) {
  CaptureSamples one;
  one.columnStart = {0, 3}, one.row = {3, 4, 5}, one.inverseDistance = {2, 0.5f, 0}, one.plane = {0, 0, 0};
  one.planes = {{glm::vec3(0)}};
  ColumnCamera columns = camera();
  columns.columns = 1;
  const std::vector<float> were = one.inverseDistance;
  placeOnPlanes(one, columns, kStep);
  EXPECT_EQ(one.inverseDistance, were);
}

TEST(PlaneNumbers, AreSmallWhereSamplesLieCloseTogether) {
  CaptureSamples one;
  one.columnStart = {0, 1, 1}, one.row = {100}, one.inverseDistance = {1}, one.plane = {0},
  one.planes = {{{0.5f, 0.3f, 0.1f}}};
  ColumnCamera columns = camera();
  columns.columns = 2, columns.fovRadians /= 150;
  const PlaneScale near = planeReaches(one)[0].scale(columns);
  EXPECT_GE(near.across, 7) << "1/382 of a radian a pixel";
  EXPECT_GE(near.down, 5);
  one.columnStart = {0, 2, 3}, one.row = {100, 390, 120}, one.plane = {0, 0, 0};
  const PlaneScale far = planeReaches(one)[0].scale(columns);
  EXPECT_LT(far.down, near.down);
}

TEST(PlaneNumbers, PlanesThatTheyCannotTellStay) {
  const float huge = 3e38f, nan = std::nanf("");
  for (const glm::vec3& normal :
       {glm::vec3(huge, 0, huge), glm::vec3(0), glm::vec3(nan, 0, 1), glm::vec3(1e-20f)}) {
    CaptureSamples one;
    one.columnStart = {0, 1}, one.row = {3}, one.inverseDistance = {1}, one.plane = {0};
    one.planes = {{normal}, {{1, 2, 3}}};
    ColumnCamera columns = camera();
    columns.columns = 1;
    CaptureSamples rounded = one;
    roundPlanes(rounded, columns, kStep);
    EXPECT_EQ(std::memcmp(&rounded.planes[0], &one.planes[0], sizeof(SurfacePlane)), 0);
    EXPECT_EQ(rounded.planes[1], one.planes[1]) << "no sample is on it";
    roundPlanes(rounded, columns, 0);
    EXPECT_EQ(std::memcmp(&rounded.planes[0], &one.planes[0], sizeof(SurfacePlane)), 0);
  }
}

}  // namespace
}  // namespace acentric
