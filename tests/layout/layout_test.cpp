#include "engine/layout/layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/layout/layout_fixtures.h"

namespace acentric {
namespace {
using test::kAllConfigurations;
using test::makeLayout;
using test::Placing;
using test::Random;
using testing::HasSubstr;

LayoutSpec rectangle(double width, double height, double cellSize,
                     Configuration configuration = Configuration::b) {
  LayoutSpec spec;
  spec.configuration = configuration;
  spec.cellSize = cellSize;
  spec.outline.loops = {{{0, 0}, {width, 0}, {width, height}, {0, height}}};
  return spec;
}

std::size_t cornersOf(Configuration configuration, RegionKind kind) {
  switch (kind) {
    case RegionKind::gapTriangle:
      return 3;
    case RegionKind::gapSquare:
      return 4;
    case RegionKind::gapHexagon:
      return 6;
    case RegionKind::ring:
      break;
  }
  constexpr std::size_t kRing[] = {8, 6, 6, 4, 4, 3, 3};
  return kRing[std::size_t(configuration)];
}

class LayoutOf : public testing::TestWithParam<Configuration> {};
INSTANTIATE_TEST_SUITE_P(Configurations, LayoutOf, testing::ValuesIn(kAllConfigurations),
                         [](const auto& test) { return std::string(nameOf(test.param)); });

TEST_P(LayoutOf, PolygonsAreRegularAndCounterClockwise) {
  for (const Placing& placing :
       {Placing{2, {1, 1}, 0.5}, Placing{0.05, {-3, 0}, 0}, Placing{1000, {0, 0}, 3}}) {
    const Layout layout = makeLayout(GetParam(), placing);
    for (const Region& region : layout.regions) {
      const auto n = region.polygon.size();
      EXPECT_EQ(n, cornersOf(GetParam(), region.kind));
      for (std::size_t k = 0; k < n; ++k)
        EXPECT_NEAR(glm::distance(region.polygon.corners[k], region.polygon.corners[(k + 1) % n]),
                    placing.cellSize, 1e-12 * placing.cellSize + 1e-14);
      const double s = placing.cellSize, area = 0.25 * double(n) / std::tan(kPi / double(n));
      EXPECT_NEAR(region.polygon.area(), area * s * s, 1e-9 * s * s);
    }
  }
}

TEST_P(LayoutOf, ARingIsCentredOnTheLatticeOrigin) {
  const Layout layout = makeLayout(GetParam(), {2, {7, -3}, 0.9});
  const auto r = layout.findRegion({0, 0, 0});
  ASSERT_TRUE(r);
  EXPECT_EQ(layout.regions[std::size_t(*r)].kind, RegionKind::ring);
  EXPECT_LT(glm::distance(layout.regions[std::size_t(*r)].polygon.centroid(), {7, -3}), 1e-12);
}

TEST_P(LayoutOf, CoversTheOutlineAndNothingThatOnlyTouchesIt) {
  const LayoutSpec spec = rectangle(13, 9, 1.5, GetParam());
  const Layout layout = buildLayout(spec).value();
  Random random(1);
  for (int n = 0; n < 5000; ++n) EXPECT_TRUE(layout.regionAt({random(0, 13), random(0, 9)}));
  for (const Region& region : layout.regions) EXPECT_TRUE(spec.outline.overlaps(region.polygon));
  for (const LatticeCell& cell : cellsIn(spec, {-5, -5}, {18, 14}, 10000))
    EXPECT_EQ(layout.findRegion(cell.id).has_value(), spec.outline.overlaps(cell.polygon));
}

TEST_P(LayoutOf, EveryPlacePlacedOrNotBelongsToExactlyOneRegion) {
  for (const Placing& placing : {Placing{2, {0, 0}, 0}, Placing{2, {0, 0}, 0.3},
                                 Placing{0.05, {5e6, -5e6}, 0.1}, Placing{1, {5e6, 5e6}, 0}}) {
    const Layout layout = makeLayout(GetParam(), placing, 2.2);
    const auto expectOne = [&](const glm::dvec2& point) {
      const auto holds = [&](const Region& r) { return r.polygon.contains(point); };
      const auto count = std::ranges::count_if(layout.regions, holds);
      ASSERT_EQ(count, 1);
      const auto at = layout.regionAt(point);
      ASSERT_TRUE(at);
      EXPECT_TRUE(holds(layout.regions[std::size_t(*at)]));
      EXPECT_EQ(cellAt(layout.spec, point).id, layout.regions[std::size_t(*at)].id);
    };
    Random random(2);
    const double h = 2 * placing.cellSize;
    for (int n = 0; n < 2000; ++n) expectOne(placing.origin + glm::dvec2(random(-h, h), random(-h, h)));
    // Corners, edges' middles and their neighbours one ulp away, where they lie well inside the placed area.
    for (const Region& region : layout.regions)
      for (std::size_t k = 0; k < region.polygon.size(); ++k) {
        const glm::dvec2 a = region.polygon.corners[k];
        const glm::dvec2 b = region.polygon.corners[(k + 1) % region.polygon.size()];
        for (const glm::dvec2& p : {a, 0.5 * (a + b)}) {
          const glm::dvec2 off = glm::abs(p - placing.origin);
          if (std::max(off.x, off.y) > h) continue;
          for (double dx : {-double(INFINITY), 0.0, double(INFINITY)})
            for (double dy : {-double(INFINITY), 0.0, double(INFINITY)})
              expectOne({dx == 0 ? p.x : std::nextafter(p.x, dx), dy == 0 ? p.y : std::nextafter(p.y, dy)});
        }
      }
  }
}

TEST_P(LayoutOf, TheNearestRegionHoldsTheNearestPoint) {
  const Layout layout = makeLayout(GetParam(), {2, {0, 0}, 0.2});
  Random random(3);
  for (int n = 0; n < 500; ++n) {
    const glm::dvec2 point{random(-30, 30), random(-30, 30)};
    const Layout::Nearest nearest = layout.nearestRegion(point);
    ASSERT_GE(nearest.region, 0);
    EXPECT_EQ(layout.regionAt(nearest.point), nearest.region);
    double best = INFINITY;
    for (const Region& region : layout.regions)
      best = std::min(best, glm::distance(point, region.polygon.nearestPoint(point)));
    EXPECT_NEAR(glm::distance(point, nearest.point), best, 1e-8);
  }
}

TEST_P(LayoutOf, AddsAndRemovesSingleRegions) {
  LayoutSpec spec = rectangle(6, 6, 2, GetParam());
  const Layout before = buildLayout(spec).value();
  spec.added = {{20, 20, 0}, before.regions[0].id};
  spec.removed = {before.regions[1].id, {-30, 5, 0}};
  const Layout after = buildLayout(spec).value();
  EXPECT_EQ(after.regions.size(), before.regions.size());
  EXPECT_TRUE(after.findRegion({20, 20, 0}));
  EXPECT_FALSE(after.findRegion(before.regions[1].id));
  EXPECT_TRUE(after.regionAt(cellPolygon(spec, {20, 20, 0}).centroid()));
  EXPECT_FALSE(after.regionAt(before.regions[1].polygon.centroid()));
}

TEST_P(LayoutOf, AnEmptySpecIsAnEmptyLayout) {
  LayoutSpec spec;
  spec.configuration = GetParam();
  const Layout layout = buildLayout(spec).value();
  EXPECT_TRUE(layout.regions.empty());
  EXPECT_TRUE(layout.cameras.empty());
  EXPECT_FALSE(layout.regionAt({0, 0}));
  EXPECT_EQ(layout.nearestRegion({1, 2}).region, -1);
  EXPECT_FALSE(layout.regionAt({NAN, 0}));
}

TEST(LayoutLimits, AHugeOutlineWithTinyCellsIsRefusedWithTheCountAndTheWayOut) {
  const auto status = rectangle(1e6, 1e6, 0.05).check();
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::tooLarge);
  EXPECT_THAT(status.error().message, HasSubstr("about 346410161513775 regions"));
  EXPECT_THAT(status.error().message, HasSubstr("choose cells of"));
  // The advice works.
  LayoutSpec spec = rectangle(1200, 1000, 1);
  ASSERT_FALSE(buildLayout(spec));
  const std::string message = buildLayout(spec).error().message;
  const auto at = message.find("cells of ") + 9;
  spec.cellSize = std::stod(message.substr(at));
  EXPECT_TRUE(buildLayout(spec)) << message;
}

TEST(LayoutLimits, AVeryLongThinOutlineIsRefusedQuicklyToo) {
  LayoutSpec spec = rectangle(8e6, 1e-6, 0.05);
  spec.outline.loops[0][2] = {8e6, 5e6};
  spec.outline.loops[0][3] = {8e6, 5e6 + 1e-6};
  const auto layout = buildLayout(spec);
  ASSERT_FALSE(layout);
  EXPECT_EQ(layout.error().kind, ErrorKind::tooLarge);
}

TEST(LayoutSpec, RefusesHostileNumbers) {
  const auto refuses = [](auto change) {
    LayoutSpec spec = rectangle(4, 4, 1);
    change(spec);
    const Status status = spec.check();
    return !status && !status.error().message.empty() && !buildLayout(spec);
  };
  EXPECT_TRUE(rectangle(4, 4, 1).check());
  for (const double bad : {double(NAN), double(INFINITY), -double(INFINITY), -1e30, 1e30}) {
    EXPECT_TRUE(refuses([&](LayoutSpec& s) { s.cellSize = bad; }));
    EXPECT_TRUE(refuses([&](LayoutSpec& s) { s.latticeOrigin.x = bad; }));
    EXPECT_TRUE(refuses([&](LayoutSpec& s) { s.latticeOrigin.y = bad; }));
    EXPECT_TRUE(refuses([&](LayoutSpec& s) { s.rotationRadians = bad; }));
    EXPECT_TRUE(refuses([&](LayoutSpec& s) { s.floorHeight = bad; }));
    EXPECT_TRUE(refuses([&](LayoutSpec& s) { s.eyeHeight = bad; }));
    EXPECT_TRUE(refuses([&](LayoutSpec& s) { s.nearBand = bad; }));
    EXPECT_TRUE(refuses([&](LayoutSpec& s) { s.outline.loops[0][1].y = bad; }));
  }
  EXPECT_TRUE(refuses([](LayoutSpec& s) { s.cellSize = 0; }));
  EXPECT_TRUE(refuses([](LayoutSpec& s) { s.configuration = Configuration(77); }));
  EXPECT_TRUE(refuses([](LayoutSpec& s) { s.outline.loops[0].resize(2); }));
  EXPECT_TRUE(refuses([](LayoutSpec& s) { s.outline.loops[0].resize(5000, {1, 1}); }));
  EXPECT_TRUE(refuses([](LayoutSpec& s) { s.added = {{0, 0, 3}}; }));
  EXPECT_TRUE(refuses([](LayoutSpec& s) { s.removed = {{0, 0, -1}}; }));
  EXPECT_TRUE(refuses([](LayoutSpec& s) { s.added = {{2147483647, 0, 0}}; }));
  EXPECT_TRUE(refuses([](LayoutSpec& s) { s.added = {{0, -2147483647 - 1, 0}}; }));
}

TEST(LayoutSpec, CellsInHonoursItsLimitOnAnyBox) {
  const LayoutSpec spec = rectangle(4, 4, 1);
  EXPECT_EQ(cellsIn(spec, {-1e6, -1e6}, {1e6, 1e6}, 500).size(), 500u);
  EXPECT_TRUE(cellsIn(spec, {1, 1}, {0, 0}, 500).empty());
  EXPECT_TRUE(cellsIn(spec, {NAN, 0}, {1, 1}, 500).empty());
  EXPECT_TRUE(cellsIn(spec, {0, 0}, {1, 1}, 0).empty());
}

TEST(Configurations, HaveNamesThatParse) {
  for (int c = 0; c < 7; ++c) {
    const auto configuration = static_cast<Configuration>(c);
    EXPECT_EQ(parseConfiguration(nameOf(configuration)).value(), configuration);
    EXPECT_GT(std::string(describe(configuration)).size(), 10u);
  }
  const auto unknown = parseConfiguration("h");
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().message, HasSubstr("'h'"));
}

