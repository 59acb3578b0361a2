#include "engine/inspect/walkable_outline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "engine/base/task_runner.h"
#include "engine/inspect/simplify_outline.h"
#include "tests/inspect/box_world.h"

namespace acentric {
namespace {
using test::BoxWorld;
using testing::HasSubstr;

WalkableArea walk(const BoxWorld& world, const WalkableOptions& options = {}) {
  const Result<WalkableArea> area = findWalkableArea(world.bounds(), options, world.probe());
  EXPECT_TRUE(area) << (area ? "" : area.error().describe());
  if (!area) return {};
  EXPECT_TRUE(isSimple(area->outline));
  return *area;
}

TEST(WalkableArea, OfAnEmptyRoomIsItsFloorLessTheClearance) {
  const WalkableArea area = walk(BoxWorld::room(6, 4, 2.8));
  EXPECT_NEAR(area.floorHeight, 0, 1e-5);
  ASSERT_EQ(area.outline.loops.size(), 1u);
  EXPECT_EQ(area.outline.loops[0].size(), 4u);
  EXPECT_NEAR(area.outline.area(), 5.6 * 3.6, 0.04 * 20);  // a grid step of 3.2 cm on each side
  EXPECT_TRUE(area.outline.contains({0.25, 0.25}));
  EXPECT_TRUE(area.outline.contains({5.75, 3.75}));
  EXPECT_FALSE(area.outline.contains({0.15, 2}));
}

TEST(WalkableArea, GoesRoundAPillar) {
  BoxWorld world = BoxWorld::room(6, 4, 2.8);
  world.boxes.push_back({{2.5, 1.5, 0}, {3.5, 2.5, 2.8}});
  const WalkableArea area = walk(world);
  ASSERT_EQ(area.outline.loops.size(), 2u) << "the pillar is a hole";
  EXPECT_FALSE(area.outline.contains({3, 2}));
  EXPECT_FALSE(area.outline.contains({2.35, 2}));  // clearance
  EXPECT_TRUE(area.outline.contains({2.2, 2}));
  EXPECT_NEAR(area.outline.area(), 5.6 * 3.6 - 1.4 * 1.4, 1.0);
}

TEST(WalkableArea, LeavesOutATableAndWhatIsTooLowAbove) {
  BoxWorld world = BoxWorld::room(6, 4, 2.8);
  world.boxes.push_back({{1, 1, 0.72}, {2, 2, 0.75}});    // a table top, legs left out
  world.boxes.push_back({{4, 1, 1.5}, {5, 2, 1.55}});     // a shelf at head height
  world.boxes.push_back({{4, 2.5, 2.2}, {5, 3.2, 2.3}});  // a lamp that one can walk under
  const WalkableArea area = walk(world);
  EXPECT_FALSE(area.outline.contains({1.5, 1.5}));
  EXPECT_FALSE(area.outline.contains({4.5, 1.5}));
  EXPECT_TRUE(area.outline.contains({4.5, 2.85}));
  EXPECT_TRUE(area.outline.contains({3, 3}));
}

TEST(WalkableArea, IsTheSameForManyThreads) {
  BoxWorld world = BoxWorld::room(6, 4, 5);
  for (int step = 0; step < 12; ++step)  // stairs up to a gallery
    world.boxes.push_back({{0.3 * step, 0, 0}, {0.3 * (step + 1), 1, 0.17 * (step + 1)}});
  world.boxes.push_back({{3.6, 0, 1.9}, {6, 4, 2.05}});
  world.boxes.push_back({{1, 2, 0}, {2, 3, 0.72}});
  WalkableOptions options;
  options.gridStep = 0.1;
  const auto grid = layProbeGrid(world.bounds(), options);
  ASSERT_TRUE(grid);
  const FloorLevels levels = findFloorLevels(world.bounds(), *grid, options.headRoom(), world.probe());
  TaskRunner runner(3);
  const Standing one = surveyStanding(*grid, levels, options.standingRules(), world.probe());
  const Standing many = surveyStanding(*grid, levels, options.standingRules(), world.probe(), &runner);
  ASSERT_EQ(many.spots.size(), one.spots.size());
  ASSERT_GT(one.spots.size(), 1000u);
  int climbs = 0;
  for (std::size_t s = 0; s < one.spots.size(); ++s) {
    const StandingSpot &a = one.spots[s], &b = many.spots[s];
    ASSERT_EQ(a.next, b.next);
    ASSERT_EQ(std::tuple(a.x, a.y, a.height, a.clearance, a.wideEnclosure, a.seemsInside),
              std::tuple(b.x, b.y, b.height, b.clearance, b.wideEnclosure, b.seemsInside));
    for (const int next : a.next)
      climbs += next >= 0 && std::abs(one.spots[std::size_t(next)].height - a.height) > 0.1f;
  }
  EXPECT_GT(climbs, 50) << "steps were looked at too";
}

TEST(WalkableArea, TakesAStepWithinTheToleranceAndNotAHigherOne) {
  BoxWorld world = BoxWorld::room(6, 4, 2.8);
  world.boxes.push_back({{1, 1, 0}, {2, 3, 0.15}});
  world.boxes.push_back({{4, 1, 0}, {5, 3, 0.45}});
  const WalkableArea area = walk(world);
  EXPECT_TRUE(area.outline.contains({1.5, 2}));
  EXPECT_FALSE(area.outline.contains({4.5, 2}));
  EXPECT_NEAR(area.floorHeight, 0, 1e-4) << "the greater part of the floor decides";
}

TEST(WalkableArea, IsTheLargestPartOnly) {
  BoxWorld world = BoxWorld::room(9, 4, 2.8);
  world.boxes.push_back({{3, 0, 0}, {3.01, 4, 2.8}});  // a thin wall without a door
  const WalkableArea area = walk(world);
  EXPECT_FALSE(area.outline.contains({1.5, 2}));
  EXPECT_TRUE(area.outline.contains({6, 2}));
}

TEST(WalkableArea, DoesNotLeapAThinWallBetweenCoarseGridPoints) {
  BoxWorld world = BoxWorld::room(9, 4, 2.8);
  world.boxes.push_back({{3, 0, 0}, {3.001, 4, 2.8}});
  WalkableOptions options;
  options.gridStep = 0.7;
  EXPECT_FALSE(walk(world, options).outline.contains({1.2, 2}));
}

TEST(WalkableArea, OfAHouseIsItsFloorAndNotItsRoof) {
  // The roof's top is larger than the floor and has all the room above it.
  EXPECT_NEAR(walk(BoxWorld::room(6, 4, 2.8)).floorHeight, 0, 1e-4);
  // A second storey: the ground floor is taken, unless the designer says otherwise.
  BoxWorld house = BoxWorld::room(6, 4, 2.8);
  for (test::Box box : BoxWorld::room(6, 4, 2.8).boxes) {
    box.min.z += 3, box.max.z += 3;
    house.boxes.push_back(box);
  }
  EXPECT_NEAR(walk(house).floorHeight, 0, 1e-4);
  WalkableOptions upstairs;
  upstairs.floorHeight = 3;
  const WalkableArea above = walk(house, upstairs);
  EXPECT_EQ(above.floorHeight, 3);
  EXPECT_NEAR(above.outline.area(), 5.6 * 3.6, 0.8);
}

TEST(WalkableArea, OfAHouseFullOfFurnitureIsItsFloorAndNotItsRoof) {
  BoxWorld house = BoxWorld::room(6, 4, 2.8);
  house.boxes.push_back({{0, 0, 0}, {3.5, 4, 0.9}});  // more than half of the floor
  const WalkableArea area = walk(house);
  EXPECT_NEAR(area.floorHeight, 0, 1e-4);
  EXPECT_NEAR(area.outline.area(), 2.1 * 3.6, 0.5);
}

TEST(WalkableArea, OfAThickBlockOfGroundWithAHutIsTheGround) {
  BoxWorld diorama{{{{-10, -10, -4}, {10, 10, 0}}}, {}};
  for (test::Box box : BoxWorld::room(4, 4, 2.4).boxes) diorama.boxes.push_back(box);
  const WalkableArea area = walk(diorama);
  EXPECT_NEAR(area.floorHeight, 0, 1e-3);
  EXPECT_TRUE(area.outline.contains({-5, -5}));
  EXPECT_GT(area.outline.area(), 20 * 20 - 5.2 * 5.2);
}

TEST(WalkableArea, OfAStreetIsTheGroundBetweenTheHouses) {
  BoxWorld street{{{{-20, -10, -1}, {20, 10, 0}}}, {}};
  street.boxes.push_back({{-20, 4, 0}, {20, 10, 8}});
  street.boxes.push_back({{-20, -10, 0}, {20, -4, 6}});
  const WalkableArea area = walk(street);
  EXPECT_NEAR(area.floorHeight, 0, 1e-3);
  EXPECT_TRUE(area.outline.contains({0, 0}));
  EXPECT_FALSE(area.outline.contains({0, 6}));
}

TEST(WalkableArea, IsFoundFarFromTheOriginOfASlopingFloor) {
  BoxWorld stairs;  // low steps up, 2 cm each: all within the tolerance of the middle one
  for (int k = 0; k < 10; ++k)
    stairs.boxes.push_back({{100 + 0.5 * k, 200, 49.5}, {100.5 + 0.5 * k, 204, 50 + 0.02 * k}});
  const WalkableArea area = walk(stairs);
  EXPECT_NEAR(area.floorHeight, 50.09, 0.05);
  EXPECT_NEAR(area.outline.area(), 5 * 4, 0.5);
}

TEST(WalkableArea, RefusesWhatHasNoFloorWithTheWayOut) {
  const BoxWorld low = BoxWorld::room(6, 4, 1.2);
  // The roof is a floor too: it is the only one here.
  EXPECT_NEAR(walk(low).floorHeight, 1.4, 1e-4);
  const auto refusal = [](const BoxWorld& world, const WalkableOptions& options) {
    const auto area = findWalkableArea(world.bounds(), options, world.probe());
    EXPECT_FALSE(area);
    return area ? std::string() : area.error().describe();
  };
  WalkableOptions inside;
  inside.floorHeight = 0;
  EXPECT_THAT(refusal(low, inside), HasSubstr("no place at height 0.00 m"));
  EXPECT_THAT(refusal({}, {}), HasSubstr("no extent"));
  WalkableOptions fine;
  fine.gridStep = 1e-5;
  EXPECT_THAT(refusal(low, fine), HasSubstr("choose"));
  WalkableOptions bad;
  bad.eyeHeight = NAN;
  EXPECT_THAT(refusal(low, bad), HasSubstr("eye height"));
  bad = {};
  bad.wallClearance = -1;
  EXPECT_THAT(refusal(low, bad), HasSubstr("wall clearance"));
  const auto nothing =
      findWalkableArea(low.bounds(), {}, [](const auto&, const auto&) { return SurfaceHit{NAN}; });
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().kind, ErrorKind::notFound);
}

TEST(WalkableOutline, IsTheRoomInAClosedSkyBoxAndNotItsOutside) {
  BoxWorld world;
  world.addShell({-100, -100, -50}, {100, 100, 50});
  world.addCourt({-40, -40, 2}, 20, 4);
  world.addCourt({5, -40, 2}, 20, 4);
  world.addCourt({-25, 5, 2}, 20, 4);
  world.addCourt({0, 0, 2}, 28, 4);
  const auto area = findWalkableArea(world.bounds(), {}, world.probe());
  ASSERT_TRUE(area) << area.error().describe();
  EXPECT_NEAR(area->floorHeight, 2, 1e-4);
  EXPECT_TRUE(area->outline.contains({14, 14}));  // the largest room
  EXPECT_NEAR(area->outline.area(), 27 * 27, 80);
}

TEST(WalkableOutline, StaysOnTheGroundWithASolidBlockOnIt) {
  BoxWorld world;
  world.boxes = {{{-60, -60, -5}, {60, 60, 0}}, {{-15, -15, 0}, {15, 15, 9}}};
  const auto area = findWalkableArea(world.bounds(), {}, world.probe());
  ASSERT_TRUE(area) << area.error().describe();
  EXPECT_NEAR(area->floorHeight, 0, 1e-4);
  EXPECT_FALSE(area->ignoredSides);
  EXPECT_TRUE(area->outline.contains({40, 40}));
  EXPECT_FALSE(area->outline.contains({0, 0}));
}

TEST(WalkableOutline, IsTheHouseOnAGroundThatIsLargerThanIt) {
  for (const double rise : {0.1, 1.1}) {  // the ground at the floor's height, and a plinth above it
    BoxWorld world;
    world.boxes = {{{-20, -20, -2}, {20, 20, -rise}}, {{-9.5, -9.5, -rise}, {9.5, 9.5, 0}}};
    world.addCourt({-9, -9, 0.01}, 18, 5);
    const auto area = findWalkableArea(world.bounds(), {}, world.probe());
    ASSERT_TRUE(area) << area.error().describe();
    EXPECT_NEAR(area->floorHeight, 0.01, 1e-4) << rise;
    EXPECT_TRUE(area->outline.contains({0, 0})) << rise;
    EXPECT_NEAR(area->outline.area(), 17.6 * 17.6, 20) << rise;
  }
}

TEST(WalkableOutline, IsAHallOf60MetresAndNotTheCellarBelowIt) {
  BoxWorld world;
  world.addCourt({0, 0, 0}, 60, 12);
  world.boxes.push_back({{0, 0, 12}, {60, 60, 12.5}});  // the roof
  world.boxes.push_back({{20, 20, -0.5}, {36, 36, -0.2}});
  world.addCourt({20, 20, -4}, 16, 3.5);
  const auto area = findWalkableArea(world.bounds(), {}, world.probe());
  ASSERT_TRUE(area) << area.error().describe();
  EXPECT_NEAR(area->floorHeight, 0, 1e-4);
  EXPECT_GT(area->outline.area(), 0.95 * 60 * 60);
}

TEST(WalkableOutline, IsTheOpenSquareBetweenHousesAndNotTheLandAroundThem) {
  BoxWorld world;
  world.boxes = {{{-150, -150, -2}, {150, 150, 0}},
                 {{-55, -55, 0}, {55, -45, 12}},
                 {{-55, 45, 0}, {55, 55, 12}},
                 {{-55, -45, 0}, {-45, 45, 12}},
                 {{45, -45, 0}, {55, 45, 12}}};
  const auto area = findWalkableArea(world.bounds(), {}, world.probe());
  ASSERT_TRUE(area) << area.error().describe();
  EXPECT_NEAR(area->floorHeight, 0, 1e-4);
  EXPECT_TRUE(area->outline.contains({0, 0}));
  EXPECT_FALSE(area->outline.contains({100, 100}));
  EXPECT_NEAR(area->outline.area(), 90 * 90, 300);
}

TEST(WalkableOutline, StaysOnAVastPlainWithOneHutOnIt) {
  BoxWorld world;
  world.boxes = {{{-500, -500, -2}, {500, 500, 0}}, {{-10, -10, 0}, {10, 10, 3}}};
  world.addCourt({-9, -9, 3.01}, 18, 5);
  const auto area = findWalkableArea(world.bounds(), {}, world.probe());
  ASSERT_TRUE(area) << area.error().describe();
  EXPECT_NEAR(area->floorHeight, 0, 1e-4);
  EXPECT_GT(area->outline.area(), 0.99e6);
}

TEST(SimplifyOutline, KeepsCornersAndDropsStairs) {
  Outline stairs;  // a right triangle whose long side is a staircase
  std::vector<glm::dvec2> loop{{0, 0}, {20, 0}};
  for (int k = 0; k < 20; ++k) loop.emplace_back(20 - k, k + 1), loop.emplace_back(19 - k, k + 1);
  stairs.loops = {loop};
  ASSERT_TRUE(isSimple(stairs));
  const Outline simple = simplifyOutline(stairs, 1);
  EXPECT_LE(simple.loops[0].size(), 4u);
  EXPECT_NEAR(simple.area(), stairs.area(), 20);
}

TEST(SimplifyOutline, NeverMakesLoopsCross) {
  // A narrow corridor between two staircases: a coarse tolerance would make its sides cross.
  Outline corridor;
  std::vector<glm::dvec2> loop;
  for (int k = 0; k < 30; ++k)
    loop.emplace_back(k, 3 * std::sin(k)), loop.emplace_back(k + 0.5, 3 * std::sin(k));
  for (int k = 29; k >= 0; --k)
    loop.emplace_back(k + 0.5, 3 * std::sin(k) + 0.4), loop.emplace_back(k, 3 * std::sin(k) + 0.4);
  corridor.loops = {loop};
  ASSERT_TRUE(isSimple(corridor));
  for (const double tolerance : {0.1, 0.5, 1.0, 3.0, 10.0})
    EXPECT_TRUE(isSimple(simplifyOutline(corridor, tolerance)));
}

TEST(SimplifyOutline, SeesLoopsThatCrossTouchOrFoldBack) {
  EXPECT_FALSE(isSimple({{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}}}));                           // bow tie
  EXPECT_FALSE(isSimple({{{{0, 0}, {4, 0}, {2, 0}, {2, 2}}}}));                           // folds back
  EXPECT_FALSE(isSimple({{{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}}}));                   // touches an edge
  EXPECT_FALSE(isSimple({{{{0, 0}, {4, 0}, {4, 4}}, {{3, 1}, {5, 1}, {5, 2}}}}));         // two loops cross
  EXPECT_TRUE(isSimple({{{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{3, 3}, {3, 5}, {5, 4}}}}));  // a hole
}

}  // namespace
}  // namespace acentric
