#include "engine/image/patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <set>

#include "engine/geometry/conventions.h"
#include "engine/image/sharpen.h"

namespace acentric {
namespace {

constexpr double kTolerance = 1e-4;

/// A capture of planes that some predicate tells the extents of, in a camera of one sample per quarter of a
/// degree.
class CaptureOfPlanes {
 public:
  struct Plane {
    SurfacePlane plane;
    std::function<bool(int, int)> holds;  ///< column, row
    std::uint8_t mirror = 0;
    bool blended = false;
    std::uint8_t roles = 1;
  };
  explicit CaptureOfPlanes(const std::vector<Plane>& planes) {
    for (const Plane& plane : planes) capture_.planes.push_back(plane.plane);
    capture_.columnStart.push_back(0);
    for (int column = 0; column < camera_.columns; ++column) {
      for (int row = 0; row < camera_.rows; ++row) {
        std::vector<std::pair<double, std::uint32_t>> met;
        for (std::uint32_t i = 0; i < planes.size(); ++i)
          if (planes[i].holds(column, row)) met.emplace_back(inverseAt(planes[i].plane, column, row), i);
        std::ranges::sort(met, std::greater<>());
        for (const auto& [inverse, i] : met) {
          capture_.row.push_back(std::uint16_t(row));
          capture_.inverseDistance.push_back(float(inverse));
          capture_.colour.push_back(packColour({1, 1, 1, planes[i].blended ? 0.5 : 1}));
          capture_.roles.push_back(planes[i].roles);
          capture_.mirror.push_back(planes[i].mirror);
          capture_.coverage.push_back(kWholePixel);
          capture_.plane.push_back(i);
        }
      }
      capture_.columnStart.push_back(std::uint32_t(capture_.row.size()));
    }
    patches_ = makePatches(camera_, capture_, kTolerance);
  }

  double inverseAt(const SurfacePlane& plane, int column, int row) const {
    return plane.inverseDistance(camera_.directionAt(column + 0.5), camera_.tangentAt(row + 0.5));
  }
  const ColumnCamera& camera() const { return camera_; }
  const CaptureSamples& samples() const { return capture_; }
  const Patches& patches() const { return patches_; }
  /// Places of patches of a plane in the order of their strips.
  std::vector<std::size_t> placesOf(std::uint32_t plane) const {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < patches_.patches.size(); ++i)
      if (capture_.plane[patches_.samples[patches_.patches[i].firstSample]] == plane) places.push_back(i);
    return places;
  }

