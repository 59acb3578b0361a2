#include "engine/layout/apv.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/layout/ring_order.h"
#include "tests/layout/layout_fixtures.h"

namespace acentric {
namespace {
using test::crossedAlongRay;
using test::Random;

const int kCameraCounts[] = {3, 4, 6, 8, 12};

/// Every n, both hands, at several sizes, offsets and turns.
template <class Visit>
void forEachApv(const Visit& visit) {
  for (const int n : kCameraCounts)
    for (const Hand hand : {Hand::counterClockwise, Hand::clockwise})
      for (const double radius : {1e-3, 1.0, 1e4})
        for (const glm::dvec2& centre : {glm::dvec2(0), glm::dvec2(3, -2), glm::dvec2(5e6, -5e6)}) {
          if (glm::length(centre) > 1e6 && radius < 1) continue;  // a millimetre is 1e6 ulp there
          visit(Apv{centre, radius * directionOf(0.3 * n), 360.0 / n, hand});
        }
}

TEST(Apv, SectorsTileTheOutsideExactlyOnce) {
  Random random(31);
  forEachApv([&](const Apv& apv) {
    ASSERT_TRUE(apv.check());
    const Cover cover = coverOf(apv);
    const ConvexPolygon polygon = polygonOf(apv);
    for (int k = 0; k < 500; ++k) {
      const double reach = glm::length(apv.offset) * std::pow(10.0, random(0, 3));
      const glm::dvec2 point = apv.centre + glm::dvec2(random(-reach, reach), random(-reach, reach));
      if (polygon.containsClosed(point)) continue;
      ASSERT_EQ(std::ranges::count_if(cover.pieces, [&](const Piece& p) { return p.holds(point); }), 1);
    }
  });
}

TEST(Apv, EachCameraLooksAlongTheOffsetTurnedByNinetyDegrees) {
  forEachApv([](const Apv& apv) {
    const double quarter = apv.hand == Hand::counterClockwise ? kPi / 2 : -kPi / 2;
    const double tolerance = 1e-12 + 1e-15 * glm::length(apv.centre) * 100 / glm::length(apv.offset);
    const Cover cover = coverOf(apv);
    for (const Piece& piece : cover.pieces) {
      const glm::dvec2 middle =
          glm::normalize(glm::normalize(piece.low.direction()) + glm::normalize(piece.high.direction()));
      const glm::dvec2 offset = piece.apex - apv.centre;
      const double expected = std::atan2(offset.y, offset.x) + quarter;
      EXPECT_LT(glm::distance(middle, directionOf(expected)), tolerance);
      const double span =
          std::acos(glm::dot(glm::normalize(piece.low.direction()), glm::normalize(piece.high.direction())));
      EXPECT_NEAR(degrees(span), apv.fovDegrees, 1e-6);
    }
  });
}

TEST(Apv, RaysCrossDecreasingIndicesCounterClockwiseAndIncreasingOnesClockwise) {
  Random random(32);
  int severalCrossed = 0;
  for (const int n : kCameraCounts)
    for (const Hand hand : {Hand::counterClockwise, Hand::clockwise}) {
      const Apv apv{{1, 2}, {0.7, 0.9}, 360.0 / n, hand};
      Region region;
      region.polygon = polygonOf(apv);
      const Cover cover = coverOf(apv);
      for (int k = 0; k < 2000; ++k) {
        const auto crossed = crossedAlongRay(region, cover, random.within(region.polygon),
                                             directionOf(random(0, kTwoPi)), 1e-9);
        ASSERT_FALSE(crossed.empty());
        severalCrossed += crossed.size() > 1 ? 1 : 0;
        for (std::size_t c = 1; c < crossed.size(); ++c)
          ASSERT_EQ(crossed[c], (crossed[c - 1] + (hand == Hand::counterClockwise ? n - 1 : 1)) % n);
      }
    }
  EXPECT_GT(severalCrossed, 5000);
}

TEST(Apv, TheOrderOfARingServesAnyNumberOfCamerasAtAnyScale) {
  Random random(33);
  forEachApv([&](const Apv& apv) {
    Region region;
    region.polygon = polygonOf(apv);
    const Cover cover = coverOf(apv);
    const double sliver = 1e-7 * glm::length(apv.offset) + 1e-14 * glm::length(apv.centre);
    for (int k = 0; k < 40; ++k) {
      const ViewSector sector{random.within(region.polygon), {random(0, kTwoPi), random(0.01, kPi)}};
      std::vector<int> painted;
      for (const OrderedPiece& piece : orderRing(cover, sector)) painted.push_back(piece.camera);
      for (int ray = 0; ray < 8; ++ray) {
        const double azimuth = sector.azimuths.low + sector.azimuths.width * random(1e-6, 1 - 1e-6);
        auto expected = crossedAlongRay(region, cover, sector.eye, directionOf(azimuth), sliver);
        std::ranges::reverse(expected);
        std::vector<int> relevant;
        for (const int camera : painted)
          if (std::ranges::find(expected, camera) != expected.end()) relevant.push_back(camera);
        ASSERT_EQ(relevant, expected) << cover.pieces.size() << " cameras";
      }
    }
  });
}

TEST(Apv, WithoutOffsetItIsATraditionalPanorama) {
  Random random(34);
  for (const int n : kCameraCounts)
    for (const Hand hand : {Hand::counterClockwise, Hand::clockwise}) {
      const Apv tpv{{4, 5}, {0, 0}, 360.0 / n, hand};
      ASSERT_TRUE(tpv.check());
      EXPECT_TRUE(polygonOf(tpv).corners.empty());
      const Cover cover = coverOf(tpv);
      ASSERT_EQ(cover.pieces.size(), std::size_t(n));
      for (int k = 0; k < 500; ++k) {
        const glm::dvec2 point = tpv.centre + random(1e-6, 100) * directionOf(random(0, kTwoPi));
        EXPECT_EQ(std::ranges::count_if(cover.pieces, [&](const Piece& p) { return p.holds(point); }), 1);
      }
      // All round from the centre itself: every camera; again only at the view's ends and where it is split.
      std::vector<int> times(std::size_t(n), 0);
      const auto ordered = orderRing(cover, {tpv.centre, {0.1, kTwoPi}});
      for (const OrderedPiece& piece : ordered) ++times[std::size_t(piece.camera)];
      for (const int count : times) EXPECT_GE(count, 1);
      EXPECT_LE(ordered.size(), std::size_t(n) + 2);
    }
}

TEST(Apv, RefusesAFieldOfViewThatDoesNotClose) {
  for (const double fov : {0.0, -60.0, 50.0, 59.999, 180.0, 360.0, double(NAN), double(INFINITY)})
    EXPECT_FALSE((Apv{{0, 0}, {1, 0}, fov, Hand::clockwise}.check())) << fov;
  EXPECT_FALSE((Apv{{NAN, 0}, {1, 0}, 60, Hand::clockwise}.check()));
  EXPECT_TRUE((Apv{{0, 0}, {1, 0}, 360.0 / 7, Hand::clockwise}.check()));
}

}  // namespace
}  // namespace acentric