TEST(LayoutSpec, EveryFieldChangesItsKey) {
  const auto keyOf = [](auto change) {
    LayoutSpec spec = rectangle(4, 4, 1);
    change(spec);
    Hasher hasher;
    spec.addTo(hasher);
    return hasher.finish();
  };
  std::set<ContentKey> keys{
      keyOf([](LayoutSpec&) {}),
      keyOf([](LayoutSpec& s) { s.configuration = Configuration::e; }),
      keyOf([](LayoutSpec& s) { s.cellSize = 3; }),
      keyOf([](LayoutSpec& s) { s.latticeOrigin.x = 3; }),
      keyOf([](LayoutSpec& s) { s.latticeOrigin.y = 3; }),
      keyOf([](LayoutSpec& s) { s.rotationRadians = 3; }),
      keyOf([](LayoutSpec& s) { s.floorHeight = 3; }),
      keyOf([](LayoutSpec& s) { s.eyeHeight = 3; }),
      keyOf([](LayoutSpec& s) { s.nearBand = 3; }),
      keyOf([](LayoutSpec& s) { s.outline.loops[0][0].x = -1; }),
      keyOf([](LayoutSpec& s) {
        s.added = {{1, 2, 0}};
      }),
      keyOf([](LayoutSpec& s) {
        s.removed = {{1, 2, 0}};
      }),
  };
  EXPECT_EQ(keys.size(), 12u);
}

}  // namespace
}  // namespace acentric
