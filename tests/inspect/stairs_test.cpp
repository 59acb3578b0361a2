#include "engine/inspect/stairs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/inspect/box_world.h"

namespace acentric {
namespace {
using test::BoxWorld;
using testing::HasSubstr;

/// Ground floor 10 x 4 m at 0, open to an upper floor at `rise`, which begins at x = `end`; between them,
/// from x = `begin` on, what is added. Walls all round.
BoxWorld hall(double end, double rise) {
  BoxWorld world = BoxWorld::room(12, 4, rise + 3);
  world.boxes.push_back({{end, 0, rise - 0.2}, {12, 4, rise}});
  return world;
}

/// Solid steps over y 1..3.
void addFlight(BoxWorld& world, double begin, double tread, double riser, int steps) {
  for (int k = 0; k < steps; ++k)
    world.boxes.push_back({{begin + tread * k, 1, 0}, {begin + tread * (k + 1), 3, riser * (k + 1)}});
}

struct Found {
  Storeys storeys;
  std::vector<StairPiece> pieces;
};

Found stairsOf(const BoxWorld& world, double pieceRise = 0.3) {
  StoreyOptions options;
  options.walkable.gridStep = 0.2;
  auto storeys = findStoreys(world.bounds(), options, world.probe());
  EXPECT_TRUE(storeys) << (storeys ? "" : storeys.error().describe());
  if (!storeys) return {};
  EXPECT_EQ(storeys->ways.size(), 1u);
  if (storeys->ways.empty()) return {std::move(*storeys), {}};
  StairOptions stairs;
  stairs.pieceRise = pieceRise;
  auto pieces = findStairs(world.bounds(), *storeys, storeys->ways[0], stairs, world.probe());
  EXPECT_TRUE(pieces) << (pieces ? "" : pieces.error().describe());
  return {std::move(*storeys), pieces ? std::move(*pieces) : std::vector<StairPiece>{}};
}

double groundOf(const StairPiece& piece, const glm::dvec2& place) {
  return piece.floorHeight + glm::dot(piece.slope.rise, place - piece.slope.at);
}

bool holds(const StairPiece& piece, const glm::dvec2& place) { return piece.outline.contains(place); }

/// From x = a to b along the middle, every place is a piece's whose ground is near `truth`, and pieces change
/// without a jump.
template <class Truth>
void expectGround(const std::vector<StairPiece>& pieces, double a, double b, double within,
                  const Truth& truth) {
  for (double x = a; x <= b; x += 0.02) {
    const glm::dvec2 place(x, 2);
    double least = 1e9;
    int held = 0;
    for (const StairPiece& piece : pieces)
      if (holds(piece, place)) ++held, least = std::min(least, std::abs(groundOf(piece, place) - truth(x)));
    ASSERT_GE(held, 1) << "no piece at x = " << x;
    EXPECT_LT(least, within) << "x = " << x;
  }
}

TEST(Stairs, OfAFlightAreAChainOfPiecesThatRiseEvenly) {
  BoxWorld world = hall(2 + 0.28 * 15, 0.18 * 15);
  addFlight(world, 2, 0.28, 0.18, 15);  // 2.7 m up over 4.2 m
  const auto [storeys, pieces] = stairsOf(world);
  ASSERT_GE(pieces.size(), 8u);
  ASSERT_LE(pieces.size(), 12u);
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const StairPiece& piece = pieces[p];
    EXPECT_GT(piece.outline.area(), 0.5);
    EXPECT_GT(piece.floorHeight, 0);
    EXPECT_LT(piece.floorHeight, 2.7);
    if (p > 0) {
      EXPECT_GT(piece.floorHeight, pieces[p - 1].floorHeight);
      EXPECT_LT(piece.floorHeight - pieces[p - 1].floorHeight, 0.33);
    }
    if (p < 2 || p + 2 >= pieces.size()) continue;  // it begins and ends gently
    EXPECT_NEAR(piece.slope.rise.x, 0.18 / 0.28, 0.06);
    EXPECT_NEAR(piece.slope.rise.y, 0, 0.02);
    // 2 m wide, less 0.2 m... of no wall: the flight stands free.
    EXPECT_TRUE(holds(piece, {piece.slope.at.x, 1.3}));
    EXPECT_TRUE(holds(piece, {piece.slope.at.x, 2.7}));
  }
  // The smoothed steps run through the middles of the treads.
  expectGround(pieces, 2.1, 6.0, 0.06,
               [](double x) { return std::clamp((x - 1.86) * 0.18 / 0.28, 0.0, 2.7); });
  // They reach over the floors at both ends.
  EXPECT_TRUE(storeys.planes[0].outline.contains({1.9, 2}) || holds(pieces.front(), {1.9, 2}));
  EXPECT_TRUE(holds(pieces.back(), {6, 2}));
}

TEST(Stairs, OfARampFollowIt) {
  const double slope = 0.1125;
  BoxWorld world = hall(9, 0.9);
  world.addQuad({1, 1, 0}, {9, 1, 0.9}, {9, 3, 0.9}, {1, 3, 0});
  const auto [storeys, pieces] = stairsOf(world);
  ASSERT_GE(pieces.size(), 3u);
  ASSERT_LE(pieces.size(), 4u);
  for (std::size_t p = 1; p + 1 < pieces.size(); ++p) EXPECT_NEAR(pieces[p].slope.rise.x, slope, 0.005);
  expectGround(pieces, 1.6, 8.5, 0.02, [&](double x) { return slope * (x - 1); });
}

TEST(Stairs, AreNotCutAcrossALanding) {
  BoxWorld world = hall(9, 2.16);
  addFlight(world, 2, 0.28, 0.18, 6);
  world.boxes.push_back(
      {{2 + 6 * 0.28, 1, 0}, {6.3, 3, 6 * 0.18}});  // 2.6 x 2 m, too small for a storey here
  for (int k = 6; k < 12; ++k)
    world.boxes.push_back({{6.3 + 0.28 * (k - 6), 1, 0}, {6.3 + 0.28 * (k - 5), 3, 0.18 * (k + 1)}});
  world.boxes.push_back({{6.3 + 6 * 0.28, 1, 0}, {9, 3, 2.16}});
  StoreyOptions options;
  options.walkable.gridStep = 0.2;
  options.leastShare = 0.2;
  const auto storeys = findStoreys(world.bounds(), options, world.probe());
  ASSERT_TRUE(storeys);
  ASSERT_EQ(storeys->ways.size(), 1u);
  const auto pieces = findStairs(world.bounds(), *storeys, storeys->ways[0], {}, world.probe());
  ASSERT_TRUE(pieces);
  int onLanding = 0;
  for (const StairPiece& piece : *pieces) {
    if (holds(piece, {5, 1.5}) || holds(piece, {5, 2.5})) {
      ++onLanding;
      EXPECT_NEAR(groundOf(piece, {5, 2}), 1.08, 0.08);
      EXPECT_TRUE(holds(piece, {5, 1.5}) && holds(piece, {5, 2.5})) << "whole";
    }
  }
  EXPECT_EQ(onLanding, 1);
  expectGround(*pieces, 2.1, 7.8, 0.2, [](double x) {
    return std::min(std::clamp((x - 1.86) / 0.28, 0.0, 6.0) + std::clamp((x - 6.16) / 0.28, 0.0, 6.0), 12.0) *
           0.18;
  });
}

TEST(Stairs, RiseByLessPerPieceWhereAsked) {
  BoxWorld world = hall(2 + 0.28 * 15, 0.18 * 15);
  addFlight(world, 2, 0.28, 0.18, 15);
  EXPECT_GT(stairsOf(world, 0.15).pieces.size(), 1.7 * double(stairsOf(world, 0.3).pieces.size()));
}

TEST(Stairs, RefuseBadOptions) {
  StairOptions options;
  options.pieceRise = 0;
  ASSERT_FALSE(options.check());
  EXPECT_THAT(options.check().error().message, HasSubstr("0.02..10 m"));
  options.pieceRise = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(options.check());
}

TEST(Stairs, OfAWholeHillAreRefused) {
  const BoxWorld world = hall(6, 2);
  Storeys storeys;
  storeys.planes.resize(2);
  const StoreyWay way{{0, 1}, {-100, -100}, {100, 100}};
  const auto pieces = findStairs(world.bounds(), storeys, way, {}, world.probe());
  ASSERT_FALSE(pieces);
  EXPECT_EQ(pieces.error().kind, ErrorKind::tooLarge);
  EXPECT_THAT(pieces.error().message, HasSubstr("202 x 202 m"));
}

}  // namespace
}  // namespace acentric
