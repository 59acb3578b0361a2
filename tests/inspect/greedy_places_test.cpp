#include "engine/inspect/greedy_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "engine/inspect/rooms.h"
#include "tests/inspect/box_tracer.h"

namespace acentric {
namespace {

/// Two rooms of 4 m x 4 m side by side, 3 m high, and a door of 1 m between them.
std::vector<test::Box> twoRooms() {
  std::vector<test::Box> boxes = test::BoxWorld::room(8.2, 4, 3).boxes;
  boxes.push_back({{4, 0, 0}, {4.2, 1.5, 3}});
  boxes.push_back({{4, 2.5, 0}, {4.2, 4, 3}});
  return boxes;
}
StandingArea floorOfTwoRooms() {
  return {{0, 0}, {8.2, 4}, [](const glm::dvec2& p) {
            const bool inDoor = p.y > 1.5 && p.y < 2.5;
            return p.x > 0.2 && p.x < 8 && p.y > 0.2 && p.y < 3.8 && (inDoor || p.x < 3.8 || p.x > 4.4);
          }};
}

std::size_t seenBy(const Sights& sights) {
  std::size_t seen = 0;
  for (std::size_t p = 0; p < sights.front().size(); ++p)
    seen += std::ranges::any_of(sights, [p](const auto& sight) { return sight[p] != 0; });
  return seen;
}

TEST(GreedyPlaces, SeeNoLessThanAGridOfTheSameNumber) {
  const test::BoxTracer tracer(twoRooms());
  const ScenePtr scene = test::sceneOf(twoRooms());
  const StandingArea area = floorOfTwoRooms();
  TaskRunner runner(0);
  const SurfacePoints surface(scene);
  std::vector<glm::dvec3> points;
  for (std::uint64_t n = 0; n < 3000; ++n) points.push_back(surface.at(10000 + n).position);  // others
  const auto seen = [&](const std::vector<glm::dvec2>& places) {
    std::vector<glm::dvec3> eyes;
    for (const glm::dvec2& place : places) eyes.emplace_back(place, 1.6);
    return seenBy(sightsOf(eyes, points, tracer, runner));
  };
  for (const std::size_t count : {1u, 2u, 3u, 6u}) {
    const auto grid = gridIn(area, count);
    const auto greedy = greedyPlaces(area, 1.6, scene, tracer, grid.size(), grid, runner);
    ASSERT_TRUE(greedy) << greedy.error().describe();
    ASSERT_EQ(greedy->size(), grid.size());
    for (const glm::dvec2& place : *greedy) EXPECT_TRUE(area.contains(place));
    EXPECT_GE(double(seen(*greedy)), 0.995 * double(seen(grid))) << count << " places, on other points";
  }
  const auto one = greedyPlaces(area, 1.6, scene, tracer, 1, {}, runner),
             two = greedyPlaces(area, 1.6, scene, tracer, 2, {}, runner);
  ASSERT_TRUE(one && two);
  EXPECT_EQ(one->front(), two->front());
  EXPECT_GT(seen(*two), seen(*one));
}

TEST(GreedyPlaces, TakeTheMostFirstAndThenWhatIsSeenLeast) {
  const Sights sights{{1, 1, 0, 0, 0}, {0, 1, 1, 1, 0}, {1, 0, 0, 0, 0}, {0, 0, 0, 0, 0}};
  EXPECT_EQ(chooseGreedily(sights, 1), (std::vector<std::size_t>{1}));
  EXPECT_EQ(chooseGreedily(sights, 3), (std::vector<std::size_t>{1, 0, 2}));
  EXPECT_EQ(chooseGreedily(sights, 9), (std::vector<std::size_t>{1, 0, 2})) << "the last sees nothing";
  EXPECT_TRUE(chooseGreedily({}, 3).empty());
}

TEST(Rooms, AreWhatDoorsPart) {
  const auto two = roomCentres(floorOfTwoRooms());
  ASSERT_EQ(two.size(), 2u);
  EXPECT_LT(glm::distance(two[0], {2, 2}), 0.3);
  EXPECT_LT(glm::distance(two[1], {6.2, 2}), 0.3);
  EXPECT_EQ(roomCentres(floorOfTwoRooms(), {0.4, 0.5}).size(), 1u) << "a passage wider than a door";
  const StandingArea corridor{
      {0, 0}, {6, 1}, [](const glm::dvec2& p) { return p.x > 0 && p.x < 6 && p.y > 0 && p.y < 1; }};
  const auto one = roomCentres(corridor);
  ASSERT_EQ(one.size(), 1u) << "narrow, but there is no other place";
  EXPECT_NEAR(one[0].y, 0.5, 0.1);
  EXPECT_TRUE(roomCentres({}).empty());
}

}  // namespace
}  // namespace acentric