 private:
  ColumnCamera camera_{{0, 0, 1.5}, radians(-10.0), radians(20.0), radians(15.0), radians(-15.0), 80, 120};
  CaptureSamples capture_;
  Patches patches_;
};

/// A plane in front, `distance` away, turned about the vertical.
SurfacePlane wall(double distance, double turn = 0) {
  return {glm::vec3(std::cos(turn), std::sin(turn), 0) / float(distance * std::cos(turn)), 0};
}
bool everywhere(int, int) { return true; }

TEST(Patches, HoldEverySampleOnceAndInTheirRectangle) {
  const CaptureOfPlanes of(
      {{wall(4), everywhere},
       {wall(3, 0.3), [](int c, int r) { return (c - 40) * (c - 40) + (r - 50) * (r - 50) < 300; }},
       {wall(2), [](int c, int r) { return c % 16 == 0 && r > 20; }, 0, true}});
  const Patches& patches = of.patches();
  std::set<std::uint32_t> seen(patches.samples.begin(), patches.samples.end());
  EXPECT_EQ(seen.size(), of.samples().sampleCount());
  EXPECT_EQ(patches.samples.size(), of.samples().sampleCount());
  EXPECT_EQ(patches.stripStart.front(), 0u);
  EXPECT_EQ(patches.stripStart.back(), patches.patches.size());
  for (std::size_t strip = 0; strip < patches.strips(); ++strip)
    for (std::size_t i = patches.stripStart[strip]; i < patches.stripStart[strip + 1]; ++i) {
      const Patch& patch = patches.patches[i];
      EXPECT_GE(patch.column, int(strip) * patches.stripColumns);
      EXPECT_LE(patch.column + patch.columns, (int(strip) + 1) * patches.stripColumns);
      std::set<std::pair<int, int>> pixels;
      for (std::uint32_t k = patch.firstSample; k < patches.endOf(i); ++k) {
        const std::uint32_t sample = patches.samples[k];
        const int row = of.samples().row[sample];
        const auto& starts = of.samples().columnStart;
        const int column = int(std::ranges::upper_bound(starts, sample) - starts.begin()) - 1;
        EXPECT_TRUE(pixels.emplace(column, row).second) << "two samples of one pixel";
        EXPECT_TRUE(column >= patch.column && column < patch.column + patch.columns);
        EXPECT_TRUE(row >= patch.row && row < patch.row + patch.rows);
        EXPECT_LE(std::abs(of.inverseAt(patch.plane, column, row) - of.samples().inverseDistance[sample]),
                  kTolerance);
      }
    }
}

TEST(Patches, OfOneWallAreTheTilesAlone) {
  const CaptureOfPlanes of({{wall(4), everywhere}});
  // 20 x 30 degrees at 4 samples per degree: strips of 4 degrees, tiles of 8.
  EXPECT_EQ(of.patches().stripColumns, 16);
  EXPECT_EQ(of.patches().patches.size(), 5u * 4);
}

TEST(Patches, OfOneSurfaceThatLooksDifferentToEachRegionAreOneForEach) {
  const CaptureOfPlanes of({{wall(5), everywhere, 0, true, 1}, {wall(5), everywhere, 0, true, 6}});
  for (const Patch& patch : of.patches().patches) EXPECT_TRUE(patch.roles == 1 || patch.roles == 6);
  EXPECT_EQ(of.placesOf(0).size(), of.placesOf(1).size());
}

TEST(Patches, ThatMayHideOthersComeFirst) {
  // A board before a wall, beside each other as the camera sees them: other eyes see them overlap.
  const auto board = [](int c, int) { return c >= 20 && c < 26; };
  const CaptureOfPlanes of({{wall(8), [&](int c, int r) { return !board(c, r); }}, {wall(2), board}});
  const auto boards = of.placesOf(1), walls = of.placesOf(0);
  for (const std::size_t b : boards)
    for (const std::size_t w : walls)
      if (of.patches().patches[b].column / 16 == of.patches().patches[w].column / 16) {
        EXPECT_LT(b, w);
      }
  EXPECT_EQ(of.patches().unordered, 0u);
}

TEST(Patches, ASlantedBoardThatReachesFartherThanTheWallBesideItIsOrderedByItsPlane) {
  // Its nearest point is farther away than that of the wall, and it still hides the wall.
  const CaptureOfPlanes of({{wall(5, -1.2), [](int c, int) { return c < 40; }},
                            {wall(4.6, 0.9), [](int c, int) { return c < 12; }}});
  for (const std::size_t b : of.placesOf(1))
    for (const std::size_t w : of.placesOf(0)) {
      const Patch &board = of.patches().patches[b], &other = of.patches().patches[w];
      if (board.column / 16 != other.column / 16 || board.row != other.row) continue;
      const double at = board.column + board.columns / 2;
      const bool before = of.inverseAt(board.plane, int(at), 60) > of.inverseAt(other.plane, int(at), 60);
      EXPECT_EQ(b < w, before);
    }
}

TEST(Patches, CloserThanTheToleranceAreOrderedAsThePixelsShowThem) {
  // A picture so close before its wall that planes do not tell.
  const SurfacePlane back = wall(5), front = {back.normal * float(1 + 0.1 * kTolerance), 0};
  // Another mirror, so that it is a patch of its own.
  const CaptureOfPlanes of(
      {{back, everywhere}, {front, [](int c, int r) { return c > 3 && c < 14 && r < 30; }, 7}});
  const auto pictures = of.placesOf(1);
  ASSERT_EQ(pictures.size(), 1u);
  for (const std::size_t w : of.placesOf(0))
    if (of.patches().patches[w].column < 16 && of.patches().patches[w].row == 0) {
      EXPECT_LT(pictures[0], w);
    }
}

TEST(Patches, SeenFromTheirOtherSideAreOrderedForEyesThere) {
  // Two walls that eyes look at from behind: for them the farther one comes first.
  SurfacePlane near = wall(2), far = wall(4);
  near.away = far.away = 1;
  const CaptureOfPlanes of({{near, everywhere}, {far, everywhere}});
  for (const std::size_t n : of.placesOf(0))
    for (const std::size_t f : of.placesOf(1)) {
      const Patch &a = of.patches().patches[n], &b = of.patches().patches[f];
      // At the height of the eyes; far above it none of them sees one before the other.
      if (a.column == b.column && a.row == b.row && a.row < 60 && a.row + a.rows > 60) {
        EXPECT_LT(f, n);
      }
    }
}

TEST(Patches, AboveAndBelowAllEyesNeedNoOrder) {
  // Each reaches through the plane of the other.
  const CaptureOfPlanes of({{wall(5, 1.0), [](int, int r) { return r < 60; }},
                            {wall(5, -1.0), [](int, int r) { return r >= 60; }}});
  EXPECT_EQ(of.patches().unordered, 0u);
  const CaptureOfPlanes crossed({{wall(5, 1.0), [](int, int r) { return r < 70; }},
                                 {wall(5, -1.0), [](int, int r) { return r >= 50; }}});
  EXPECT_GT(crossed.patches().unordered, 0u);
}

/// As leaves make them, or a file that is made to take for ever: each sample a patch, more than can be
/// compared with one another.
TEST(Patches, OfLeavesAreOrderedByHowNearTheyAre) {
  const ColumnCamera camera{{0, 0, 1.5}, 0, radians(3.0), radians(40.0), radians(-40.0), 32, 3000};
  CaptureSamples capture;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> distance(3, 9);
  capture.columnStart.push_back(0);
  for (int column = 0; column < camera.columns; ++column) {
    for (int row = 0; row < camera.rows; ++row) {
      const SurfacePlane plane = wall(distance(random));
      capture.row.push_back(std::uint16_t(row));
      capture.inverseDistance.push_back(
          float(plane.inverseDistance(camera.directionAt(column + 0.5), camera.tangentAt(row + 0.5))));
      capture.colour.push_back(packColour({1, 1, 1, 1}));
      capture.roles.push_back(1);
      capture.coverage.push_back(kWholePixel);
      capture.plane.push_back(std::uint32_t(capture.planes.size()));
      capture.planes.push_back(plane);
    }
    capture.columnStart.push_back(std::uint32_t(capture.row.size()));
  }
  const Patches patches = makePatches(camera, capture, 1e-7);
  ASSERT_EQ(patches.samples.size(), capture.sampleCount());
  EXPECT_EQ(std::set<std::uint32_t>(patches.samples.begin(), patches.samples.end()).size(),
            capture.sampleCount());
  ASSERT_EQ(patches.strips(), 1u);
  std::size_t falls = 0;
  for (std::size_t n = 1; n < patches.samples.size(); ++n)
    falls += capture.inverseDistance[patches.samples[n - 1]] >= capture.inverseDistance[patches.samples[n]];
  EXPECT_GT(patches.patches.size(), 90000u);
  EXPECT_GT(falls, patches.samples.size() * 99 / 100);
}

std::vector<Rgba8> sharpened(const CaptureOfPlanes& of, const std::function<float(int, int, int)>& grey) {
  const CaptureSamples& samples = of.samples();
  std::vector<Rgba8> colours;
  for (int column = 0; column < of.camera().columns; ++column)
    for (auto i = samples.columnStart[std::size_t(column)]; i < samples.columnStart[std::size_t(column) + 1];
         ++i)
      colours.emplace_back(glm::vec3(std::round(grey(column, samples.row[i], int(samples.plane[i])))), 255);
  const PixelSamples pixels(samples, of.camera().rows, 0, of.camera().columns);
  return sharpenedColours(of.camera(), samples, pixels, kTolerance, colours);
}

TEST(SharpenedColours, RaiseWhatASampleDiffersByFromNeighboursOnItsSurface) {
  const CaptureOfPlanes of({{wall(4), [](int column, int) { return column < 40; }},
                            {wall(5), [](int column, int) { return column >= 40; }}});
  const int rows = of.camera().rows;
  const auto colours = sharpened(of, [](int column, int row, int) {
    return column >= 40 ? 250 : column == 20 && row == 60 ? 150 : 100;
  });
  const auto at = [&](int column, int row) { return int(colours[std::size_t(column * rows + row)].g); };
  for (int column = 0; column < of.camera().columns; ++column)
    for (int row = 0; row < rows; ++row) {
      const int away = std::abs(column - 20) + std::abs(row - 60);
      ASSERT_EQ(at(column, row), column >= 40 ? 250 : away == 0 ? 162 : away == 1 ? 97 : 100);
    }
}

TEST(SharpenedColours, AreNearerToWhatTheSamplesAreMeansOfWhenInterpolated) {
  const CaptureOfPlanes of({{wall(4), everywhere}});
  constexpr double kPeriod = 5;  // samples
  const auto wave = [](double column) { return 128 + 90 * std::cos(kTwoPi * column / kPeriod); };
  const auto mean = [&](int column) {
    double sum = 0;
    for (int i = 0; i < 32; ++i) sum += wave(column + (i + 0.5) / 32);
    return float(sum / 32);
  };
  const auto colours = sharpened(of, [&](int column, int, int) { return mean(column); });
  double plain = 0, raised = 0;
  for (int column = 2; column + 3 < of.camera().columns; ++column)
    for (int i = 0; i < 8; ++i) {
      const double share = (i + 0.5) / 8, truth = wave(column + 0.5 + share);
      const auto error = [&](double a, double b) { return std::pow(a + (b - a) * share - truth, 2); };
      const auto code = [&](int k) { return double(colours[std::size_t(k * of.camera().rows)].g); };
      plain += error(double(mean(column)), double(mean(column + 1)));
      raised += error(code(column), code(column + 1));
    }
  EXPECT_LT(raised, 0.75 * plain);
}

}  // namespace
}  // namespace acentric
