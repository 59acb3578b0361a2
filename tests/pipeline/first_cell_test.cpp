#include "engine/pipeline/first_cell.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/layout/layout.h"
#include "engine/pipeline/new_project.h"
#include "tests/inspect/box_world.h"

namespace acentric {
namespace {

using test::BoxWorld;

TEST(FirstCells, AreLargerOnAVastPlainSoThatTheLayoutStaysSmall) {
  for (const Configuration configuration : {Configuration::b, Configuration::e, Configuration::g}) {
    EXPECT_EQ(firstCellSize(7000, configuration), kLargestUsualCell) << nameOf(configuration);
    LayoutSpec spec;
    spec.configuration = configuration;
    spec.cellSize = firstCellSize(6e7, configuration);
    EXPECT_GT(spec.cellSize, kLargestUsualCell) << nameOf(configuration);
    spec.outline = parseOutline("0,0;10000,0;10000,6000;0,6000").value();
    const auto layout = buildLayout(spec);
    ASSERT_TRUE(layout) << layout.error().describe();
    EXPECT_GT(layout->regions.size(), 100u) << nameOf(configuration);
    EXPECT_LT(layout->regions.size(), 12000u) << nameOf(configuration);
  }
}

/// Open floor with things about it that stand closer and closer together towards x = 0.
NearGround narrowingFloor() {
  NearGround ground;
  ground.grid = {{0, -60}, 2, 60, 60};
  ground.floor = CellMask(60, 60);
  std::ranges::fill(ground.floor.cells, std::uint8_t(1));
  ground.links.right = ground.links.up = ground.floor.cells;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x) ground.clearance.push_back(float(0.25 * x));
  ground.start = int(ground.grid.index(2, 30));
  ground.wayTo = waysFrom(ground.start, ground.grid, ground.floor, ground.links, ground.clearance);
  return ground;
}

bool anywhere(const glm::dvec2&) { return true; }

std::size_t camerasOf(LayoutSpec spec, Outline outline) {
  spec.outline = std::move(outline);
  const auto layout = buildLayout(spec);
  EXPECT_TRUE(layout);
  return layout ? layout->cameras.size() : 0;
}

TEST(FirstCells, HaveNoMoreCamerasThanTheLimitAndNearlyAsMany) {
  const NearGround ground = narrowingFloor();
  std::vector<float> ways = ground.wayTo;
  std::ranges::sort(ways);
  for (const Configuration configuration : {Configuration::a, Configuration::b, Configuration::e})
    for (const std::size_t most : {40, 300}) {
      LayoutSpec spec;
      spec.configuration = configuration;
      spec.cellSize = 4;
      const auto outline = largestOutline(spec, ground, most);
      ASSERT_TRUE(outline) << nameOf(configuration) << most;
      EXPECT_LE(camerasOf(spec, *outline), most) << nameOf(configuration);
      // One prefix of the order after the other: none much larger would do.
      double largest = 0;
      for (std::size_t count = 1; count <= ways.size(); count += 3) {
        const Outline prefix =
            tidied(outlineAround(partWithin(ground, double(ways[count - 1])), ground.grid));
        if (camerasOf(spec, prefix) <= most) largest = std::max(largest, prefix.area());
        if (prefix.area() > 3 * outline->area()) break;
      }
      EXPECT_GT(outline->area(), 0.85 * largest) << nameOf(configuration) << most;
    }
  EXPECT_FALSE(largestOutline(LayoutSpec{}, ground, 2)) << "no region has so few";
}

TEST(FirstCells, AreSplitExactlyWhereTheyHaveTooLittleRoom) {
  const NearGround ground = narrowingFloor();
  constexpr double kLeast = 1.5;
  for (const Configuration configuration : {Configuration::e, Configuration::g}) {
    LayoutSpec spec;
    spec.configuration = configuration;
    spec.cellSize = configuration == Configuration::e ? 12 : 20;
    spec.split = chooseCells(spec, ground, {kLeast, kLeast}, anywhere).split;
    spec.outline = parseOutline("0,-60;120,-60;120,60;0,60").value();
    const auto layout = buildLayout(spec);
    ASSERT_TRUE(layout) << layout.error().describe();
    const auto tooLarge = [&](const CellId& id) {
      const ConvexPolygon polygon = cellPolygon(spec, id);
      const glm::dvec2 middle = polygon.centroid();
      double room = 1e9, sum = 0;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const glm::dvec2 a = polygon.corners[k], along = polygon.corners[(k + 1) % polygon.size()] - a;
        room = std::min(room, std::abs(cross(along, middle - a)) / glm::length(along));
      }
      int count = 0;
      for (int y = 0; y < ground.grid.rows; ++y)
        for (int x = 0; x < ground.grid.columns; ++x)
          if (polygon.containsClosed(ground.grid.centreOf(x, y)))
            sum += double(ground.clearance[ground.grid.index(x, y)]), ++count;
      return count > 0 && kRoomToSplit * room > sum / count && 0.5 * room >= kLeast * (1 - 1e-9);
    };
    std::set<int> levels;
    for (const Region& region : layout->regions) {
      EXPECT_FALSE(tooLarge(region.id));
      levels.insert(region.id.level);
    }
    for (const CellId& id : spec.split) EXPECT_TRUE(tooLarge(id));
    EXPECT_GE(levels.size(), 2u) << "small where it is narrow, large in the open";
  }
  EXPECT_TRUE(chooseCells(LayoutSpec{}, ground, {kLeast, kLeast}, anywhere).split.empty())
      << "b has no parts";
}

