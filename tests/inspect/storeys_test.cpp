#include "engine/inspect/storeys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/inspect/simplify_outline.h"
#include "tests/inspect/box_world.h"

namespace acentric {
namespace {
using test::BoxWorld;
using testing::HasSubstr;

StoreyOptions fine(double gridStep = 0.1) {
  StoreyOptions options;
  options.walkable.gridStep = gridStep;
  return options;
}

Storeys storeysOf(const BoxWorld& world, const StoreyOptions& options = fine()) {
  const Result<Storeys> found = findStoreys(world.bounds(), options, world.probe());
  EXPECT_TRUE(found) << (found ? "" : found.error().describe());
  if (!found) return {};
  for (const WalkPlane& plane : found->planes) EXPECT_TRUE(isSimple(plane.outline));
  return *found;
}

std::vector<double> heightsOf(const Storeys& storeys) {
  std::vector<double> heights;
  for (const WalkPlane& plane : storeys.planes) heights.push_back(plane.height);
  return heights;
}

/// Solid steps up to `top`, each `tread` deep, from x = begin on.
void addStair(BoxWorld& world, double begin, double tread, double rise, int steps, double y0, double y1) {
  for (int k = 0; k < steps; ++k)
    world.boxes.push_back({{begin + tread * k, y0, 0}, {begin + tread * (k + 1), y1, rise * (k + 1)}});
}

/// Ground floor 8 x 6 m at 0, upper floor at 3 m with an opening over x 1..5, y 4..6, roof at 6 m.
BoxWorld twoStoreyHouse(bool withStair) {
  BoxWorld house;
  const double w = 8, d = 6, t = 0.2;
  house.boxes = {
      {{-t, -t, -t}, {w + t, d + t, 0}}, {{-t, -t, 0}, {0, d + t, 6}}, {{w, -t, 0}, {w + t, d + t, 6}},
      {{0, -t, 0}, {w, 0, 6}},           {{0, d, 0}, {w, d + t, 6}},   {{-t, -t, 6}, {w + t, d + t, 6.2}},
      {{0, 0, 2.8}, {w, 4, 3}},          {{0, 4, 2.8}, {1, d, 3}},     {{5, 4, 2.8}, {w, d, 3}}};
  if (withStair) addStair(house, 1.25, 0.25, 0.2, 15, 4.5, 5.5);  // the last step is at 3 m, x 4.75..5
  return house;
}

TEST(Storeys, OfAHouseAreItsFloorsAndItsRoofJoinedByTheStair) {
  const Storeys storeys = storeysOf(twoStoreyHouse(true));
  ASSERT_THAT(heightsOf(storeys),
              testing::ElementsAre(testing::DoubleNear(0, 0.01), testing::DoubleNear(3, 0.01),
                                   testing::DoubleNear(6.2, 0.01)));
  EXPECT_TRUE(storeys.planes[0].outline.contains({6, 2}));
  EXPECT_FALSE(storeys.planes[0].outline.contains({4, 5})) << "the stair fills it";
  EXPECT_NEAR(storeys.planes[2].outline.area(), 8.4 * 6.4, 1.5);
  // Upstairs: 8 x 4 and the two strips beside the opening, less the clearance to the outer walls; the opening
  // itself is no obstacle.
  EXPECT_NEAR(storeys.planes[1].outline.area(), 7.6 * 3.8 + 0.8 * 1.8 + 2.8 * 1.8, 1.5);
  EXPECT_FALSE(storeys.planes[1].outline.contains({3, 5}));
  EXPECT_EQ(storeys.planes[0].coveredShare, 1);
  EXPECT_EQ(storeys.planes[1].coveredShare, 1);
  EXPECT_EQ(storeys.planes[2].coveredShare, 0);
  ASSERT_EQ(storeys.links.size(), 1u);
  EXPECT_EQ(storeys.links[0].lower, 0);
  EXPECT_EQ(storeys.links[0].upper, 1);
  EXPECT_NEAR(storeys.links[0].place.x, 3, 0.5);
  EXPECT_NEAR(storeys.links[0].place.y, 5, 0.1);
  EXPECT_FALSE(storeys.ignoredSides);
}

TEST(Storeys, TheOutsideOfASkyBoxIsNone) {
  BoxWorld land = twoStoreyHouse(true);
  const auto skyAt = [&](double height) {
    BoxWorld world = land;
    const double low = -4, high = 12, t = 0.2;  // floor, four walls and the top, of sheets around the house
    world.boxes.push_back({{low, low, -2 * t}, {high, high, -t}});
    world.boxes.push_back({{low, low, height}, {high, high, height + t}});
    world.boxes.push_back({{low, low, -t}, {low + t, high, height}});
    world.boxes.push_back({{high - t, low, -t}, {high, high, height}});
    world.boxes.push_back({{low, low, -t}, {high, low + t, height}});
    world.boxes.push_back({{low, high - t, -t}, {high, high, height}});
    return heightsOf(storeysOf(world));
  };
  EXPECT_THAT(skyAt(60), testing::Each(testing::Lt(10)));
  EXPECT_THAT(skyAt(60), testing::Contains(testing::DoubleNear(3, 0.01)));
  EXPECT_THAT(skyAt(12), testing::Contains(testing::DoubleNear(12.2, 0.01))) << "a roof is near";
}

TEST(Storeys, AreFoundWithoutAStairToo) {
  const Storeys storeys = storeysOf(twoStoreyHouse(false));
  EXPECT_EQ(storeys.planes.size(), 3u);
  EXPECT_TRUE(storeys.links.empty());
}

TEST(Storeys, AreJoinedByTheSameStairOnACoarseGrid) {
  const Storeys storeys = storeysOf(twoStoreyHouse(true), fine(0.4));
  ASSERT_GE(storeys.planes.size(), 2u);
  ASSERT_EQ(storeys.links.size(), 1u) << "steps between the grid's points are felt for";
  EXPECT_EQ(storeys.links[0].upper, 1);
}

TEST(Storeys, AreNotJoinedByAStairTooSteepToStep) {
  BoxWorld house = twoStoreyHouse(false);
  addStair(house, 1.4, 0.4, 0.3333334, 9, 4.5, 5.5);
  EXPECT_TRUE(storeysOf(house).links.empty());
  StoreyOptions climber = fine();
  climber.walkable.stepHeight = 0.35;
  EXPECT_EQ(storeysOf(house, climber).links.size(), 1u);
}

TEST(Storeys, IncludeAMezzanineAndTheRampToIt) {
  BoxWorld hall = BoxWorld::room(12, 8, 6);
  hall.boxes.push_back({{8, 0, 2.4}, {12, 8, 2.6}});
  const double slope = 2.6 / 7;  // a ramp as a sheet, from (1, 1..2) at 0 up to (8, 1..2) at 2.6
  hall.addQuad({1, 1, 0}, {8, 1, 7 * slope}, {8, 2, 7 * slope}, {1, 2, 0});
  const Storeys storeys = storeysOf(hall);
  ASSERT_GE(storeys.planes.size(), 2u);
  EXPECT_NEAR(storeys.planes[0].height, 0, 0.01);
  EXPECT_NEAR(storeys.planes[1].height, 2.6, 0.01);
  EXPECT_TRUE(storeys.planes[0].outline.contains({10, 6})) << "one walks below the mezzanine";
  EXPECT_TRUE(storeys.planes[1].outline.contains({10, 6}));
  ASSERT_EQ(storeys.links.size(), 1u);
  EXPECT_NEAR(storeys.links[0].place.y, 1.5, 0.1);
}

TEST(Storeys, LeaveOutATableAndAPodiumThatCannotBeSteppedOn) {
  BoxWorld room = BoxWorld::room(10, 8, 3);
  room.boxes.push_back({{2, 2, 0.7}, {5, 5, 0.75}});
  room.boxes.push_back({{6, 2, 0}, {8.5, 5, 0.8}});
  EXPECT_EQ(storeysOf(room).planes.size(), 2u) << "the floor and the roof's top";
  addStair(room, 5.2, 0.2, 0.2, 4, 3, 4);  // up to the podium
  const Storeys withSteps = storeysOf(room);
  ASSERT_EQ(withSteps.planes.size(), 3u);
  EXPECT_NEAR(withSteps.planes[1].height, 0.8, 0.01);
  ASSERT_EQ(withSteps.links.size(), 1u);
}

TEST(Storeys, AreNeverInsideASolid) {
  // A block of flats without an inside stands on a square: its closed box holds a part of the ground.
  BoxWorld square;
  square.addQuad({-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0});
  square.boxes.push_back({{-6, -6, -0.5}, {6, 6, 9}});
  const Storeys storeys = storeysOf(square, fine(0.2));
  ASSERT_THAT(heightsOf(storeys),
              testing::ElementsAre(testing::DoubleNear(0, 0.01), testing::DoubleNear(9, 0.01)));
  EXPECT_FALSE(storeys.planes[0].outline.contains({0, 0}));
  EXPECT_TRUE(storeys.planes[0].outline.contains({8, 8}));
  EXPECT_NEAR(storeys.planes[0].outline.area(), 20 * 20 - 12.4 * 12.4, 6);
}

TEST(Storeys, AreNotTheUndersideOfAClosedSolid) {
  BoxWorld block{{{{0, 0, 0}, {6, 6, 4}}}, {}};
  const Storeys storeys = storeysOf(block);
  EXPECT_THAT(heightsOf(storeys), testing::ElementsAre(testing::DoubleNear(4, 0.01)));
  StoreyOptions anySide = fine();
  anySide.walkable.ignoreSides = true;
  EXPECT_THAT(heightsOf(storeysOf(block, anySide)),
              testing::ElementsAre(testing::DoubleNear(0, 0.01), testing::DoubleNear(4, 0.01)))
      << "the naive answer: the underside of the block, with 4 m of room above";
}

TEST(Storeys, CountAFloorOfTwoSheetsOnce) {
  // The same floor twice: one sheet faces up, one down, at the same height, as exporters write two-sided
  // ones.
  BoxWorld open;
  open.addQuad({0, 0, 0}, {6, 0, 0}, {6, 6, 0}, {0, 6, 0});
  open.addQuad({0, 0, 0}, {0, 6, 0}, {6, 6, 0}, {6, 0, 0});
  // ... and one of two sides a centimetre apart.
  open.addQuad({0, 0, 3}, {6, 0, 3}, {6, 6, 3}, {0, 6, 3});
  open.addQuad({0, 0, 2.99}, {0, 6, 2.99}, {6, 6, 2.99}, {6, 0, 2.99});
  EXPECT_THAT(heightsOf(storeysOf(open)),
              testing::ElementsAre(testing::DoubleNear(0, 0.01), testing::DoubleNear(3, 0.01)));
}

TEST(Storeys, TakeASheetThatFacesDownInTheOpenForFloor) {
  BoxWorld open;
  open.addQuad({0, 0, 0}, {0, 6, 0}, {6, 6, 0}, {6, 0, 0});
  const Storeys storeys = storeysOf(open);
  EXPECT_THAT(heightsOf(storeys), testing::ElementsAre(testing::DoubleNear(0, 0.01)));
  EXPECT_FALSE(storeys.ignoredSides);
}

TEST(Storeys, OfAShellSeenFromWithinAreFoundByIgnoringSides) {
  // A room of sheets that all face outwards, under a roof too low to stand... nowhere else to stand.
  BoxWorld shell;
  shell.boxes.push_back({{0, 0, 0}, {6, 6, 3}});
  StoreyOptions options = fine();
  const auto inner = [&](const glm::dvec3& origin, const glm::dvec3& direction) {
    // Nothing outside: rays that start above the box see through its top.
    SurfaceHit hit = shell.probe()(origin, direction);
    if (hit.found() && !hit.showsBack(direction)) {
      const double past = hit.distance + 1e-6;
      hit = shell.probe()(origin + past * direction, direction);
      hit.distance += past;
    }
    return hit;
  };
  const auto found = findStoreys(shell.bounds(), options, inner);
  ASSERT_TRUE(found) << found.error().describe();
  EXPECT_THAT(heightsOf(*found), testing::ElementsAre(testing::DoubleNear(0, 0.01)));
}

TEST(Storeys, InAClosedSkyBoxIncludeTheFloorThatANewProjectStandsOn) {
  BoxWorld world;
  world.addShell({-100, -100, -50}, {100, 100, 50});
  world.addShell({-40, -40, 2}, {40, 40, 10});  // a hall whose walls show their backs to who is in it
  const auto area = findWalkableArea(world.bounds(), {}, world.probe());
  ASSERT_TRUE(area) << area.error().describe();
  StoreyOptions small;
  small.leastShare = 0;
  const Storeys storeys = storeysOf(world, small);
  EXPECT_EQ(storeys.ignoredSides, area->ignoredSides);
  EXPECT_THAT(heightsOf(storeys), testing::Contains(testing::DoubleNear(area->floorHeight, 1e-4)));
  EXPECT_NEAR(area->floorHeight, 2, 1e-4);
  EXPECT_TRUE(area->ignoredSides);
}

TEST(Storeys, IncludeTheFloorThatAProjectStandsOnHoweverSmallBesideASkyBox) {
  BoxWorld world;
  world.addShell({-200, -200, -50}, {200, 200, 50});
  world.addCourt({0, 0, 2}, 45, 4);
  const auto area = findWalkableArea(world.bounds(), {}, world.probe());
  ASSERT_TRUE(area) << area.error().describe();
  ASSERT_NEAR(area->floorHeight, 2, 1e-4);
  const Storeys storeys = storeysOf(world, {});
  EXPECT_EQ(storeys.ignoredSides, area->ignoredSides);
  EXPECT_THAT(heightsOf(storeys), testing::Contains(testing::DoubleNear(2, 1e-4)));
}

TEST(Storeys, OfASlopeAreBandsOfTheToleranceJoinedInOrder) {
  // 30 m long and 6 m wide, rising 1 in 10: each band of +-0.25 m is 5 m long.
  BoxWorld slope;
  slope.addQuad({0, 0, 0}, {30, 0, 3}, {30, 6, 3}, {0, 6, 0});
  const Storeys storeys = storeysOf(slope, fine(0.2));
  ASSERT_GE(storeys.planes.size(), 4u);
  double area = 0;
  for (const WalkPlane& plane : storeys.planes) {
    EXPECT_LE(plane.outline.area(), 5.3 * 6.1);
    area += plane.outline.area();
  }
  EXPECT_GT(area, 0.7 * 180);
  EXPECT_LE(area, 181);
  StoreyOptions wide = fine(0.2);
  wide.walkable.floorTolerance = 1.6;
  const Storeys whole = storeysOf(slope, wide);
  ASSERT_GE(whole.planes.size(), 1u);
  EXPECT_GT(whole.planes[0].outline.area(), 0.9 * 180) << "a tolerance of half the rise holds all of it";
}

TEST(Storeys, AreOnePerPartWhereTheFloorIsParted) {
  BoxWorld room = BoxWorld::room(9, 4, 2.8);
  room.boxes.push_back({{3, 0, 0}, {3.1, 4, 2.8}});  // a wall without a door
  const Storeys storeys = storeysOf(room);
  ASSERT_EQ(storeys.planes.size(), 3u);
  EXPECT_NEAR(storeys.planes[0].outline.area(), 5.5 * 3.6, 1);
  EXPECT_NEAR(storeys.planes[1].outline.area(), 2.6 * 3.6, 1);
  EXPECT_EQ(storeys.planes[0].height, storeys.planes[1].height);
  EXPECT_TRUE(storeys.links.empty());
  StoreyOptions large = fine();
  large.leastArea = 12;
  EXPECT_EQ(storeysOf(room, large).planes.size(), 2u);
  StoreyOptions share = fine();
  share.leastShare = 0.5;  // of the roof's 41 m2: none but the floor that a project stands on comes with it
  EXPECT_EQ(storeysOf(room, share).planes.size(), 2u);
}

TEST(Storeys, AgreeWithTheWalkableAreaAtTheirHeight) {
  const BoxWorld house = twoStoreyHouse(true);
  const Storeys storeys = storeysOf(house);
  for (const WalkPlane& plane : storeys.planes) {
    WalkableOptions options = fine().walkable;
    options.floorHeight = plane.height;
    const auto area = findWalkableArea(house.bounds(), options, house.probe());
    ASSERT_TRUE(area);
    EXPECT_EQ(area->outline, plane.outline);
  }
}

TEST(Storeys, RefuseBadOptionsAndSceneWithoutFloor) {
  const BoxWorld room = BoxWorld::room(6, 4, 2.8);
  const auto refusal = [&](const BoxWorld& world, const StoreyOptions& options) {
    const auto found = findStoreys(world.bounds(), options, world.probe());
    return found ? std::string() : found.error().describe();
  };
  StoreyOptions bad;
  bad.leastShare = 2;
  EXPECT_THAT(refusal(room, bad), HasSubstr("share"));
  bad = {};
  bad.leastArea = NAN;
  EXPECT_THAT(refusal(room, bad), HasSubstr("area"));
  bad = {};
  bad.walkable.stepHeight = -1;
  EXPECT_THAT(refusal(room, bad), HasSubstr("step height"));
  BoxWorld wall;
  wall.addQuad({0, 0, 0}, {5, 0.1, 0}, {5, 0.1, 3}, {0, 0, 3});
  EXPECT_THAT(refusal(wall, fine()), HasSubstr("no floor"));
}

}  // namespace
}  // namespace acentric
