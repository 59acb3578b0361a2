#include "engine/geometry/outline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace acentric {
namespace {
using testing::HasSubstr;

Outline squareWithHole() { return {{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{1, 1}, {3, 1}, {3, 3}, {1, 3}}}}; }

TEST(Outline, HolesAreTakenOffWhateverTheirDirection) {
  Outline outline = squareWithHole();
  EXPECT_DOUBLE_EQ(outline.area(), 12);
  std::ranges::reverse(outline.loops[1]);
  EXPECT_DOUBLE_EQ(outline.area(), 12);
  EXPECT_TRUE(outline.contains({0.5, 0.5}));
  EXPECT_FALSE(outline.contains({2, 2}));
  EXPECT_FALSE(outline.contains({5, 2}));
}

TEST(Outline, ALoopThatCrossesItselfHasItsEvenOddArea) {
  const Outline bowTie{{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}}};
  EXPECT_DOUBLE_EQ(bowTie.area(), 2);
  EXPECT_TRUE(bowTie.contains({0.2, 1}));
  EXPECT_FALSE(bowTie.contains({1, 0.2}));
}

TEST(Outline, TheAreaIsTheShareOfPointsInside) {
  const Outline star{
      {{{0, 3}, {-2, -3}, {3, 1}, {-3, 1}, {2, -3}}, {{-4, -4}, {4, -4}, {4, -3.5}, {-4, -3.5}}}};
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> place(-4, 4);
  int inside = 0;
  constexpr int kPoints = 200000;
  for (int n = 0; n < kPoints; ++n) inside += star.contains({place(engine), place(engine)}) ? 1 : 0;
  EXPECT_NEAR(star.area(), 64.0 * inside / kPoints, 0.2);
}

TEST(Outline, OverlapsWhatSharesAreaAndNotWhatOnlyTouches) {
  const Outline outline = squareWithHole();
  EXPECT_TRUE(outline.overlaps({{{-1, -1}, {0.1, -1}, {0.1, 0.1}, {-1, 0.1}}}));
  EXPECT_FALSE(outline.overlaps({{{-1, -1}, {0, -1}, {0, 5}, {-1, 5}}})) << "shares an edge only";
  EXPECT_FALSE(outline.overlaps({{{4, 4}, {5, 4}, {5, 5}}})) << "shares a corner only";
  EXPECT_FALSE(outline.overlaps({{{1.5, 1.5}, {2.5, 1.5}, {2, 2.5}}})) << "lies in the hole";
  EXPECT_FALSE(outline.overlaps({{{1, 1}, {3, 1}, {3, 3}, {1, 3}}})) << "fills the hole";
  EXPECT_TRUE(outline.overlaps({{{0.2, 0.2}, {0.4, 0.2}, {0.3, 0.4}}})) << "lies inside";
  EXPECT_TRUE(outline.overlaps({{{-9, -9}, {9, -9}, {9, 9}, {-9, 9}}})) << "holds the whole outline";
  EXPECT_FALSE(Outline{}.overlaps({{{0, 0}, {1, 0}, {0, 1}}}));
}

TEST(Outline, TheNearestPointOfAHoleIsOnItsBorder) {
  const Outline outline = squareWithHole();
  EXPECT_EQ(outline.nearestPoint({0.5, 0.5}), glm::dvec2(0.5, 0.5));
  EXPECT_EQ(outline.nearestPoint({2, 1.25}), glm::dvec2(2, 1));
  EXPECT_EQ(outline.nearestPoint({9, 9}), glm::dvec2(4, 4));
}

TEST(ParseOutline, ReadsWhatFormatWrites) {
  const Outline outline{{{{0.1, -2e-7}, {4.25, 0}, {1e6 + 0.125, 4}}, {{1, 1}, {3, 1}, {2, 3.3}}}};
  EXPECT_EQ(parseOutline(formatOutline(outline)).value(), outline);
  EXPECT_EQ(parseOutline(" 0,0 ; 4 , 0;\n4,4 ;").value().loops[0].size(), 3u);
  EXPECT_EQ(parseOutline("0,0;4,0;4,4;0,0").value().loops[0].size(), 3u) << "a closing point is not repeated";
}

TEST(ParseOutline, RefusesNonsenseWithTheWayOut) {
  for (const char* text :
       {"", "0,0", "0,0;1,0", "0,0;1,0;x,1", "0,0;1,0;1", "0,0;1,0;nan,1", "0,0;1,0;inf,1", "0,0;1,0;1e999,1",
        "0,0;1,0;1,1/", "0,0;1,0;1,1;2,2,2", "0,0;1,1;2,2", "0,0;0,0;0,0"}) {
    const auto outline = parseOutline(text);
    ASSERT_FALSE(outline) << text;
    EXPECT_EQ(outline.error().kind, ErrorKind::invalidArgument);
    EXPECT_FALSE(outline.error().message.empty());
  }
  EXPECT_THAT(parseOutline("0,0;1,0;x,1").error().describe(), HasSubstr("'x' is not a finite number"));
}

}  // namespace
}  // namespace acentric
