#include "engine/inspect/near_ground.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/inspect/box_world.h"

namespace acentric {
namespace {

using test::BoxWorld;

constexpr float kNoWay = std::numeric_limits<float>::infinity();

ProbeGrid gridOf(int columns, int rows, double step) { return {{0, 0}, step, columns, rows}; }

TEST(NearGround, ClearanceIsTheLeastOfWhatIsFeltAnywhereAndTheWayFromThere) {
  std::mt19937 random(7);
  for (int round = 0; round < 20; ++round) {
    const ProbeGrid grid = gridOf(3 + round, 17 - round / 2, 0.7);
    std::vector<float> felt(std::size_t(grid.columns * grid.rows));
    for (float& f : felt) f = random() % 5 == 0 ? float(random() % 1000) * 0.004f : 100.0f;
    std::vector<float> spread = felt;
    spreadClearance(spread, grid);
    for (int y = 0; y < grid.rows; ++y)
      for (int x = 0; x < grid.columns; ++x) {
        double least = 1e9;
        for (int v = 0; v < grid.rows; ++v)
          for (int u = 0; u < grid.columns; ++u) {
            const int dx = std::abs(u - x), dy = std::abs(v - y);
            const double way = 0.7 * (std::abs(dx - dy) + std::sqrt(2.0) * std::min(dx, dy));
            least = std::min(least, double(felt[grid.index(u, v)]) + way);
          }
        EXPECT_NEAR(spread[grid.index(x, y)], least, 1e-4);
      }
  }
}

/// A random floor with some links cut.
struct RandomFloor {
  ProbeGrid grid = gridOf(14, 11, 2);
  CellMask floor{14, 11};
  CellLinks links;
  std::vector<float> clearance;

  explicit RandomFloor(unsigned seed) {
    std::mt19937 random(seed);
    for (auto& cell : floor.cells) cell = random() % 5 != 0 ? 1 : 0;
    for (auto* side : {&links.right, &links.up})
      for (std::size_t cell = 0; cell < floor.cells.size(); ++cell)
        side->push_back(random() % 8 != 0 ? 1 : 0);
    for (std::size_t cell = 0; cell < floor.cells.size(); ++cell)
      clearance.push_back(float(random() % 600) * 0.1f);
  }
  bool linked(int x, int y, int dx, int dy) const {
    if (!floor.at(x, y) || !floor.at(x + dx, y + dy)) return false;
    const int x0 = std::min(x, x + dx), y0 = std::min(y, y + dy);
    if (dy == 0) return links.right[grid.index(x0, y)] != 0;
    if (dx == 0) return links.up[grid.index(x, y0)] != 0;
    return linked(x, y, dx, 0) && linked(x + dx, y, 0, dy) && linked(x, y, 0, dy) && linked(x, y + dy, dx, 0);
  }
};

TEST(NearGround, WaysAreAsShortAsRelaxingEveryStepUntilNothingChanges) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const RandomFloor f(seed);
    int start = 0;
    while (f.floor.cells[std::size_t(start)] == 0) ++start;
    const auto ways = waysFrom(start, f.grid, f.floor, f.links, f.clearance);
    std::vector<double> slow(f.floor.cells.size(), std::numeric_limits<double>::infinity());
    slow[std::size_t(start)] = 0;
    for (bool changed = true; changed;) {
      changed = false;
      for (int y = 0; y < f.grid.rows; ++y)
        for (int x = 0; x < f.grid.columns; ++x)
          for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
              if ((dx == 0 && dy == 0) || !f.linked(x, y, dx, dy)) continue;
              const std::size_t here = f.grid.index(x, y), there = f.grid.index(x + dx, y + dy);
              const double cost =
                  0.5 * (wayCost(double(f.clearance[here])) + wayCost(double(f.clearance[there])));
              const double way = slow[here] + f.grid.step * std::hypot(dx, dy) * cost;
              if (way < slow[there] - 1e-9) slow[there] = way, changed = true;
            }
    }
    for (std::size_t cell = 0; cell < slow.size(); ++cell) {
      if (std::isinf(slow[cell]))
        EXPECT_EQ(ways[cell], kNoWay);
      else
        EXPECT_NEAR(double(ways[cell]), slow[cell], 1e-3 + 1e-5 * slow[cell]);
    }
  }
}

