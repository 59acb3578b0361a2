#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "engine/layout/lattice.h"
#include "tests/layout/layout_fixtures.h"

namespace acentric {
namespace {
using test::kAllConfigurations;
using test::makeLayout;
using test::Placing;
using test::Random;

int holders(const Cover& cover, const glm::dvec2& point) {
  return static_cast<int>(
      std::ranges::count_if(cover.pieces, [&](const Piece& p) { return p.holds(point); }));
}

class CoverOf : public testing::TestWithParam<Configuration> {};
INSTANTIATE_TEST_SUITE_P(Configurations, CoverOf, testing::ValuesIn(kAllConfigurations),
                         [](const auto& test) { return std::string(nameOf(test.param)); });

const Placing kPlacings[] = {{2, {0, 0}, 0},         {0.05, {0.3, -0.2}, 0.3}, {1000, {10, 20}, 1.1},
                             {2, {5e6, -5e6}, 0.77}, {0.05, {5e6, 5e6}, 0},    {1.7, {-3, 4}, -2.2}};

TEST_P(CoverOf, EveryPointOutsideARegionLiesInExactlyOnePiece) {
  Random random(1);
  for (const Placing& placing : kPlacings) {
    const Layout layout = makeLayout(GetParam(), placing);
    ASSERT_FALSE(layout.regions.empty());
    for (const Region& region : layout.regions)
      for (const Cover& cover : region.covers)
        for (int n = 0; n < 200; ++n) {
          const double reach = placing.cellSize * std::pow(10.0, random(0, 2));
          const glm::dvec2 point =
              region.polygon.centroid() + glm::dvec2(random(-reach, reach), random(-reach, reach));
          if (region.polygon.containsClosed(point)) continue;
          ASSERT_EQ(holders(cover, point), 1) << "at " << point.x << ", " << point.y;
        }
  }
}

TEST_P(CoverOf, PointsOnSectorBordersAndOneUlpBesideThemLieInExactlyOnePiece) {
  // Borders are the continuations of edges: lattice corners further out lie on them, exactly or nearly so.
  for (const Placing& placing :
       {Placing{2, {0, 0}, 0}, Placing{1, {0, 0}, 0.4}, Placing{2, {5e6, 5e6}, 0.2}}) {
    const Layout layout = makeLayout(GetParam(), placing);
    for (const Region& region : layout.regions)
      for (const Cover& cover : region.covers)
        for (const Region& other : layout.regions)
          for (const glm::dvec2& corner : other.polygon.corners)
            for (int ulpX = -1; ulpX <= 1; ++ulpX)
              for (int ulpY = -1; ulpY <= 1; ++ulpY) {
                glm::dvec2 point = corner;
                if (ulpX != 0) point.x = std::nextafter(point.x, ulpX * INFINITY);
                if (ulpY != 0) point.y = std::nextafter(point.y, ulpY * INFINITY);
                if (region.polygon.containsClosed(point)) continue;
                ASSERT_EQ(holders(cover, point), 1);
              }
  }
}

TEST_P(CoverOf, ACamerasSectorIsWhatThePieceHolds) {
  Random random(2);
  const Layout layout = makeLayout(GetParam(), {2, {1, 2}, 0.3});
  for (const Region& region : layout.regions)
    for (const Cover& cover : region.covers)
      for (const Piece& piece : cover.pieces) {
        const LayoutCamera& camera = layout.cameras[std::size_t(piece.camera)];
        EXPECT_EQ(camera.position, piece.apex);
        EXPECT_LE(camera.fovRadians, radians(60) + 1e-12);
        for (int n = 0; n < 20; ++n) {
          const double inside = random(1e-9, 1 - 1e-9);
          const glm::dvec2 far =
              camera.position + 50.0 * directionOf(camera.lowAzimuth + inside * camera.fovRadians);
          EXPECT_EQ(piece.holds(far), !piece.clip || piece.clip->holds(far));
          const double outside = random(1 + 1e-9, kTwoPi / camera.fovRadians - 1e-9);
          EXPECT_FALSE(piece.holds(camera.position +
                                   50.0 * directionOf(camera.lowAzimuth + outside * camera.fovRadians)));
        }
      }
}

TEST_P(CoverOf, TheOtherHandIsTheNeighboursExceptInAAndC) {
  // "Auto": the clockwise cameras at each corner are counter-clockwise cameras of neighbours.
  const bool automatic = GetParam() != Configuration::a && GetParam() != Configuration::c;
  const Layout layout = makeLayout(GetParam(), {}, 6);
  std::set<int> counterClockwise;
  for (const Region& region : layout.regions)
    if (region.kind == RegionKind::ring) {
      for (const Piece& piece : region.covers[0].pieces)
        EXPECT_TRUE(counterClockwise.insert(piece.camera).second) << "in two counter-clockwise rings";
    }
  int inner = 0;
  for (const Region& region : layout.regions) {
    if (region.kind != RegionKind::ring || glm::length(region.polygon.centroid()) > 6) continue;
    ++inner;
    ASSERT_EQ(region.covers.size(), 2u);
    EXPECT_EQ(region.covers[0].hand, Hand::counterClockwise);
    EXPECT_EQ(region.covers[1].hand, Hand::clockwise);
    for (const Piece& piece : region.covers[1].pieces)
      EXPECT_EQ(counterClockwise.contains(piece.camera), automatic);
  }
  EXPECT_GT(inner, 3);
}

TEST(CoverOfAGap, EveryPointOutsideIsHeldByTheGapsOwnCornersAsOftenAsTheConfigurationSays) {
  // By all the cameras that stand at the gap's corners: once in b, twice in a and d, 3 times in g, 4 in f.
  for (const auto& [configuration, times] :
       {std::pair{Configuration::a, 2}, std::pair{Configuration::b, 1}, std::pair{Configuration::d, 2},
        std::pair{Configuration::f, 4}, std::pair{Configuration::g, 3}}) {
    const Layout layout = makeLayout(configuration, {2, {0.1, 0.2}, 0.3}, 4);
    Random random(5);
    int gaps = 0, points = 0;
    for (const Region& gap : layout.regions) {
      if (gap.kind == RegionKind::ring || glm::length(gap.polygon.centroid()) > 4) continue;
      ++gaps;
      std::set<int> cameras;
      for (const LayoutCamera& camera : layout.cameras)
        for (const glm::dvec2& corner : gap.polygon.corners)
          if (camera.position == corner) cameras.insert(static_cast<int>(&camera - layout.cameras.data()));
      for (int n = 0; n < 4000; ++n) {
        const glm::dvec2 point = gap.polygon.centroid() + glm::dvec2(random(-30, 30), random(-30, 30));
        if (gap.polygon.containsClosed(point)) continue;
        const auto held = std::ranges::count_if(cameras, [&](int c) {
          const LayoutCamera& camera = layout.cameras[std::size_t(c)];
          const glm::dvec2 to = point - camera.position;
          return wrapAngle(std::atan2(to.y, to.x) - camera.lowAzimuth) < camera.fovRadians;
        });
        ASSERT_EQ(held, times) << nameOf(configuration);
        ++points;
      }
    }
    EXPECT_GT(gaps, 2);
    EXPECT_GT(points, 8000);
  }
}

TEST(CoverOfAGap, GapTrianglesHaveThreeWedgesAndThreeStripsOfSixCameras) {
  const Layout layout = makeLayout(Configuration::b);
  int triangles = 0;
  for (const Region& region : layout.regions) {
    if (region.kind != RegionKind::gapTriangle) continue;
    ++triangles;
    ASSERT_EQ(region.covers.size(), 1u);
    EXPECT_EQ(region.covers[0].wedges, 3);
    std::set<int> cameras;
    for (const Piece& piece : region.covers[0].pieces) cameras.insert(piece.camera);
    EXPECT_EQ(cameras.size(), 6u);
  }
  EXPECT_GT(triangles, 2);
}

TEST(Cameras, StandAtEachCornerAsTheConfigurationSays) {
  // Captured cameras are at most 60 degrees wide: 8 for the panorama of e, 6 for that of g, 4 where two of 90
  // or 120 degrees stand (d, f).
  constexpr int kExpected[] = {4, 2, 6, 4, 8, 4, 6};
  for (const Configuration configuration : kAllConfigurations) {
    const Layout layout = makeLayout(configuration, {}, 5);
    std::map<std::tuple<int, int, int>, int> perCorner;
    for (const LayoutCamera& camera : layout.cameras)
      ++perCorner[{camera.id.i, camera.id.j, camera.id.corner}];
    int most = 0;
    for (const auto& [corner, count] : perCorner) most = std::max(most, count);
    EXPECT_EQ(most, kExpected[int(configuration)]) << nameOf(configuration);
  }
}

TEST(Cameras, AreSortedUniqueAndIndependentOfTheNeighboursPlaced) {
  for (const Configuration configuration : kAllConfigurations) {
    const Layout many = makeLayout(configuration, {2, {3, 1}, 0.4}, 4);
    EXPECT_TRUE(std::ranges::is_sorted(many.cameras, std::ranges::less_equal{}, &LayoutCamera::id));
    for (std::size_t k = 1; k < many.cameras.size(); ++k)
      EXPECT_LT(many.cameras[k - 1].id, many.cameras[k].id);
    LayoutSpec alone = many.spec;
    alone.outline = {};
    alone.added = {many.regions[many.regions.size() / 2].id};
    const Layout one = buildLayout(alone).value();
    ASSERT_EQ(one.regions.size(), 1u);
    for (const LayoutCamera& camera : one.cameras) {
      const auto same = std::ranges::find(many.cameras, camera.id, &LayoutCamera::id);
      ASSERT_NE(same, many.cameras.end());
      EXPECT_EQ(camera.position, same->position);
      EXPECT_EQ(camera.lowAzimuth, same->lowAzimuth);
      ASSERT_EQ(camera.roles.size(), same->roles.size());
      for (std::size_t s = 0; s < camera.roles.size(); ++s) {
        EXPECT_EQ(camera.roles[s].region, same->roles[s].region);
        EXPECT_EQ(camera.roles[s].grown.corners, same->roles[s].grown.corners);
      }
    }
  }
}

TEST(Cameras, ServeTheRegionsAroundThemGrownByTheNearBand) {
  const Layout layout = makeLayout(Configuration::b, {}, 4);
  for (const Region& region : layout.regions)
    for (const Cover& cover : region.covers)
      for (const Piece& piece : cover.pieces) {
        const LayoutCamera& camera = layout.cameras[std::size_t(piece.camera)];
        EXPECT_EQ(camera.roles.size(), 4u) << "two hexagons and two triangles meet at a kagome corner";
        const Role& role = camera.roles[std::size_t(piece.role)];
        EXPECT_EQ(role.region, region.id);
        EXPECT_EQ(role.polygon.corners, region.polygon.corners);
        EXPECT_EQ(role.grown.corners, region.grown.corners);
      }
  for (const LayoutCamera& camera : makeLayout(Configuration::e).cameras) EXPECT_EQ(camera.roles.size(), 2u);
}

TEST(Cameras, HaveARoleForEachPartThatARegionDrawsAndABitForEachRole) {
  for (const Configuration configuration : kAllConfigurations) {
    const Layout layout = makeLayout(configuration, {}, 4);
    for (const LayoutCamera& camera : layout.cameras) {
      ASSERT_FALSE(camera.roles.empty());
      EXPECT_EQ(roleBit(camera, -1), 0xff);
      std::uint8_t all = 0;
      for (int role = 0; role < int(camera.roles.size()); ++role) {
        EXPECT_EQ(std::popcount(roleBit(camera, role)), 1);
        EXPECT_EQ(all & roleBit(camera, role), 0) << "configuration " << nameOf(configuration);
        all |= roleBit(camera, role);
      }
    }
    for (const Region& region : layout.regions)
      for (const Cover& cover : region.covers)
        for (const Piece& piece : cover.pieces) {
          const Role& role = layout.cameras[std::size_t(piece.camera)].roles[std::size_t(piece.role)];
          EXPECT_EQ(role.region, region.id);
          EXPECT_EQ(role.clip, piece.clip);
        }
  }
}

TEST(Cameras, ShareOutTheirBitsWhereTheyHaveMoreRoles) {
  LayoutCamera camera;
  camera.roles.resize(20);
  std::array<int, kRoleBits> uses{};
  for (int role = 0; role < 20; ++role) ++uses[std::size_t(std::countr_zero(roleBit(camera, role)))];
  for (const int n : uses) EXPECT_TRUE(n == 2 || n == 3) << n;
}

}  // namespace
}  // namespace acentric
