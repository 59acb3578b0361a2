#include "engine/inspect/plan_coverage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "tests/layout/layout_fixtures.h"
#include "tests/support/print_configuration.h"

namespace acentric {
namespace {
using test::makeLayout;
using testing::HasSubstr;

constexpr Configuration kAll[] = {Configuration::a, Configuration::b, Configuration::c, Configuration::d,
                                  Configuration::e, Configuration::f, Configuration::g};

PlanGrid gridAround(const glm::dvec2& centre, double half, int cells) {
  return PlanGrid::over(centre - glm::dvec2(half), centre + glm::dvec2(half), cells);
}

/// Every cell, every sector, no shortcut.
std::vector<std::uint16_t> countedSlowly(const std::vector<PlanSector>& sectors, double reach,
                                         const PlanGrid& grid) {
  std::vector<std::uint16_t> counts;
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x) {
      const glm::dvec2 p = grid.centreOf(x, y);
      std::uint16_t count = 0;
      for (const PlanSector& sector : sectors) {
        const glm::dvec2 d = p - sector.apex;
        if (d.x * d.x + d.y * d.y <= reach * reach && sector.holds(p)) ++count;
      }
      counts.push_back(count);
    }
  return counts;
}

/// Cameras on a circle, each looking along `viewing` relative to its place's azimuth.
std::vector<PlanSector> circleOfCameras(int n, double fov, double viewing) {
  std::vector<PlanSector> sectors;
  for (int i = 0; i < n; ++i) {
    const double azimuth = kTwoPi * i / n;
    LayoutCamera camera;
    camera.position = directionOf(azimuth);
    camera.lowAzimuth = azimuth + viewing - fov / 2;
    camera.fovRadians = fov;
    sectors.push_back(sectorOf(camera));
  }
  return sectors;
}

TEST(PlanCoverage, OfAnIdealApvIsExactlyOneOutsideItsPolygon) {
  TaskRunner runner(1);
  for (const double fov : {120.0, 90.0, 60.0, 45.0, 30.0, 1.0})
    for (const Hand hand : {Hand::counterClockwise, Hand::clockwise})
      for (const glm::dvec2 offset : {glm::dvec2(1, 0), glm::dvec2(-0.3, 0.8), glm::dvec2(0)}) {
        const Apv apv{{0.25, -3}, offset, fov, hand};
        const auto coverage = coverageOfApv(apv, gridAround(apv.centre, 4, 97), runner);
        ASSERT_TRUE(coverage) << coverage.error().describe();
        const CoverageShares shares = sharesOf(*coverage);
        // Of a traditional panorama the centre itself is no sector's inside: all of its sectors begin there.
        const double apex = apv.traditional() ? 1.0 / (97 * 97) : 0;
        EXPECT_NEAR(shares.once, 1, apex + 1e-12) << fov;
        const double polygon = apv.traditional() ? 0 : polygonOf(apv).area();
        EXPECT_NEAR(shares.countedArea, 64 - polygon, 64 * 0.01);
      }
}

TEST(PlanCoverage, IsExactOnTheBordersOfNeighbouringSectors) {
  // Cell centres within rounding of the lines: the square's corners are at half-integers, as the centres are.
  TaskRunner runner;
  const Apv square{{0, 0}, {1.5, 1.5}, 90, Hand::counterClockwise};
  const PlanGrid grid{{-8, -8}, 1, 16, 16};
  const auto coverage = coverageOfApv(square, grid, runner);
  ASSERT_TRUE(coverage);
  EXPECT_EQ(sharesOf(*coverage).once, 1);
  const ConvexPolygon polygon = polygonOf(square);
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x)
      EXPECT_EQ(coverage->counts[grid.indexOf(x, y)] == kNotCounted,
                polygon.containsClosed(grid.centreOf(x, y)));
}

