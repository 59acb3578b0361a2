#include "engine/geometry/convex_polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/geometry/conventions.h"
#include "engine/geometry/predicates/orientation.h"

namespace acentric {
namespace {

ConvexPolygon regular(int n, const glm::dvec2& centre, double radius, double turn = 0) {
  ConvexPolygon polygon;
  for (int k = 0; k < n; ++k) polygon.corners.push_back(centre + radius * directionOf(turn + kTwoPi * k / n));
  return polygon;
}

/// A grid of points moved at random, each square cut into two triangles: neighbours share corners bit by bit.
std::vector<ConvexPolygon> randomTriangulation(const glm::dvec2& origin, double size, int cells) {
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  std::vector<std::vector<glm::dvec2>> points;
  for (int y = 0; y <= cells; ++y) {
    points.emplace_back();
    for (int x = 0; x <= cells; ++x)
      points.back().push_back(
          origin + size * glm::dvec2(x + (x % 2 ? jitter(engine) : 0), y + (y % 2 ? jitter(engine) : 0)));
  }
  std::vector<ConvexPolygon> triangles;
  for (std::size_t y = 0; y + 1 < points.size(); ++y)
    for (std::size_t x = 0; x + 1 < points[y].size(); ++x) {
      triangles.push_back({{points[y][x], points[y][x + 1], points[y + 1][x + 1]}});
      triangles.push_back({{points[y][x], points[y + 1][x + 1], points[y + 1][x]}});
    }
  return triangles;
}

TEST(Orientation, IsExactWhereRoundingWouldErr) {
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {0.5, 1e-300}), 1);
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {0.5, -1e-300}), -1);
  // Three points of the line y = x / 3 up to rounding: the sign is that of the rounded coordinates.
  const glm::dvec2 a(0, 0), b(3, 1), c(0.3, 0.1);
  const long double sign = 3.0L * 0.1 - 1.0L * 0.3;  // exact in 64 bits of significand
  EXPECT_EQ(orientation(a, b, c), sign > 0 ? 1 : sign < 0 ? -1 : 0);
  // Far away, one ulp off a diagonal.
  const glm::dvec2 p(5e6, 5e6), q(5e6 + 1, 5e6 + 1), r(5e6 + 0.5, 5e6 + 0.5);
  EXPECT_EQ(orientation(p, q, r), 0);
  EXPECT_EQ(orientation(p, q, {r.x, std::nextafter(r.y, INFINITY)}), 1);
  EXPECT_EQ(orientation(p, q, {r.x, std::nextafter(r.y, -INFINITY)}), -1);
  EXPECT_EQ(orientation(p, q, {NAN, 0}), 0);
}

TEST(ConvexPolygon, HasTheAreaAndCentroidOfARegularPolygon) {
  for (const glm::dvec2& centre : {glm::dvec2(0), glm::dvec2(5e6, -5e6)}) {
    const ConvexPolygon hexagon = regular(6, centre, 2);
    EXPECT_NEAR(hexagon.area(), 1.5 * std::sqrt(3.0) * 4, 1e-7);
    EXPECT_LT(glm::distance(hexagon.centroid(), centre), 1e-8);
  }
  EXPECT_EQ(ConvexPolygon{}.area(), 0);
}

TEST(ConvexPolygon, EachPointOfATessellationBelongsToExactlyOnePolygon) {
  for (const auto& [origin, size] :
       {std::pair{glm::dvec2(0), 1.0}, std::pair{glm::dvec2(5e6, -5e6), 1.0},
        std::pair{glm::dvec2(0.1, 0.2), 1e-3}, std::pair{glm::dvec2(-7, 3), 1e4}}) {
    constexpr int kCells = 8;
    const auto triangles = randomTriangulation(origin, size, kCells);
    std::vector<glm::dvec2> points;
    std::mt19937 engine(6);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const ConvexPolygon& t : triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        points.push_back(t.corners[k]);
        points.push_back(0.5 * (t.corners[k] + t.corners[(k + 1) % 3]));
        points.push_back(t.corners[k] + unit(engine) * (t.corners[(k + 1) % 3] - t.corners[k]));
      }
    const glm::dvec2 low = origin + size * 1.5, high = origin + size * (kCells - 1.5);
    for (const glm::dvec2& exact : points)
      for (int dx = -1; dx <= 1; ++dx)
        for (int dy = -1; dy <= 1; ++dy) {
          glm::dvec2 p = exact;
          if (dx != 0) p.x = std::nextafter(p.x, dx * double(INFINITY));
          if (dy != 0) p.y = std::nextafter(p.y, dy * double(INFINITY));
          if (p.x < low.x || p.y < low.y || p.x > high.x || p.y > high.y) continue;
          int holders = 0, closed = 0;
          for (const ConvexPolygon& t : triangles) {
            holders += t.contains(p) ? 1 : 0;
            closed += t.containsClosed(p) ? 1 : 0;
            EXPECT_TRUE(!t.contains(p) || t.containsClosed(p));
          }
          ASSERT_EQ(holders, 1);
          EXPECT_GE(closed, 1);
        }
  }
}

