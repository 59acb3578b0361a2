#include "engine/image/coarse_capture.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace acentric
