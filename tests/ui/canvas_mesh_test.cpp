#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/ui/offscreen.h"
#include "ui/mark_mesh.h"
#include "ui/polygon_mesh.h"

namespace acentric::ui {
namespace {

using test::kBlack, test::kGreen, test::kPureGreen, test::kPureRed, test::kRed, test::kSize;
/// So many pixels per metre around a point.
CanvasView viewAt(const glm::dvec2& centre, double pixelsPerMetre) {
  CanvasView view;
  view.setArea({0, 0}, {kSize, kSize});
  const glm::dvec2 half(0.5 * kSize / pixelsPerMetre);
  view.fit(centre - half, centre + half, 0);
  return view;
}

std::vector<glm::dvec2> squareAt(const glm::dvec2& low, double size) {
  return {low, {low.x + size, low.y}, low + size, {low.x, low.y + size}};
}

class CanvasMesh : public testing::Test {
 protected:
  void SetUp() override {
    if (!screen_.works()) GTEST_SKIP() << "no OpenGL here";
  }
  test::Offscreen screen_{kSize, kSize};
};

TEST(CanvasTiles, HoldEveryThingOnceAndWithinTheirBoxes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-300, 900), size(0, 4);
  std::vector<CanvasBox> boxes(5000);
  for (CanvasBox& box : boxes) {
    box.low = {5e6 + place(random), place(random)};
    box.high = box.low + glm::dvec2(size(random), size(random));
  }
  const CanvasTiles tiles = tilesOf(boxes, 100);
  std::vector<std::uint32_t> seen = tiles.order;
  std::ranges::sort(seen);
  for (std::uint32_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], i);
  EXPECT_EQ(seen.size(), boxes.size());
  std::uint32_t next = 0;
  for (const CanvasTile& tile : tiles.tiles) {
    EXPECT_EQ(tile.first, next);
    next += tile.count;
    for (std::uint32_t n = tile.first; n < next; ++n) {
      EXPECT_TRUE(glm::all(glm::greaterThanEqual(boxes[tiles.order[n]].low, tile.box.low)));
      EXPECT_TRUE(glm::all(glm::lessThanEqual(boxes[tiles.order[n]].high, tile.box.high)));
    }
    // Near its origin, wherever the plan lies: that is what makes single precision do.
    EXPECT_LT(glm::length(tile.box.high - tile.origin), 300);
  }
  EXPECT_EQ(next, boxes.size());
  EXPECT_GT(tiles.tiles.size(), 30U);
  EXPECT_LT(tiles.tiles.size(), 120U);
}

TEST(CanvasTiles, OfOneThingOrOfThingsInALineAreFew) {
  EXPECT_TRUE(tilesOf({}).tiles.empty());
  EXPECT_EQ(tilesOf(std::vector<CanvasBox>{{{3, 4}, {5, 6}}}).tiles.size(), 1U);
  std::vector<CanvasBox> line;
  for (int i = 0; i < 2000; ++i) line.push_back({{i, 0}, {i + 1, 0}});
  std::uint32_t held = 0;
  const CanvasTiles tiles = tilesOf(line, 100);
  for (const CanvasTile& tile : tiles.tiles) held += tile.count;
  EXPECT_EQ(held, 2000U);
}

TEST_F(CanvasMesh, FillsAPolygonOnItsPixelsFarFromTheOriginAndAtEveryZoom) {
  for (const glm::dvec2& at : {glm::dvec2(0), glm::dvec2(5e6, -3e6)})
    for (const double zoom : {0.5, 40.0, 2e4}) {
      PolygonMesh mesh;
      // Covers the right half of the window, the upper half of that in green.
      const double half = 0.5 * kSize / zoom;
      std::vector<glm::dvec2> corners = squareAt({at.x, at.y - half}, half);
      std::ranges::copy(squareAt(at, half), std::back_inserter(corners));
      const std::vector<std::uint32_t> ends{4, 8};
      mesh.setShapes(corners, ends);
      mesh.setStyles(std::vector<PolygonStyle>{{kRed, 0, 1}, {kGreen, 0, 1}});
      screen_.clear();
      mesh.render(viewAt(at, zoom), screen_.target(), 1);
      ASSERT_TRUE(mesh.problem().empty()) << mesh.problem();
      screen_.read();
      EXPECT_EQ(screen_.at(63, 30), kBlack) << at.x << " " << zoom;
      EXPECT_EQ(screen_.at(64, 30), kPureGreen) << at.x << " " << zoom;
      EXPECT_EQ(screen_.at(100, 63), kPureGreen) << at.x << " " << zoom;
      EXPECT_EQ(screen_.at(100, 64), kPureRed) << at.x << " " << zoom;
    }
}

