/// Floors as scans have them: of small triangles that lie 3 cm up and down, sloping a little, with holes,
/// open at the borders.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "engine/inspect/storeys.h"
#include "tests/inspect/box_world.h"

namespace acentric {
namespace {
using test::BoxWorld;

constexpr double kCell = 0.25;
constexpr double kNoise = 0.03, kSlope = 0.02;

/// A floor of columns x rows cells from the origin on; every `holeEvery`-th cell is a hole (0: none). Walls
/// of the same cells at two sides.
BoxWorld scannedCorner(int columns, int rows, int holeEvery) {
  BoxWorld world;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> noise(-kNoise, kNoise);
  std::vector<glm::dvec3> corners;
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x)
      corners.emplace_back(kCell * x, kCell * y, kSlope * kCell * x + noise(random));
  const auto corner = [&](int x, int y) { return corners[std::size_t(y * (columns + 1) + x)]; };
  std::uniform_int_distribution<int> hole(1, std::max(1, holeEvery));
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      if (holeEvery == 0 || hole(random) != 1)
        world.addQuad(corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1));
  const double width = kCell * columns, depth = kCell * rows;
  world.addQuad({0, 0, 0}, {0, depth, 0}, {0, depth, 2.6}, {0, 0, 2.6});
  world.addQuad({0, 0, 0}, {0, 0, 2.6}, {width, 0, 2.6}, {width, 0, kSlope * width});
  return world;
}

TEST(ScannedFloor, IsOneStoreyThoughItIsUneven) {
  const BoxWorld world = scannedCorner(20, 16, 0);
  StoreyOptions options;
  options.walkable.gridStep = 0.125;
  const auto storeys = findStoreys(world.bounds(), options, world.probe());
  ASSERT_TRUE(storeys) << storeys.error().describe();
  ASSERT_EQ(storeys->planes.size(), 1U);
  EXPECT_NEAR(storeys->planes[0].height, kSlope * 2.5, 0.05);
  EXPECT_GT(storeys->planes[0].outline.area(), 0.95 * 4.8 * 3.8);
}

TEST(ScannedFloor, IsOneStoreyAroundItsHoles) {
  const BoxWorld world = scannedCorner(20, 16, 20);  // a cell in twenty
  StoreyOptions options;
  options.walkable.gridStep = 0.125;
  const auto storeys = findStoreys(world.bounds(), options, world.probe());
  ASSERT_TRUE(storeys) << storeys.error().describe();
  ASSERT_EQ(storeys->planes.size(), 1U);
  EXPECT_GT(storeys->planes[0].outline.area(), 0.88 * 4.8 * 3.8);
  const auto area = findWalkableArea(world.bounds(), options.walkable, world.probe());
  ASSERT_TRUE(area) << area.error().describe();
  EXPECT_GT(area->outline.area(), 0.88 * 4.8 * 3.8);
}

}  // namespace
}  // namespace acentric