TEST(ConvexPolygon, GrowsByMovingEdges) {
  const ConvexPolygon square{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}};
  const ConvexPolygon grown = square.grown(0.5);
  EXPECT_NEAR(grown.area(), 9, 1e-12);
  EXPECT_LT(glm::distance(grown.corners[0], {-0.5, -0.5}), 1e-12);
  EXPECT_NEAR(square.grown(-0.25).area(), 2.25, 1e-12);
  EXPECT_TRUE(square.grown(-1.01).corners.empty());
  EXPECT_EQ(square.grown(0).corners, square.corners);
  // A thin rectangle vanishes before a square of its length would.
  EXPECT_TRUE((ConvexPolygon{{{0, 0}, {10, 0}, {10, 1}, {0, 1}}}).grown(-0.6).corners.empty());
  const ConvexPolygon triangle = regular(3, {1, 2}, 1, 0.3);
  const double inRadius = 0.5;
  EXPECT_NEAR(triangle.grown(1).area() / triangle.area(), std::pow((inRadius + 1) / inRadius, 2), 1e-9);
}

TEST(ConvexPolygon, RaySpansTouchTheBorderTwice) {
  const ConvexPolygon square{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}};
  const auto through = square.raySpan({-1, 1}, {1, 0});
  ASSERT_TRUE(through);
  EXPECT_DOUBLE_EQ(through->first, 1);
  EXPECT_DOUBLE_EQ(through->second, 3);
  const auto inside = square.raySpan({1, 1}, {0, 1});
  ASSERT_TRUE(inside);
  EXPECT_EQ(inside->first, 0);
  EXPECT_DOUBLE_EQ(inside->second, 1);
  EXPECT_FALSE(square.raySpan({-1, 3}, {1, 0}));
  EXPECT_FALSE(square.raySpan({3, 1}, {1, 0}));
  EXPECT_FALSE(ConvexPolygon{}.raySpan({0, 0}, {1, 0}));
}

TEST(ConvexPolygon, TheNearestPointIsOnTheBorderOrThePointItself) {
  const ConvexPolygon square{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}};
  EXPECT_EQ(square.nearestPoint({1, 1}), glm::dvec2(1, 1));
  EXPECT_EQ(square.nearestPoint({5, 1}), glm::dvec2(2, 1));
  EXPECT_EQ(square.nearestPoint({5, 5}), glm::dvec2(2, 2));
  EXPECT_EQ(square.nearestPoint({2, 2}), glm::dvec2(2, 2));
}

TEST(ConvexPolygon, OverlapCountsTouching) {
  const ConvexPolygon square{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}};
  EXPECT_TRUE(overlap(square, {{{2, 2}, {3, 2}, {3, 3}}}));
  EXPECT_TRUE(overlap(square, {{{0.5, 0.5}, {1, 0.5}, {1, 1}}}));
  EXPECT_FALSE(overlap(square, {{{std::nextafter(2.0, 3.0), 0}, {3, 0}, {3, 1}}}));
  // Boxes overlap, the polygons do not.
  EXPECT_FALSE(overlap({{{0, 0}, {4, 0}, {0, 4}}}, {{{4, 4}, {2.1, 4}, {4, 2.1}}}));
  EXPECT_FALSE(overlap(square, {}));
}

}  // namespace
}  // namespace acentric