TEST(PlanCoverage, OfCamerasThatLookStraightOutShowsWhatThePaperFaults) {
  // Fig. 3 (b): the same number of cameras on a circle, looking outward: parallel gaps between the sectors.
  // With more cameras the gaps shrink, and sectors overlap (below (b)).
  TaskRunner runner;
  const PlanGrid grid = gridAround({0, 0}, 12, 200);
  const auto few = coverageOfSectors(circleOfCameras(6, radians(60), 0), kAnyDistance, grid, runner);
  const auto many = coverageOfSectors(circleOfCameras(9, radians(60), 0), kAnyDistance, grid, runner);
  ASSERT_TRUE(few && many);
  const CoverageShares sparse = sharesOf(*few), dense = sharesOf(*many);
  EXPECT_GT(sparse.none, 0.05);
  EXPECT_EQ(sparse.more, 0);
  EXPECT_LT(dense.none, sparse.none);
  EXPECT_GT(dense.more, 0.3);
  // Fig. 3 (d): the same six cameras turned by 90 degrees are an acentric panorama view.
  const auto turned =
      coverageOfSectors(circleOfCameras(6, radians(60), radians(90)), kAnyDistance, grid, runner);
  std::size_t outside = 0, once = 0;
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x)
      if (glm::length(grid.centreOf(x, y)) > 1) {
        ++outside;
        once += turned->counts[grid.indexOf(x, y)] == 1;
      }
  EXPECT_EQ(once, outside);
}

TEST(PlanCoverage, AgreesWithCountingEverySectorAtEveryPoint) {
  test::Random random(11);
  for (int n = 0; n < 40; ++n) {
    std::vector<PlanSector> sectors;
    for (int k = 0; k < 12; ++k) {
      LayoutCamera camera;
      camera.position = {random(-3, 3), random(-3, 3)};
      camera.lowAzimuth = k % 3 == 0 ? radians(15.0 * random.index(24)) : random(0, kTwoPi);
      camera.fovRadians = random(0.05, 2.5);
      sectors.push_back(sectorOf(camera));
    }
    const PlanGrid grid{{random(-5, -2), random(-5, -2)}, random(0.05, 0.3), 31 + random.index(20), 29};
    const double reach = n % 2 == 0 ? kAnyDistance : random(0.5, 4);
    TaskRunner runner(n % 2);
    const auto coverage = coverageOfSectors(sectors, reach, grid, runner);
    ASSERT_TRUE(coverage);
    EXPECT_EQ(coverage->counts, countedSlowly(sectors, reach, grid));
  }
}

class ConfigurationCoverage : public testing::TestWithParam<Configuration> {
 protected:
  void SetUp() override {
    LayoutSpec spec;
    spec.configuration = GetParam();
    spec.outline.loops = {{{0, 0}, {1, 0}, {0, 1}}};
    if (const auto layout = buildLayout(spec); !layout && layout.error().kind == ErrorKind::unsupported)
      GTEST_SKIP() << layout.error().describe();
  }
};
INSTANTIATE_TEST_SUITE_P(Every, ConfigurationCoverage, testing::ValuesIn(kAll));

TEST_P(ConfigurationCoverage, EachCoverHoldsEachOutsidePointExactlyOnce) {
  TaskRunner runner(1);
  const Layout layout = makeLayout(GetParam(), {1.7, {0.3, -0.2}, 0.4}, 1.2);
  ASSERT_FALSE(layout.regions.empty());
  std::vector<RegionKind> seen;
  for (const Region& region : layout.regions) {
    if (std::ranges::count(seen, region.kind) >= 2) continue;
    seen.push_back(region.kind);
    for (const Cover& cover : region.covers) {
      const auto coverage =
          coverageOfCover(region, cover, gridAround(region.polygon.centroid(), 12, 120), runner);
      ASSERT_TRUE(coverage);
      EXPECT_EQ(sharesOf(*coverage).once, 1);
    }
  }
}