TEST_F(CanvasMesh, TakesNewColoursWithoutNewShapes) {
  PolygonMesh mesh;
  const std::vector<std::uint32_t> ends{4};
  mesh.setShapes(squareAt({-1, -1}, 2), ends);
  for (const auto& [fill, expected] : {std::pair(kRed, kPureRed), std::pair(kGreen, kPureGreen)}) {
    mesh.setStyles(std::vector<PolygonStyle>{{fill, 0, 1}});
    screen_.clear();
    mesh.render(viewAt({0, 0}, 10), screen_.target(), 1);
    screen_.read();
    EXPECT_EQ(screen_.at(64, 64), expected);
  }
}

TEST_F(CanvasMesh, KeepsTheWidthOfLinesInPixelsAndFadesThem) {
  PolygonMesh mesh;
  const std::vector<std::uint32_t> ends{4};
  mesh.setShapes(squareAt({0, -1000}, 2000), ends);
  mesh.setStyles(std::vector<PolygonStyle>{{0, kGreen, 4}});
  for (const double zoom : {2.0, 200.0}) {
    screen_.clear();
    mesh.render(viewAt({0, 0}, zoom), screen_.target(), 1);
    screen_.read();
    int lit = 0;
    for (int x = 0; x < kSize; ++x) lit += screen_.at(x, 64).g;
    EXPECT_NEAR(lit / 255.0, 4, 0.05) << zoom;
    EXPECT_EQ(screen_.at(63, 64), kPureGreen);
  }
  screen_.clear();
  mesh.render(viewAt({0, 0}, 2), screen_.target(), 0.5F);
  screen_.read();
  EXPECT_NEAR(screen_.at(63, 64).g, 128, 2);
}

TEST_F(CanvasMesh, DrawsDotsOfTheSamePixelsAtEveryZoomEachInItsColour) {
  MarkMesh mesh;
  mesh.setPlaces(std::vector<CanvasMark>{{{5e6, 0}, 0, 0}, {{5e6 + 1e-3, 0}, 0, 0}});
  mesh.setColours(std::vector<ImU32>{kRed, kGreen});
  screen_.clear();
  mesh.render(viewAt({5e6, 0}, 2e4), screen_.target(), {5, {0, 0, 1, 1}, 0, 1});  // 20 pixels apart
  ASSERT_TRUE(mesh.problem().empty()) << mesh.problem();
  screen_.read();
  EXPECT_EQ(screen_.at(64, 64), kPureRed);
  EXPECT_EQ(screen_.at(84, 64), kPureGreen);
  EXPECT_EQ(screen_.at(64 + 3, 64), kPureRed);
  EXPECT_GT(screen_.at(64 + 5, 64).b, 200);  // the rim
  EXPECT_EQ(screen_.at(64 + 7, 64), kBlack);
}

TEST_F(CanvasMesh, DrawsSectorsWhereTheyLook) {
  MarkMesh mesh;
  mesh.setPlaces(std::vector<CanvasMark>{{{0, 0}, 0, 1.57079633F}});  // to the upper right
  mesh.setColours(std::vector<ImU32>{kGreen});
  screen_.clear();
  mesh.render(viewAt({0, 0}, 10), screen_.target(), {0, {0, 0, 0, 1}, 40, 1});
  screen_.read();
  EXPECT_NEAR(screen_.at(64 + 15, 64 - 15).g, 0.22 * 255, 2);
  for (const auto& [x, y] : {std::pair(-15, -15), std::pair(15, 15), std::pair(-15, 15), std::pair(40, -40)})
    EXPECT_EQ(screen_.at(64 + x, 64 + y), kBlack) << x << " " << y;
  EXPECT_GT(screen_.at(64 + 28, 64 - 28).g, 100);  // the arc
}

}  // namespace
}  // namespace acentric::ui