TEST(NearGround, OpenGroundAndGapsCostMoreThanAStreet) {
  EXPECT_EQ(wayCost(0), 3);
  EXPECT_EQ(wayCost(kGapClearance), 1);
  EXPECT_EQ(wayCost(kStreetClearance), 1);
  EXPECT_DOUBLE_EQ(wayCost(3 * kStreetClearance), 3);
  EXPECT_EQ(wayCost(std::numeric_limits<double>::infinity()), wayCost(kOpenClearance));
}

/// A plain of 400 m with a street 12 m wide between two rows of houses at x = 100, and nothing else.
BoxWorld streetOnAPlain() {
  BoxWorld world;
  world.boxes.push_back({{-200, -200, -1}, {200, 200, 0}});
  for (int k = 0; k < 6; ++k) {
    const double y = -60 + 20 * k;
    world.boxes.push_back({{84, y, 0}, {94, y + 18, 8}});
    world.boxes.push_back({{106, y, 0}, {116, y + 18, 8}});
  }
  return world;
}

NearGroundOptions onTheGround() {
  NearGroundOptions options;
  options.walkable.floorHeight = 0;
  options.window = 200;
  return options;
}

TEST(NearGround, BeginsWhereMostIsEnclosedAndFollowsTheStreet) {
  const BoxWorld world = streetOnAPlain();
  const auto ground = surveyNearGround(world.bounds(), onTheGround(), world.probe());
  ASSERT_TRUE(ground) << ground.error().describe();
  EXPECT_NEAR(ground->startPlace().x, 100, 2) << "the middle of the street";
  EXPECT_NEAR(ground->startPlace().y, 0, 75);
  const auto clearanceAt = [&](double x, double y) {
    const glm::dvec2 at = (glm::dvec2(x, y) - ground->grid.corner) / ground->grid.step;
    return double(ground->clearance[ground->grid.index(int(at.x), int(at.y))]);
  };
  EXPECT_NEAR(clearanceAt(100.5, 10.5), 6, 2);
  EXPECT_LT(clearanceAt(95.5, 10.5), 3);
  EXPECT_GT(clearanceAt(40, 0), 35);
  // The first 3,000 square metres: no farther from a house than a street's width, all in one part.
  std::vector<float> ways = ground->wayTo;
  std::ranges::sort(ways);
  const CellMask part = partWithin(*ground, double(ways[750]));
  EXPECT_GT(part.count(), 700u);
  for (int y = 0; y < part.rows; ++y)
    for (int x = 0; x < part.columns; ++x)
      if (part.at(x, y)) {
        EXPECT_LT(ground->clearance[ground->grid.index(x, y)], 25) << x << " " << y;
      }
}

TEST(NearGround, BeginsWhereItIsTold) {
  const BoxWorld world = streetOnAPlain();
  NearGroundOptions options = onTheGround();
  options.around = glm::dvec2(-120, 40);
  const auto ground = surveyNearGround(world.bounds(), options, world.probe());
  ASSERT_TRUE(ground) << ground.error().describe();
  EXPECT_LT(glm::distance(ground->startPlace(), *options.around), options.step);
  options.around = glm::dvec2(5000, 0);
  EXPECT_FALSE(surveyNearGround(world.bounds(), options, world.probe()));
}

TEST(NearGround, SaysThatNothingStandsAboutAPlain) {
  BoxWorld world;
  world.boxes.push_back({{-200, -200, -1}, {200, 200, 0}});
  const auto ground = surveyNearGround(world.bounds(), onTheGround(), world.probe());
  ASSERT_FALSE(ground);
  EXPECT_EQ(ground.error().kind, ErrorKind::notFound);
}

TEST(NearGround, RefusesWhatMakesNoSense) {
  const BoxWorld world = streetOnAPlain();
  const auto refused = [&](auto change) {
    NearGroundOptions options = onTheGround();
    change(options);
    return !surveyNearGround(world.bounds(), options, world.probe());
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(refused([&](NearGroundOptions& o) { o.walkable.floorHeight = nan; }));
  EXPECT_TRUE(refused([&](NearGroundOptions& o) { o.window = nan; }));
  EXPECT_TRUE(refused([&](NearGroundOptions& o) { o.window = 1e7; }));
  EXPECT_TRUE(refused([&](NearGroundOptions& o) { o.step = 0; }));
  EXPECT_TRUE(refused([&](NearGroundOptions& o) { o.step = 1e-3; }));
  EXPECT_TRUE(refused([&](NearGroundOptions& o) { o.around = glm::dvec2(nan, 0); }));
}

}  // namespace
}  // namespace acentric
