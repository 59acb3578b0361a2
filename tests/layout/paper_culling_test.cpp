#include "engine/layout/paper_culling.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/layout/azimuth_order.h"
#include "tests/layout/layout_fixtures.h"

namespace acentric {
namespace {
using test::makeLayout;
using test::Random;

std::vector<int> cameras(const std::vector<OrderedPiece>& ordered) {
  std::vector<int> list;
  for (const OrderedPiece& piece : ordered) list.push_back(piece.camera);
  return list;
}

/// An eye in the region: anywhere, or a nanometre to a millimetre off an edge or a corner; a view of any
/// direction, or with a border nearly along a direction of the lattice.
ViewSector hardView(const Region& region, double mostWidth, Random& random) {
  ViewSector sector{random.within(region.polygon), {random(0, kTwoPi), random(0.01, mostWidth)}};
  if (random(0, 1) < 0.5) {
    const auto k = std::size_t(random.index(region.polygon.size()));
    const glm::dvec2 a = region.polygon.corners[k],
                     b = region.polygon.corners[(k + 1) % region.polygon.size()];
    const glm::dvec2 border = random(0, 1) < 0.3 ? a : a + random(0, 1) * (b - a);
    sector.eye = border + std::pow(10.0, random(-9, -3)) * (region.polygon.centroid() - border);
  }
  if (random(0, 1) < 0.5) {
    sector.azimuths.low =
        radians(15.0 * random.index(24)) + std::pow(10.0, random(-9, -3)) * (random(0, 1) < 0.5 ? 1 : -1);
    if (random(0, 1) < 0.5) sector.azimuths.low -= sector.azimuths.width;
  }
  return sector;
}

TEST(PaperCulling, InARingAgreesWithTheGenericOrder) {
  Random random(21);
  for (const Configuration configuration : test::kAllConfigurations) {
    const Layout layout = makeLayout(configuration);
    for (int n = 0; n < 110000; ++n) {
      const int r = random.index(layout.regions.size());
      const Region& region = layout.regions[std::size_t(r)];
      if (region.kind != RegionKind::ring) continue;
      const ViewSector sector = hardView(region, radians(60), random);
      for (const Cover& cover : region.covers)
        ASSERT_EQ(cullRingAsInPaper(cover, sector), cameras(visiblePieces(layout, r, cover, sector)));
    }
  }
}

TEST(PaperCulling, InAGapTriangleAgreesWhereTheViewReachesTheChosenCamerasStrip) {
  Random random(22);
  const Layout layout = makeLayout(Configuration::b);
  int agreed = 0, outsidePremise = 0;
  for (int n = 0; n < 300000; ++n) {
    const int r = random.index(layout.regions.size());
    const Region& region = layout.regions[std::size_t(r)];
    if (region.kind != RegionKind::gapTriangle) continue;
    const ViewSector sector = hardView(region, radians(59.99), random);
    const std::vector<int> paper = cullTriangleAsInPaper(region.covers[0], sector);
    std::vector<int> generic = cameras(visiblePieces(layout, r, region.covers[0], sector));
    // The paper always draws the interior camera E that looks most nearly the viewer's way: its unsaid
    // premise is that the view reaches E's strip.
    const auto& pieces = region.covers[0].pieces;
    const double looking = sector.azimuths.low + 0.5 * sector.azimuths.width;
    const auto away = [&](int piece) {
      const LayoutCamera& camera = layout.cameras[std::size_t(pieces[std::size_t(piece)].camera)];
      return std::abs(std::remainder(camera.lowAzimuth + 0.5 * camera.fovRadians - looking, kTwoPi));
    };
    const int chosen = std::ranges::min({3, 4, 5}, {}, away);
    const bool seesE = std::ranges::find(generic, pieces[std::size_t(chosen)].camera) != generic.end();
    std::vector<int> sortedPaper = paper;
    std::ranges::sort(sortedPaper);
    std::ranges::sort(generic);
    if (!seesE) {
      ++outsidePremise;
      continue;
    }
    ASSERT_EQ(sortedPaper, generic);
    // Wedges come first in the paper's order too.
    for (std::size_t k = 1; k < paper.size(); ++k)
      for (int w = 0; w < 3; ++w) EXPECT_NE(paper[k], pieces[std::size_t(w)].camera);
    ++agreed;
  }
  EXPECT_GT(agreed, 10 * outsidePremise);
}

}  // namespace
}  // namespace acentric