TEST(FirstCells, AreLeftOutExactlyWhereThereIsHardlyAnyFloor) {
  NearGround ground = narrowingFloor();
  for (int y = 0; y < 60; ++y)  // a house with a yard
    for (int x = 20; x < 40; ++x)
      if (y >= 20 && y < 40 && !(x > 25 && x < 31 && y > 25 && y < 31))
        ground.floor.cells[ground.grid.index(x, y)] = 0;
  for (const Configuration configuration : {Configuration::b, Configuration::e}) {
    LayoutSpec spec;
    spec.configuration = configuration;
    spec.cellSize = 8;
    const CellChoice choice = chooseCells(spec, ground, {1.5, 1.5}, anywhere);
    spec.split = choice.split;
    spec.outline = parseOutline("0,-60;120,-60;120,60;0,60").value();
    const auto layout = buildLayout(spec);
    ASSERT_TRUE(layout) << layout.error().describe();
    std::size_t left = 0;
    for (const Region& region : layout->regions) {
      int places = 0, floor = 0;
      for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 60; ++x)
          if (region.polygon.containsClosed(ground.grid.centreOf(x, y)))
            ++places, floor += ground.floor.at(x, y) ? 1 : 0;
      const bool little = places > 0 && double(floor) < kLeastFloor * places;
      EXPECT_EQ(choice.removed.contains(region.id), little) << nameOf(configuration);
      left += little ? 1 : 0;
    }
    EXPECT_GT(left, 4u);
  }
}

TEST(FirstCells, HaveTheirCornersAndMiddlesWhereOneMayStand) {
  NearGround ground = narrowingFloor();
  std::ranges::fill(ground.clearance, 50.0f);
  const auto outside = [](const glm::dvec2& place) {  // of a house
    return !(place.x > 40 && place.x < 75 && place.y > -21 && place.y < 13);
  };
  for (const Configuration configuration : {Configuration::b, Configuration::e, Configuration::g}) {
    LayoutSpec spec;
    spec.configuration = configuration;
    spec.cellSize = 8;
    const CellChoice choice = chooseCells(spec, ground, {2, 1}, outside);
    spec.outline = parseOutline("0,-60;120,-60;120,60;0,60").value();
    const auto all = buildLayout(spec);
    spec.split = choice.split, spec.removed = choice.removed;
    const auto layout = buildLayout(spec);
    ASSERT_TRUE(all && layout) << nameOf(configuration);
    for (const Region& region : layout->regions) {
      const auto free = std::ranges::count_if(region.polygon.corners, outside);
      EXPECT_TRUE(outside(region.polygon.centroid())) << nameOf(configuration);
      EXPECT_GE(2 * free, std::ptrdiff_t(region.polygon.size())) << nameOf(configuration);
      if (canSplit(configuration)) {
        EXPECT_EQ(free, std::ptrdiff_t(region.polygon.size()));
      }
    }
    // Nothing else is left out, and nothing that stands free is split.
    for (const CellId& id : choice.split) {
      const ConvexPolygon polygon = cellPolygon(spec, id);
      EXPECT_FALSE(std::ranges::all_of(polygon.corners, outside) && outside(polygon.centroid()));
    }
    for (int y = -55; y < 55; ++y)
      for (int x = 5; x < 115; ++x) {
        if (x > 40 - 20 && x < 75 + 20 && y > -21 - 20 && y < 13 + 20) continue;
        EXPECT_EQ(layout->regionAt({x, y}).has_value(), all->regionAt({x, y}).has_value()) << x << ' ' << y;
      }
    EXPECT_EQ(choice.split.empty(), configuration == Configuration::b);
    EXPECT_FALSE(choice.removed.empty());
  }
}

