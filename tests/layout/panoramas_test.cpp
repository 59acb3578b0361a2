#include "engine/layout/panoramas.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/layout/layout.h"

namespace acentric {
namespace {

LayoutSpec hexagonsAndTriangles(double halfSize) {
  LayoutSpec spec;
  spec.cellSize = 1;
  spec.outline.loops = {
      {{-halfSize, -halfSize}, {halfSize, -halfSize}, {halfSize, halfSize}, {-halfSize, halfSize}}};
  return spec;
}

std::size_t ringsOf(const Layout& layout) {
  return std::size_t(std::ranges::count(layout.regions, RegionKind::ring, &Region::kind));
}

TEST(Panoramas, StandInTheMiddleOfRingsOrOfAllRegions) {
  LayoutSpec spec = hexagonsAndTriangles(2.5);
  const Layout bare = *buildLayout(spec);
  ASSERT_GT(ringsOf(bare), 4u);
  ASSERT_LT(ringsOf(bare), bare.regions.size());
  EXPECT_EQ(addPanoramas(spec, PanoramaPlaces::rings).value(), int(ringsOf(bare)));
  EXPECT_EQ(addPanoramas(spec, PanoramaPlaces::rings).value(), 0) << "they are there";
  EXPECT_EQ(addPanoramas(spec, PanoramaPlaces::regions).value(), int(bare.regions.size() - ringsOf(bare)));
  const Layout layout = *buildLayout(spec);
  EXPECT_EQ(layout.cameras.size(), bare.cameras.size() + 6 * bare.regions.size());
  for (const Region& region : bare.regions)
    EXPECT_EQ(std::ranges::count_if(spec.freeApvs,
                                    [&](const auto& free) {
                                      return free.second.traditional() &&
                                             glm::distance(free.second.centre, region.polygon.centroid()) <
                                                 1e-9;
                                    }),
              1);
}

TEST(Panoramas, AreTakenAwayAloneAndNumbersAreNotUsedAgain) {
  LayoutSpec spec = hexagonsAndTriangles(1);
  spec.freeApvs[7] = Apv{{9, 9}, {1, 0}};
  const LayoutSpec before = spec;
  const int added = addPanoramas(spec, PanoramaPlaces::rings).value();
  EXPECT_GT(added, 0);
  EXPECT_EQ(spec.freeApvs.rbegin()->first, 7 + added);
  EXPECT_EQ(removePanoramas(spec), added);
  EXPECT_EQ(spec, before) << "an APV with a ring of its own stays";
}

TEST(Panoramas, HelpTheirOwnRegionInFrontOfItsNeighbours) {
  LayoutSpec spec = hexagonsAndTriangles(4);
  ASSERT_TRUE(addPanoramas(spec, PanoramaPlaces::regions));
  const Layout layout = *buildLayout(spec);
  for (std::size_t r = 0; r < layout.regions.size(); ++r) {
    const std::vector<Cover> panoramas = layout.panoramasFor(int(r));
    ASSERT_FALSE(panoramas.empty());
    EXPECT_LE(panoramas.size(), kMostPanoramas);
    const Cover& front = panoramas.back();
    ASSERT_EQ(front.pieces.size(), 6u);
    EXPECT_LT(glm::distance(front.pieces[0].apex, layout.regions[r].polygon.centroid()), 1e-9);
    for (const Cover& panorama : panoramas)
      for (const Piece& piece : panorama.pieces) EXPECT_GE(piece.role, 0) << "its samples know the region";
  }
}

TEST(Panoramas, MoreThanThereMayBeAreRefusedAndNothingIsChanged) {
  LayoutSpec spec = hexagonsAndTriangles(40);
  const LayoutSpec before = spec;
  const auto refused = addPanoramas(spec, PanoramaPlaces::regions);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::invalidArgument);
  EXPECT_EQ(spec, before);
}

}  // namespace
}  // namespace acentric
