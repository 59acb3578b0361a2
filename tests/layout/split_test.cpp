/// Cells split into smaller ones, and free APVs beside the lattice.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/layout/lattice.h"
#include "engine/layout/region_index.h"
#include "tests/layout/layout_fixtures.h"

namespace acentric {
namespace {
using test::crossedAlongRay;
using test::Random;
using testing::HasSubstr;

LayoutSpec splitSpec(Configuration configuration) {
  LayoutSpec spec;
  spec.configuration = configuration;
  spec.cellSize = 2;
  spec.latticeOrigin = {0.3, -0.7};
  spec.rotationRadians = 0.37;
  spec.outline.loops = {{{-5, -5}, {5, -5}, {5, 5}, {-5, 5}}};
  const Lattice lattice = *Lattice::of(spec);
  // Neighbours of three sizes.
  const CellId middle = cellAt(spec, {0.2, 0.1}).id;
  spec.split = {middle, cellAt(spec, {2.5, -1}).id, cellAt(spec, {-3, 2}).id};
  spec.split.insert(lattice.childrenOf(middle)[0]);
  spec.split.insert(lattice.childrenOf(middle)[3]);
  return spec;
}

class SplitOf : public testing::TestWithParam<Configuration> {};
INSTANTIATE_TEST_SUITE_P(Configurations, SplitOf, testing::Values(Configuration::e, Configuration::g),
                         [](const auto& test) { return std::string(nameOf(test.param)); });

TEST_P(SplitOf, ChildrenTileTheirParentAndKnowIt) {
  const LayoutSpec spec = splitSpec(GetParam());
  const Lattice lattice = *Lattice::of(spec);
  Random random(51);
  for (int n = 0; n < 200; ++n) {
    const CellId cell{random.index(7) - 3, random.index(7) - 3, random.index(std::size_t(lattice.slots())),
                      random.index(3)};
    const ConvexPolygon whole = lattice.polygonOf(cell);
    double area = 0;
    for (const CellId& child : lattice.childrenOf(cell)) {
      EXPECT_EQ(lattice.parentOf(child), cell);
      EXPECT_TRUE(whole.contains(lattice.polygonOf(child).centroid()));
      area += lattice.polygonOf(child).area();
    }
    EXPECT_NEAR(area, whole.area(), 1e-12);
  }
}

TEST_P(SplitOf, ACellIsPlacedExactlyIfTheLayoutHoldsIt) {
  LayoutSpec spec = splitSpec(GetParam());
  Random random(52);
  const auto anyCell = [&] {
    const glm::dvec2 place{random(-8, 8), random(-8, 8)};
    return cellAt(spec, place).id;
  };
  for (int n = 0; n < 6; ++n) spec.added.insert(anyCell()), spec.removed.insert(anyCell());
  spec.removed.insert(partsOf(spec, *spec.split.begin())[2]);
  ASSERT_TRUE(spec.check()) << spec.check().error().describe();
  const Layout layout = buildLayout(spec).value();
  for (const Region& region : layout.regions) EXPECT_TRUE(isPlaced(spec, region.id));
  for (int n = 0; n < 3000; ++n) {
    CellId cell = anyCell();
    for (;; cell = wholeOf(spec, cell)) {  // and what it is a part of
      EXPECT_EQ(isPlaced(spec, cell), layout.findRegion(cell).has_value()) << cell.i << ' ' << cell.j;
      if (cell.level == 0) break;
    }
  }
}

TEST_P(SplitOf, EveryPlaceBelongsToExactlyOneRegionOfWhateverSize) {
  const Layout layout = buildLayout(splitSpec(GetParam())).value();
  std::set<int> levels;
  for (const Region& region : layout.regions) levels.insert(region.id.level);
  EXPECT_EQ(levels, (std::set<int>{0, 1, 2}));
  Random random(52);
  for (int n = 0; n < 20000; ++n) {
    const glm::dvec2 p(random(-4.9, 4.9), random(-4.9, 4.9));
    const auto region = layout.regionAt(p);
    ASSERT_TRUE(region);
    int holding = 0;
    for (const Region& r : layout.regions) holding += r.polygon.contains(p) ? 1 : 0;
    ASSERT_EQ(holding, 1);
    ASSERT_TRUE(layout.regions[std::size_t(*region)].polygon.contains(p));
  }
}

TEST_P(SplitOf, CoversAndOrderStayExactAcrossSizes) {
  const Layout layout = buildLayout(splitSpec(GetParam())).value();
  Random random(53);
  for (std::size_t r = 0; r < layout.regions.size(); ++r) {
    const Region& region = layout.regions[r];
    for (const Cover& cover : region.covers)
      for (int n = 0; n < 60; ++n) {
        const glm::dvec2 p(random(-30, 30), random(-30, 30));
        if (!region.polygon.containsClosed(p)) {
          ASSERT_EQ(std::ranges::count_if(cover.pieces, [&](const Piece& q) { return q.holds(p); }), 1);
        }
        const ViewSector sector{random.within(region.polygon), {random(0, kTwoPi), random(0.1, 3.1)}};
        std::vector<int> painted;
        for (const OrderedPiece& piece : visiblePieces(layout, static_cast<int>(r), cover, sector))
          painted.push_back(piece.camera);
        const double azimuth = sector.azimuths.low + sector.azimuths.width * random(1e-6, 1 - 1e-6);
        auto expected = crossedAlongRay(region, cover, sector.eye, directionOf(azimuth), 1e-9);
        std::ranges::reverse(expected);
        std::erase_if(painted, [&](int c) { return std::ranges::find(expected, c) == expected.end(); });
        ASSERT_EQ(painted, expected);
      }
  }
}

TEST_P(SplitOf, RegionsOfDifferentSizesShareTheCamerasOfTheirCorners) {
  const Layout layout = buildLayout(splitSpec(GetParam())).value();
  std::set<std::pair<double, double>> places;
  std::set<std::tuple<int, int, int>> corners;
  for (const LayoutCamera& camera : layout.cameras) {
    places.emplace(camera.position.x, camera.position.y);
    corners.emplace(camera.id.i, camera.id.j, camera.id.level);
    for (const Role& role : camera.roles) EXPECT_TRUE(role.grown.containsClosed(camera.position));
  }
  EXPECT_EQ(places.size(), corners.size());
  // Every placed region is served, as grown by the near band, by each of its cameras.
  for (const Region& region : layout.regions)
    for (const Cover& cover : region.covers)
      for (const Piece& piece : cover.pieces)
        EXPECT_EQ(layout.cameras[std::size_t(piece.camera)].roles[std::size_t(piece.role)].grown.corners,
                  region.grown.corners);
}

TEST_P(SplitOf, PanoramasStandAtCornersWhereAllCamerasArePlaced) {
  const Layout layout = buildLayout(splitSpec(GetParam())).value();
  const int r = *layout.regionAt({0.2, 0.1});
  const std::vector<Cover> panoramas = layout.panoramasFor(r);
  ASSERT_EQ(panoramas.size(), layout.regions[std::size_t(r)].polygon.size());
  Random random(54);
  for (const Cover& panorama : panoramas)
    for (int n = 0; n < 300; ++n) {
      const glm::dvec2 p(random(-20, 20), random(-20, 20));
      EXPECT_EQ(std::ranges::count_if(panorama.pieces, [&](const Piece& q) { return q.holds(p); }), 1);
    }
}

TEST(Split, IsRefusedWhereItWouldOverlapOrIsNotPossible) {
  LayoutSpec spec = splitSpec(Configuration::e);
  spec.configuration = Configuration::b;
  EXPECT_THAT(spec.check().error().message, HasSubstr("only those of e and g"));
  spec = splitSpec(Configuration::e);
  spec.split = {{0, 0, 0, 1}};
  EXPECT_THAT(spec.check().error().message, HasSubstr("which is not split"));
  spec.split.clear();
  spec.added = {{0, 0, 0, 1}};
  EXPECT_THAT(spec.check().error().message, HasSubstr("which is not split"));
  spec.added.clear();
  spec.split = {{0, 0, 0, 0}, {0, 0, 0, 1}, {0, 0, 0, 2}, {0, 0, 0, 3},
                {0, 0, 0, 4}, {0, 0, 0, 5}, {0, 0, 0, 6}};
  EXPECT_THAT(spec.check().error().message, HasSubstr("more than 6 times"));
}

TEST(FreeApv, HasARegionOfItsOwnBesideTheLattice) {
  LayoutSpec spec;
  spec.outline.loops = {{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}};
  spec.freeApvs[7] = {{0.5, 0.5}, {0.8, 0.1}, 90, Hand::clockwise};
  spec.freeApvs[9] = {{20, 0}, {1, 0}, 40, Hand::counterClockwise};
  const Layout layout = buildLayout(spec).value();
  const auto inside = layout.regionAt({0.5, 0.5}), apart = layout.regionAt({20.3, 0.1});
  ASSERT_TRUE(inside && apart);
  EXPECT_EQ(layout.regions[std::size_t(*inside)].id, (CellId{7, 0, kFreeSlot}));
  EXPECT_EQ(layout.regions[std::size_t(*apart)].id, (CellId{9, 0, kFreeSlot}));
  // 4 cameras of 90 degrees are captured as 8 of 45, 9 of 40 as they are.
  EXPECT_EQ(layout.regions[std::size_t(*inside)].covers.at(0).pieces.size(), 8u);
  EXPECT_EQ(layout.regions[std::size_t(*apart)].covers.at(0).pieces.size(), 9u);
  Random random(55);
  for (const int r : {*inside, *apart}) {
    const Region& region = layout.regions[std::size_t(r)];
    const Cover& cover = region.covers[0];
    for (int n = 0; n < 2000; ++n) {
      const glm::dvec2 p = region.polygon.centroid() + glm::dvec2(random(-9, 9), random(-9, 9));
      if (region.polygon.containsClosed(p)) continue;
      ASSERT_EQ(std::ranges::count_if(cover.pieces, [&](const Piece& q) { return q.holds(p); }), 1);
      for (const Piece& piece : cover.pieces) {
        const LayoutCamera& camera = layout.cameras[std::size_t(piece.camera)];
        const glm::dvec2 to = p - camera.position;
        EXPECT_EQ(piece.holds(p), wrapAngle(std::atan2(to.y, to.x) - camera.lowAzimuth) < camera.fovRadians);
      }
    }
  }
}

TEST(FreeApv, WithoutOffsetIsAPanoramaThatHelpsTheRegionsAround) {
  LayoutSpec spec;
  spec.cellSize = 2;
  spec.outline.loops = {{{-8, -8}, {8, -8}, {8, 8}, {-8, 8}}};
  spec.freeApvs[1] = {{0.2, 0.1}, {0, 0}, 60, Hand::counterClockwise};
  const Layout layout = buildLayout(spec).value();
  const int near = *layout.regionAt({0, 0}), away = *layout.regionAt({7, 7});
  EXPECT_NE(layout.regions[std::size_t(near)].id.slot, kFreeSlot);
  ASSERT_EQ(layout.panoramasFor(near).size(), 1u);
  EXPECT_TRUE(layout.panoramasFor(away).empty());
  const Cover panorama = layout.panoramasFor(near)[0];
  ASSERT_EQ(panorama.pieces.size(), 6u);
  for (const Piece& piece : panorama.pieces)
    EXPECT_EQ(layout.cameras[std::size_t(piece.camera)].roles[std::size_t(piece.role)].grown.corners,
              layout.regions[std::size_t(near)].grown.corners);
  // Painted back to front for an eye beside it: along any ray the sectors come in the reverse of that order.
  Random random(56);
  for (int n = 0; n < 3000; ++n) {
    const ViewSector sector{{random(-2, 2), random(-2, 2)}, {random(0, kTwoPi), random(0.05, kTwoPi)}};
    if (layout.regionAt(sector.eye) != near) continue;
    const auto ordered = visiblePieces(layout, near, panorama, sector);
    const glm::dvec2 ray = directionOf(sector.azimuths.low + sector.azimuths.width * random(1e-6, 1 - 1e-6));
    std::vector<int> crossed;
    for (double t = 1e-4; t < 60; t *= 1.01)
      for (const Piece& piece : panorama.pieces)
        if (piece.holds(sector.eye + t * ray) && (crossed.empty() || crossed.back() != piece.camera))
          crossed.push_back(piece.camera);
    std::ranges::reverse(crossed);
    std::vector<int> painted;
    for (const OrderedPiece& piece : ordered)
      if (std::ranges::find(crossed, piece.camera) != crossed.end()) painted.push_back(piece.camera);
    ASSERT_EQ(painted, crossed);
  }
}

}  // namespace
}  // namespace acentric