std::set<std::pair<int, int>> middlesOf(const LayoutSpec& spec) {
  std::set<std::pair<int, int>> middles;  // centimetres
  const auto layout = buildLayout(spec);
  EXPECT_TRUE(layout);
  for (const Region& region : layout->regions) {
    const glm::dvec2 middle = glm::round(100.0 * region.polygon.centroid());
    middles.emplace(int(middle.x), int(middle.y));
  }
  return middles;
}

TEST(FirstCells, AreAsSmallAsTheLargestOfThemAreWhereAllAreSplit) {
  for (const Configuration configuration : {Configuration::e, Configuration::g}) {
    LayoutSpec spec;
    spec.configuration = configuration;
    spec.cellSize = 12;
    spec.rotationRadians = 0.3;
    spec.latticeOrigin = {1.2, -0.7};
    spec.outline = parseOutline("-14,-9;17,-9;17,13;-14,13").value();
    const auto whole = buildLayout(spec);
    ASSERT_TRUE(whole);
    for (const Region& region : whole->regions) spec.split.insert(region.id);
    const auto halves = buildLayout(spec);
    ASSERT_TRUE(halves);
    const CellId split = halves->regions[1].id, left = halves->regions[2].id;
    spec.split.insert(split), spec.removed.insert(left);
    spec.removed.insert(whole->regions.back().id);
    const auto kept = withoutIdleChoices(spec);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->cellSize, 6);
    EXPECT_EQ(kept->split, std::set({CellId{split.i, split.j, split.slot, 0}}));
    EXPECT_TRUE(kept->removed.contains({left.i, left.j, left.slot, 0}));
    EXPECT_EQ(middlesOf(*kept), middlesOf(spec)) << nameOf(configuration);
    spec.split.erase(whole->regions[whole->regions.size() / 2].id);
    const auto mixed = withoutIdleChoices(spec);
    ASSERT_TRUE(mixed) << mixed.error().describe();
    EXPECT_EQ(mixed->cellSize, 12) << "one is whole";
  }
}

/// A street 10 m wide and one of 5 m that crosses it.
TEST(FirstCells, AreFittedToStreets) {
  NearGround ground = narrowingFloor();
  const auto inStreet = [](const glm::dvec2& place) {
    return std::abs(place.y - 1.8) < 5 || std::abs(place.x - 62.2) < 2.5;
  };
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x)
      ground.floor.cells[ground.grid.index(x, y)] = inStreet(ground.grid.centreOf(x, y)) ? 1 : 0;
  std::ranges::fill(ground.clearance, 3.0f);
  LayoutSpec pattern;
  pattern.configuration = Configuration::e;
  pattern.cellSize = 19.2;
  pattern.latticeOrigin = {4.6, -5.4};
  pattern.outline =
      parseOutline("40,-3;60,-3;60,-40;64,-40;64,-3;84,-3;84,6;64,6;64,40;60,40;60,6;40,6").value();
  const CellRules rules{4.8, 2.4};
  const auto worthAt = [&](const glm::dvec2& origin) {
    LayoutSpec there = pattern;
    there.latticeOrigin = origin;
    const CellChoice cells = chooseCells(there, ground, rules, inStreet);
    there.split = cells.split, there.removed = cells.removed;
    const auto layout = buildLayout(there);
    int floor = 0, served = 0;
    for (int y = 0; y < 60; ++y)
      for (int x = 0; x < 60; ++x) {
        const glm::dvec2 place = ground.grid.centreOf(x, y);
        if (!ground.floor.at(x, y) || !pattern.outline.contains(place)) continue;
        ++floor;
        served += layout->regionAt(place) ? 1 : 0;
      }
    const double share = double(served) / floor;
    return layout->cameras.empty() ? 0 : share * share * share / double(layout->cameras.size());
  };
  const FittedCells fitted = fitCells(pattern, ground, rules, inStreet, 9.6, 4);
  double most = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) most = std::max(most, worthAt(glm::dvec2(4.6 + 2.4 * i, -5.4 + 2.4 * j)));
  EXPECT_NEAR(fitted.worth, most, 1e-12);
  EXPECT_NEAR(fitted.worth, worthAt(fitted.spec.latticeOrigin), 1e-12);
  const auto layout = buildLayout(fitted.spec);
  ASSERT_TRUE(layout);
  std::set<double> widths;
  for (const Region& region : layout->regions) {
    EXPECT_TRUE(std::ranges::all_of(region.polygon.corners, inStreet));
    widths.insert(std::round(10 * glm::distance(region.polygon.corners[0], region.polygon.corners[1])) / 10);
  }
  EXPECT_EQ(widths, (std::set{4.8, 9.6})) << "one row in each street";
}

