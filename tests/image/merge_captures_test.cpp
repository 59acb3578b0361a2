#include "engine/image/merge_captures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

/// A wall in the plane x = `wall`, as a camera on the x axis sees it.
Capture wallFrom(double x, double wall) {
  Capture capture;
  capture.camera = {{x, 0, 0}, radians(-30.0), radians(60.0), radians(20.0), radians(-20.0), 120, 80};
  capture.columnStart = {0};
  for (int k = 0; k < capture.camera.columns; ++k) {
    const double inverse = capture.camera.directionAt(k + 0.5).x / (wall - x);
    for (int row = 0; row < capture.camera.rows; ++row) {
      capture.row.push_back(std::uint16_t(row));
      capture.inverseDistance.push_back(storedInverseDistance(inverse, 0));
      capture.colour.push_back(packColour({0.5f, 0.5f, 0.5f, 1}));
      capture.roles.push_back(1);
    }
    capture.columnStart.push_back(std::uint32_t(capture.row.size()));
  }
  return capture;
}

TEST(MergeCaptures, KeepsOfTheSecondWhatTheFirstDoesNotShow) {
  const Capture first = wallFrom(0, 4);
  const Capture* earlier[] = {&first};
  // From 1 m back the same angles show more of the wall: 5/4 as wide, 5/4 as high.
  Capture second = wallFrom(-1, 4);
  const std::size_t before = second.sampleCount(), gone = dropShown(second, earlier);
  EXPECT_EQ(second.sampleCount(), before - gone);
  ASSERT_TRUE(second.check()) << second.check().error().describe();
  // Columns: |tan| <= 0.8 tan 30 of the second lie in the first. Rows: the same share in every column.
  const double columns = degrees(std::atan(0.8 * std::tan(radians(30.0)))) / 30;
  EXPECT_GT(double(gone) / double(before), 0.8 * columns - 0.03);
  EXPECT_LT(double(gone) / double(before), columns);
  for (std::size_t k = 0; k < 120; ++k) {
    const double side = 5 * std::tan(second.camera.azimuthAt(double(k) + 0.5));
    if (std::abs(side) > 4 * std::tan(radians(30.0)) + 0.1) {
      EXPECT_EQ(second.columnStart[k + 1] - second.columnStart[k], 80u) << "the first does not see it";
    }
  }
}

TEST(MergeCaptures, KeepsWhatLiesElsewhere) {
  const Capture first = wallFrom(0, 4);
  const Capture* earlier[] = {&first};
  Capture nearer = wallFrom(0, 3), same = wallFrom(0, 4);
  EXPECT_EQ(dropShown(nearer, earlier), 0u);
  EXPECT_EQ(dropShown(same, {}), 0u);
  EXPECT_EQ(dropShown(same, earlier), same.camera.columns * std::size_t(same.camera.rows));
  ASSERT_TRUE(same.check()) << same.check().error().describe();
  EXPECT_EQ(same.sampleCount(), 0u);
}

}  // namespace
}  // namespace acentric
