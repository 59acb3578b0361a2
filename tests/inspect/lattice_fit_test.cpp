#include "engine/inspect/lattice_fit.h"

#include <gtest/gtest.h>

#include "tests/inspect/box_world.h"

namespace acentric {
namespace {
using test::BoxWorld;

LayoutSpec cellsOver(const std::vector<std::vector<glm::dvec2>>& loops, double cellSize,
                     Configuration configuration = Configuration::b) {
  LayoutSpec spec;
  spec.configuration = configuration;
  spec.cellSize = cellSize;
  spec.outline.loops = loops;
  return spec;
}

/// Corners of a box, turned about the origin.
std::vector<glm::dvec2> turnedBox(double width, double depth, double angle) {
  const glm::dvec2 x = directionOf(angle), y = directionOf(angle + kTwoPi / 4);
  return {{0, 0}, width * x, width * x + depth * y, depth * y};
}

std::size_t camerasOff(const Layout& layout) {
  return std::size_t(std::ranges::count_if(
      layout.cameras, [&](const LayoutCamera& c) { return !layout.spec.outline.contains(c.position); }));
}

TEST(LatticeFit, HasFewerCamerasAndFewerOffTheFloorThanTheFreestOrigin) {
  const BoxWorld room = BoxWorld::room(20, 12, 3);
  const LayoutSpec spec = cellsOver({{{0.2, 0.2}, {19.8, 0.2}, {19.8, 11.8}, {0.2, 11.8}}}, 2.5);
  LayoutSpec shifted = spec;
  shifted.latticeOrigin = findFreestOrigin(spec, {}, room.probe()).origin;
  const LatticeFit fit = fitLattice(spec, {}, room.probe());
  const Layout before = buildLayout(shifted).value(), after = buildLayout(fit.spec).value();
  EXPECT_LT(after.cameras.size(), before.cameras.size());
  EXPECT_LT(camerasOff(after), camerasOff(before));
  EXPECT_LT(crowding(after, {}, room.probe()), crowding(before, {}, room.probe()));
  EXPECT_GE(fit.served, 0.97);
}

TEST(LatticeFit, SaysWhichShareOfTheFloorRegionsHave) {
  const BoxWorld room = BoxWorld::room(20, 12, 3);
  const LayoutSpec spec = cellsOver({{{0.2, 0.2}, {19.8, 0.2}, {19.8, 11.8}, {0.2, 11.8}}}, 2.5);
  const LatticeFit fit = fitLattice(spec, {}, room.probe());
  ASSERT_FALSE(fit.spec.removed.empty());
  const Layout layout = buildLayout(fit.spec).value();
  int served = 0, places = 0;
  for (double x = 0.25; x < 19.8; x += 0.1)
    for (double y = 0.25; y < 11.8; y += 0.1) ++places, served += layout.regionAt({x, y}) ? 1 : 0;
  EXPECT_NEAR(fit.served, double(served) / places, 0.01);
}

TEST(LatticeFit, StaysWhereItWasFitted) {
  const BoxWorld room = BoxWorld::room(20, 12, 3);
  for (const Configuration configuration : {Configuration::a, Configuration::b, Configuration::e}) {
    const LayoutSpec spec =
        cellsOver({{{0.2, 0.2}, {19.8, 0.2}, {19.8, 11.8}, {0.2, 11.8}}}, 2.5, configuration);
    const LayoutSpec once = fitLattice(spec, {}, room.probe()).spec;
    EXPECT_EQ(fitLattice(once, {}, room.probe()).spec, once) << nameOf(configuration);
    const double turn = once.rotationRadians;
    EXPECT_EQ(turn, radians(std::round(2 * degrees(turn)) / 2)) << "as a project file gives it back";
  }
}

TEST(LatticeFit, TurnsAlongWallsThatStandAskew) {
  BoxWorld open{{{{-50, -50, -1}, {50, 50, 0}}}, {}};
  // Two squares deep and five wide, if they lie along it.
  const LayoutSpec spec = cellsOver({turnedBox(10, 4, radians(20.0))}, 2, Configuration::e);
  const LatticeFit fit = fitLattice(spec, {}, open.probe());
  EXPECT_NEAR(degrees(fit.spec.rotationRadians), 20, 1e-9);
  EXPECT_EQ(buildLayout(fit.spec)->regions.size(), 10U);
}

TEST(LatticeFit, KeepsTheDoorBetweenTwoRoomsOpen) {
  BoxWorld open{{{{-50, -50, -1}, {50, 50, 0}}}, {}};
  // Rooms of 6 x 6 m, joined by a passage 0.6 m wide and 6 m long: hardly any floor in its cells.
  const LayoutSpec spec = cellsOver({{{0, 0},
                                      {6, 0},
                                      {6, 2.7},
                                      {12, 2.7},
                                      {12, 0},
                                      {18, 0},
                                      {18, 6},
                                      {12, 6},
                                      {12, 3.3},
                                      {6, 3.3},
                                      {6, 6},
                                      {0, 6}}},
                                    3, Configuration::e);
  LatticeFitOptions options;
  options.mostLost = 0.2;
  const LatticeFit fit = fitLattice(spec, options, open.probe());
  const Layout layout = buildLayout(fit.spec).value();
  for (double x = 3; x < 15; x += 0.25) EXPECT_TRUE(layout.regionAt({x, 3})) << x;
}

TEST(LatticeFit, LeavesOutNoMoreFloorThanItMay) {
  const BoxWorld room = BoxWorld::room(20, 12, 3);
  for (const double most : {0.0, 0.01, 0.05}) {
    LatticeFitOptions options;
    options.mostLost = most;
    const LayoutSpec spec = cellsOver({{{0.2, 0.2}, {19.8, 0.2}, {19.8, 11.8}, {0.2, 11.8}}}, 3);
    EXPECT_GE(fitLattice(spec, options, room.probe()).served, 1 - most);
  }
}

TEST(LatticeFit, LeavesOutNoMoreThanItMayOfALongStripOfManyCells) {
  BoxWorld open{{{{-10, -10, -1}, {4000, 50, 0}}}, {}};
  const LayoutSpec spec = cellsOver({{{0, 0}, {1200, 0}, {1200, 7}, {0, 7}}}, 2);
  const LatticeFit fit = fitLattice(spec, {}, open.probe());
  const Layout layout = buildLayout(fit.spec).value();
  int served = 0, places = 0;
  for (double x = 0.5; x < 1200; x += 1.1)
    for (double y = 0.1; y < 7; y += 0.4) ++places, served += layout.regionAt({x, y}) ? 1 : 0;
  EXPECT_NEAR(fit.served, double(served) / places, 0.02);
  EXPECT_GT(double(served) / places, 0.95);
}

TEST(LatticeFit, KeepsTheSpecWhereNothingIsPlacedAndWhenStopped) {
  const BoxWorld room = BoxWorld::room(8, 6, 3);
  const LayoutSpec empty = cellsOver({}, 2);
  EXPECT_EQ(fitLattice(empty, {}, room.probe()).spec, empty);
  const LayoutSpec spec = cellsOver({{{0.2, 0.2}, {7.8, 0.2}, {7.8, 5.8}, {0.2, 5.8}}}, 1);
  std::stop_source source;
  source.request_stop();
  EXPECT_EQ(fitLattice(spec, {}, room.probe(), source.get_token()).spec, spec);
}

}  // namespace
}  // namespace acentric