/// A street of 12 m between two rows of houses, whose walls show their backs to the street on one side.
TEST(FirstCells, HaveFreePlacesOutsideOfHousesHoweverWallsAreWound) {
  BoxWorld world;
  world.boxes.push_back({{-60, -60, -1}, {60, 60, 0}});
  world.boxes.push_back({{-50, 6, 0}, {50, 20, 8}});
  const auto wall = [&](double x0, double y0, double x1, double y1) {  // fronts inwards
    world.addQuad({x0, y0, 0}, {x1, y1, 0}, {x1, y1, 8}, {x0, y0, 8});
  };
  wall(-50, -6, -50, -20), wall(-50, -20, 50, -20), wall(50, -20, 50, -6), wall(50, -6, -50, -6);
  const SurfaceProbe probe = world.probe();
  NearGround ground = narrowingFloor();
  ground.grid = {{-60, -60}, 2, 60, 60};
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x)
      ground.floor.cells[ground.grid.index(x, y)] = std::abs(ground.grid.centreOf(x, y).y) < 6 ? 1 : 0;
  const FreePlace isFree = freePlaces(ground, 1.6, 12, probe);
  for (int x = -49; x < 50; x += 7) {
    for (const double y : {-5.8, -3.0, 0.0, 4.2, 5.8}) EXPECT_TRUE(isFree({x, y})) << x << ' ' << y;
    for (const double y : {-13.0, -7.0, -6.1, 6.1, 7.0, 13.0}) EXPECT_FALSE(isFree({x, y})) << x << ' ' << y;
    for (const double y : {-5.95, 5.95}) EXPECT_FALSE(isFree({x, y})) << "too near a wall: " << x << ' ' << y;
  }
  EXPECT_FALSE(isFree({0, 40})) << "behind the houses, farther than it looks";
}

/// Ground of 1 x 1 km with a square court of houses in a corner of it.
BoxWorld village() {
  BoxWorld world;
  world.boxes.push_back({{-500, -500, -1}, {500, 500, 0}});
  for (int k = 0; k < 5; ++k)
    for (const double side : {0.0, 24.0}) {
      world.boxes.push_back({{240 + 12.0 * k, 240 + side, 0}, {250 + 12.0 * k, 250 + side, 8}});
    }
  return world;
}

LayoutSpec layoutOf(const BoxWorld& world) {
  LayoutSpec spec;
  spec.cellSize = 6;
  const Bounds bounds = world.bounds();
  spec.outline.loops = {{{bounds.min.x, bounds.min.y},
                         {bounds.max.x, bounds.min.y},
                         {bounds.max.x, bounds.max.y},
                         {bounds.min.x, bounds.max.y}}};
  return spec;
}

