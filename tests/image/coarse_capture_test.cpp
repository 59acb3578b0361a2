#include "engine/image/coarse_capture.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/store/synthetic_capture.h"

namespace acentric {
namespace {

/// What a pixel holds, layer by layer.
std::vector<std::pair<float, HalfColour>> pixelOf(const CaptureSamples& samples, std::size_t column,
                                                  int row) {
  std::vector<std::pair<float, HalfColour>> layers;
  for (std::size_t i = samples.columnStart[column]; i < samples.columnStart[column + 1]; ++i)
    if (samples.row[i] == row) layers.emplace_back(samples.inverseDistance[i], samples.colour[i]);
  return layers;
}

std::uint8_t backgroundOf(const CaptureBackground& background, std::size_t column, int row) {
  if (background.runCount() == 0) return 0;
  for (std::size_t i = background.columnStart[column]; i < background.columnStart[column + 1]; ++i)
    if (row >= background.firstRow[i] && row < background.endRow[i]) return background.roles[i];
  return 0;
}

TEST(CoarseCapture, HoldsThePixelInTheMiddleOfEachBlockWithAllItsLayers) {
  for (const auto& [columns, rows] : {std::pair{48, 40}, {45, 41}, {3, 2}, {1, 1}}) {
    SyntheticOptions options;
    options.columns = columns;
    options.rows = rows;
    options.layered = options.mirrors = true;
    const Capture whole = syntheticCapture(options);
    const Capture coarse = coarsened(whole, 4);
    EXPECT_TRUE(coarse.check());
    EXPECT_EQ(coarse.camera.columns, (columns + 3) / 4);
    EXPECT_EQ(coarse.camera.rows, (rows + 3) / 4);
    EXPECT_EQ(coarse.camera.fovRadians, whole.camera.fovRadians);
    EXPECT_EQ(coarse.camera.topElevation, whole.camera.topElevation);
    for (int k = 0; k < coarse.camera.columns; ++k)
      for (int r = 0; r < coarse.camera.rows; ++r) {
        const int column = (2 * k + 1) * columns / (2 * coarse.camera.columns);
        const int row = (2 * r + 1) * rows / (2 * coarse.camera.rows);
        EXPECT_LE(std::abs(coarse.camera.azimuthAt(k + 0.5) - whole.camera.azimuthAt(column + 0.5)),
                  0.5001 * whole.camera.columnPitch());
        EXPECT_EQ(pixelOf(coarse, std::size_t(k), r), pixelOf(whole, std::size_t(column), row));
        EXPECT_EQ(backgroundOf(coarse.background, std::size_t(k), r),
                  backgroundOf(whole.background, std::size_t(column), row));
        if (coarse.hasReflections()) {
          EXPECT_EQ(pixelOf(coarse.reflections, std::size_t(k), r),
                    pixelOf(whole.reflections, std::size_t(column), row));
        }
      }
  }
}

TEST(CoarseCapture, AFactorOfOneChangesNothing) {
  SyntheticOptions options;
  options.layered = options.mirrors = true;
  const Capture whole = syntheticCapture(options);
  const Capture same = coarsened(whole, 1);
  EXPECT_EQ(static_cast<const CaptureSamples&>(same), static_cast<const CaptureSamples&>(whole));
  EXPECT_EQ(same.background, whole.background);
  EXPECT_EQ(same.reflections, whole.reflections);
}

/// Two walls that meet between columns, before each other in part of the rows.
Capture twoWalls() {
  Capture capture;
  capture.camera = syntheticCapture({64, 48}).camera;
  capture.planeTolerance = 1.0 / 4096;
  capture.planes = {{{0.5f, 0, 0}, 0}, {{0.25f, 0.1f, 0}, 0}};
  capture.columnStart.push_back(0);
  for (int column = 0; column < 64; ++column) {
    for (int row = 0; row < 48; ++row) {
      const auto add = [&](std::uint32_t plane, float inverse, const glm::vec4& colour) {
        capture.row.push_back(std::uint16_t(row));
        capture.inverseDistance.push_back(inverse);
        capture.colour.push_back(packColour(colour));
        capture.roles.push_back(1);
        capture.coverage.push_back(kWholePixel);
        capture.plane.push_back(plane);
      };
      const bool first = column < 22;
      if (first) add(0, 0.5f, {row % 2 == 0 ? 1.0f : 0.0f, 0, 0, 1});
      if (!first || row < 10) add(1, 0.25f, {0, 0, 1, 1});
    }
    capture.columnStart.push_back(std::uint32_t(capture.sampleCount()));
  }
  return capture;
}

TEST(CoarseCapture, KeepsSilhouettesToAQuarterOfItsPixels) {
  const Capture coarse = coarsened(twoWalls(), 4);
  ASSERT_TRUE(coarse.check()) << coarse.check().error().describe();
  ASSERT_EQ(coarse.camera.columns, 16);
  const auto at = [&](std::size_t column, int row) {
    std::vector<std::pair<std::uint32_t, std::uint16_t>> surfaces;
    for (std::size_t i = coarse.columnStart[column]; i < coarse.columnStart[column + 1]; ++i)
      if (coarse.row[i] == row) surfaces.emplace_back(coarse.plane[i], coarse.coverage[i]);
    return surfaces;
  };
  using Surfaces = std::vector<std::pair<std::uint32_t, std::uint16_t>>;
  EXPECT_EQ(at(5, 6), (Surfaces{{0, 0x3333}, {1, 0xcccc}}));  // columns 20 and 21, 22 and 23
  EXPECT_EQ(at(4, 6), (Surfaces{{0, kWholePixel}}));
  EXPECT_EQ(at(6, 6), (Surfaces{{1, kWholePixel}}));
  EXPECT_EQ(at(4, 2), (Surfaces{{0, kWholePixel}, {1, 0x00ff}}));  // behind it rows 8 and 9
  EXPECT_NEAR(unpackColour(coarse.colour[0]).r, 0.5f, 1e-3f);
}

TEST(CoarseCapture, LeavesNothingOpenThatWasCovered) {
  for (const auto& [columns, rows] : {std::pair{48, 40}, {45, 41}, {3, 2}, {1, 1}})
    for (const int factor : {2, 4, 8}) {
      SyntheticOptions options{columns, rows, true, false};
      options.mirrors = true;
      const Capture whole = withSilhouettes(syntheticCapture(options)), coarse = coarsened(whole, factor);
      ASSERT_TRUE(coarse.check()) << coarse.check().error().describe();
      const int parts = kCoverageParts, across = coarse.camera.columns, down = coarse.camera.rows;
      for (int column = 0; column < parts * across; ++column)
        for (int row = 0; row < parts * down; ++row) {
          const std::size_t fine = std::size_t((2 * column + 1) * columns / (2 * parts * across));
          const bool wasCovered = !pixelOf(whole, fine, (2 * row + 1) * rows / (2 * parts * down)).empty();
          const std::size_t own = std::size_t(column / parts);
          bool covered = false;
          for (std::size_t i = coarse.columnStart[own]; i < coarse.columnStart[own + 1]; ++i)
            covered |= coarse.row[i] == row / parts &&
                       (coarse.coverage[i] >> (parts * (row % parts) + column % parts) & 1) != 0;
          EXPECT_EQ(covered, wasCovered)
              << columns << "x" << rows << " by " << factor << ": part " << column << ", " << row;
        }
    }
}

}  // namespace
}  // namespace acentric