TEST_P(ConfigurationCoverage, CamerasAtAGapsCornersHoldWhatIsOutsideAsOftenAsTheTableSays) {
  struct Expected {
    RegionKind kind;
    std::size_t times;
  };
  const std::map<Configuration, Expected> table = {{Configuration::a, {RegionKind::gapSquare, 2}},
                                                   {Configuration::b, {RegionKind::gapTriangle, 1}},
                                                   {Configuration::d, {RegionKind::gapSquare, 2}},
                                                   {Configuration::f, {RegionKind::gapHexagon, 4}},
                                                   {Configuration::g, {RegionKind::gapTriangle, 3}}};
  TaskRunner runner(1);
  const Layout layout = makeLayout(GetParam(), {2, {0, 0}, 0.1}, 3);
  int gaps = 0;
  for (const Region& region : layout.regions) {
    if (region.kind == RegionKind::ring) continue;
    // In the middle, where all the neighbours that share its corners are placed.
    if (glm::length(region.polygon.centroid()) > 2 * layout.spec.cellSize) continue;
    ASSERT_TRUE(table.contains(GetParam())) << "a configuration without gaps has one";
    const Expected& expected = table.at(GetParam());
    EXPECT_EQ(region.kind, expected.kind);
    const auto coverage =
        coverageOfCorners(layout, region, gridAround(region.polygon.centroid(), 15, 90), runner);
    ASSERT_TRUE(coverage);
    const CoverageShares shares = sharesOf(*coverage);
    ASSERT_EQ(shares.byCount.size(), expected.times + 1);
    EXPECT_EQ(shares.byCount[expected.times], 1);
    ++gaps;
  }
  EXPECT_EQ(gaps > 0, table.contains(GetParam()));
}

TEST_P(ConfigurationCoverage, OfALayoutIsItsCamerasCountedOneByOne) {
  TaskRunner runner(1);
  const Layout layout = makeLayout(GetParam(), {}, 1.2);
  const PlanGrid grid = gridAround({0.1, 0.2}, 6, 61);
  for (const double reach : {kAnyDistance, 3.0}) {
    const auto coverage = coverageOfLayout(layout, reach, grid, runner);
    ASSERT_TRUE(coverage);
    EXPECT_EQ(coverage->counts, countedSlowly(sectorsOf(layout), reach, grid));
  }
  const std::vector<PlanSector> sectors = sectorsOf(layout);
  for (std::size_t c = 0; c < sectors.size(); ++c) {
    EXPECT_EQ(sectors[c].apex, layout.cameras[c].position);
    const PlanSector byAngle = sectorOf(layout.cameras[c]);
    for (const double turn : {0.01, 0.5, 0.99}) {
      const glm::dvec2 point = byAngle.apex + 3.0 * directionOf(layout.cameras[c].lowAzimuth +
                                                                turn * layout.cameras[c].fovRadians);
      EXPECT_TRUE(sectors[c].holds(point)) << c;
    }
  }
}

TEST(PlanCoverage, RefusesABoxThatIsEmptyNotFiniteOrTooFine) {
  TaskRunner runner;
  const auto refusal = [&](const PlanGrid& grid) {
    const auto coverage = coverageOfLayout(Layout{}, kAnyDistance, grid, runner);
    return coverage ? std::string() : coverage.error().describe();
  };
  EXPECT_THAT(refusal({}), HasSubstr("empty"));
  EXPECT_THAT(refusal({{NAN, 0}, 1, 2, 2}), HasSubstr("finite"));
  EXPECT_THAT(refusal({{0, 0}, 1, 1 << 20, 1 << 20}), HasSubstr("fewer"));
  EXPECT_THAT(refusal(PlanGrid::over({1, 1}, {1, 1}, 100)), HasSubstr("empty"));
  EXPECT_FALSE(coverageOfLayout(Layout{}, NAN, {{0, 0}, 1, 2, 2}, runner));
  const auto nothing = coverageOfLayout(Layout{}, kAnyDistance, {{0, 0}, 1, 2, 2}, runner);
  ASSERT_TRUE(nothing);
  EXPECT_EQ(sharesOf(*nothing).none, 1);
}

TEST(PlanCoverage, TimesALayoutOfAboutTwoHundredCameras) {
  const Layout layout = makeLayout(Configuration::b, {1.6, {0, 0}, 0.2}, 4.4);
  TaskRunner runner(1);
  const PlanGrid grid = gridAround({0, 0}, 12, 512);
  const auto start = std::chrono::steady_clock::now();
  const auto coverage = coverageOfLayout(layout, kAnyDistance, grid, runner);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ASSERT_TRUE(coverage);
  std::printf("[ bench    ] %dx%d points, %zu cameras, %d threads: %.1f ms\n", grid.columns, grid.rows,
              layout.cameras.size(), runner.threads(), 1e3 * seconds);
  EXPECT_GT(sharesOf(*coverage).mean, 1);
}

}  // namespace
}  // namespace acentric