TEST(FirstCells, AreLaidWhereSomethingStandsAboutOnGroundThatIsTooLarge) {
  const BoxWorld world = village();
  const LayoutSpec spec = layoutOf(world);
  FirstLayoutLimit limit;
  limit.cameras = 400;
  EXPECT_TRUE(exceeds(spec, limit));
  const auto kept = keepWithin(spec, limit, world.bounds(), false, world.probe());
  ASSERT_TRUE(kept) << kept.error().describe();
  EXPECT_EQ(kept->configuration, Configuration::e);
  EXPECT_FALSE(exceeds(*kept, limit));
  const auto layout = buildLayout(*kept);
  ASSERT_TRUE(layout);
  EXPECT_GT(layout->cameras.size(), 300u);
  const auto inHouse = [&](const glm::dvec2& place) {
    return std::ranges::any_of(world.boxes, [&](const test::Box& box) {
      return box.max.z > 1 && place.x > box.min.x && place.x < box.max.x && place.y > box.min.y &&
             place.y < box.max.y;
    });
  };
  for (const Region& region : layout->regions) {
    EXPECT_GT(region.polygon.centroid().x, 190);
    EXPECT_LT(region.polygon.centroid().x, 350);
    EXPECT_FALSE(inHouse(region.polygon.centroid()));
  }
  for (const LayoutCamera& camera : layout->cameras) EXPECT_FALSE(inHouse(camera.position));
  int laidOut = 0, served = 0;
  for (double y = 190; y < 350; y += 0.9)
    for (double x = 190; x < 350; x += 0.9) {
      if (!kept->outline.contains({x, y})) continue;
      ++laidOut;
      served += layout->regionAt({x, y}) ? 1 : 0;
    }
  EXPECT_GT(served, 0.97 * laidOut) << "what no region serves is not laid out";
  for (const std::set<CellId>& choices : {kept->split, kept->removed})
    for (const CellId& id : choices) EXPECT_TRUE(kept->outline.overlaps(cellPolygon(*kept, id)));
  const auto isWhole = [](const Region& region) { return region.id.level == 0; };
  EXPECT_TRUE(std::ranges::any_of(layout->regions, isWhole)) << "cells are as large as the largest";
  limit.chooseConfiguration = false;
  const auto hexagons = keepWithin(spec, limit, world.bounds(), false, world.probe());
  ASSERT_TRUE(hexagons) << hexagons.error().describe();
  EXPECT_EQ(hexagons->configuration, Configuration::b);
  EXPECT_TRUE(hexagons->split.empty());
  EXPECT_FALSE(exceeds(*hexagons, limit));
  limit.chooseCell = false;
  limit.around = glm::dvec2(-300, -300);
  const auto there = keepWithin(spec, limit, world.bounds(), false, world.probe());
  ASSERT_TRUE(there) << there.error().describe();
  EXPECT_EQ(there->cellSize, spec.cellSize);
  EXPECT_TRUE(there->outline.contains({-300, -300}));
  EXPECT_FALSE(exceeds(*there, limit));
  limit.cameras = 3;
  const auto none = keepWithin(spec, limit, world.bounds(), false, world.probe());
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("--max-cameras"), std::string::npos);
}

TEST(FirstCells, AreLargerWhereNothingStandsAboutOnGroundThatIsTooLarge) {
  BoxWorld world;
  world.boxes.push_back({{-500, -500, -1}, {500, 500, 0}});
  const LayoutSpec spec = layoutOf(world);
  FirstLayoutLimit limit;
  limit.cameras = 400;
  const auto kept = keepWithin(spec, limit, world.bounds(), false, world.probe());
  ASSERT_TRUE(kept) << kept.error().describe();
  EXPECT_EQ(kept->outline, spec.outline);
  EXPECT_GT(kept->cellSize, 20);
  EXPECT_FALSE(exceeds(*kept, limit));
  limit.chooseCell = false;
  const auto middle = keepWithin(spec, limit, world.bounds(), false, world.probe());
  ASSERT_TRUE(middle) << middle.error().describe();
  EXPECT_TRUE(middle->outline.contains({0, 0}));
  EXPECT_EQ(middle->cellSize, spec.cellSize);
  EXPECT_FALSE(exceeds(*middle, limit));
}

TEST(FirstCells, HaveNoLimitIfNoneIsSet) {
  LayoutSpec spec;
  spec.outline = parseOutline("0,0;90,0;90,90;0,90").value();
  EXPECT_FALSE(exceeds(spec, {0, {}, true, true}));
  EXPECT_TRUE(exceeds(spec, {100, {}, true, true}));
}

}  // namespace
}  // namespace acentric
