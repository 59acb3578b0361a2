#include "engine/pipeline/residency.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "engine/geometry/conventions.h"
#include "tests/layout/layout_fixtures.h"

namespace acentric {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Captures that come and go as planned.
struct World {
  std::vector<double> distance;
  std::vector<std::size_t> bytes;
  std::vector<Residence> residence;
  std::vector<std::uint64_t> lastUse;
  std::size_t limit = 0;
  std::uint64_t uses = 0;
  int loads = 0, evictions = 0;

  explicit World(std::size_t cameras, std::size_t each = 10)
      : distance(cameras, kNever),
        bytes(cameras, each),
        residence(cameras, Residence::absent),
        lastUse(cameras, 0) {}

  ResidencyPlan plan() const { return planResidency({distance, bytes, residence, lastUse, limit}); }
  void evict(const std::vector<int>& cameras) {
    for (const int c : cameras) {
      EXPECT_EQ(residence[std::size_t(c)], Residence::resident) << "only what is there goes";
      EXPECT_GT(distance[std::size_t(c)], 0) << "what is needed stays";
      residence[std::size_t(c)] = Residence::absent;
      ++evictions;
    }
  }
  /// Checks the promises of each step. True if anything was done.
  bool follow(const ResidencyPlan& plan) {
    evict(plan.evict);
    double before = -kNever;
    for (const ResidencyPlan::Step& step : plan.steps) {
      evict(step.evict);
      const auto c = std::size_t(step.load);
      EXPECT_EQ(residence[c], Residence::absent);
      EXPECT_GE(distance[c], before) << "nearer ones come first";
      before = distance[c];
      residence[c] = Residence::resident;
      lastUse[c] = ++uses;
      ++loads;
      EXPECT_LE(taken(), std::max(limit, needed() + strayed())) << "at no step";
    }
    return !plan.steps.empty() || !plan.evict.empty();
  }
  std::size_t taken() const {
    std::size_t all = 0;
    for (std::size_t c = 0; c < bytes.size(); ++c)
      if (residence[c] != Residence::absent) all += bytes[c];
    return all;
  }
  std::size_t needed() const {
    std::size_t all = 0;
    for (std::size_t c = 0; c < bytes.size(); ++c)
      if (distance[c] <= 0) all += bytes[c];
    return all;
  }
  /// On its way, and not to be stopped.
  std::size_t strayed() const {
    std::size_t all = 0;
    for (std::size_t c = 0; c < bytes.size(); ++c)
      if (residence[c] == Residence::loading && distance[c] > 0) all += bytes[c];
    return all;
  }
};

TEST(Residency, LoadsTheNearestUntilTheLimitIsReached) {
  World world(6);
  world.distance = {3, -0.5, 9, 1, -1, kNever};
  world.limit = 40;
  const ResidencyPlan plan = world.plan();
  std::vector<int> order;
  for (const auto& step : plan.steps) order.push_back(step.load);
  EXPECT_EQ(order, (std::vector{4, 1, 3, 0}))
      << "needed ones first, then by the way to walk; the last has no room";
  EXPECT_EQ(plan.beyondLimit, 0U);
}

TEST(Residency, WhatTheRegionNeedsIsLoadedWhateverTheLimitAndThatIsSaid) {
  World world(5);
  world.distance = {-1, -1, -1, 2, 4};
  world.limit = 25;
  world.residence[3] = Residence::resident;
  const ResidencyPlan plan = world.plan();
  EXPECT_EQ(plan.beyondLimit, 5U);
  world.follow(plan);
  EXPECT_EQ(world.residence, (std::vector{Residence::resident, Residence::resident, Residence::resident,
                                          Residence::absent, Residence::absent}));
}

TEST(Residency, TheLongestUnusedGivesWayButNothingThatIsStillWanted) {
  World world(5);
  world.distance = {-1, 5, 6, 7, 2};
  world.residence = {Residence::resident, Residence::resident, Residence::resident, Residence::resident,
                     Residence::absent};
  world.lastUse = {9, 1, 3, 2, 0};  // 1 was used longest ago, but is among the nearest that have room
  world.limit = 40;
  const ResidencyPlan plan = world.plan();
  EXPECT_TRUE(plan.evict.empty());
  ASSERT_EQ(plan.steps.size(), 1U);
  EXPECT_EQ(plan.steps[0].load, 4);
  EXPECT_EQ(plan.steps[0].evict, std::vector{3})
      << "with room for four, only 2 and 3 are spare once 4 is there";
}

TEST(Residency, ALowerLimitTakesEffectAtOnce) {
  World world(4);
  world.distance = {-1, 1, 2, 3};
  world.residence.assign(4, Residence::resident);
  world.limit = 20;
  const ResidencyPlan plan = world.plan();
  EXPECT_EQ(plan.evict, (std::vector{3, 2}));
  EXPECT_TRUE(plan.steps.empty());
}

TEST(Residency, SlightlyNearerIsNoReasonToSwap) {
  World world(3);
  world.limit = 20;
  world.distance = {-1, 2.0, 2.1};
  while (world.follow(world.plan())) {
  }
  EXPECT_EQ(world.loads, 2);
  for (int i = 0; i < 20; ++i) {  // the eye trembles between the two
    world.distance = i % 2 == 0 ? std::vector{-1.0, 2.1, 2.0} : std::vector{-1.0, 2.0, 2.1};
    EXPECT_FALSE(world.follow(world.plan()));
  }
  world.distance = {-1, 3.3, 2.0};
  EXPECT_TRUE(world.follow(world.plan())) << "clearly nearer is one";
}

TEST(Residency, OfRandomWorldsEachPlanKeepsItsPromisesAndComesToRest) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    test::Random random(seed);
    World world(std::size_t(1 + random.index(40)));
    for (std::size_t c = 0; c < world.bytes.size(); ++c) {
      world.bytes[c] = std::size_t(random.index(30));  // 0: not baked
      world.residence[c] = world.bytes[c] > 0 ? Residence(random.index(3)) : Residence::absent;
      world.lastUse[c] = world.residence[c] == Residence::absent ? 0 : ++world.uses;
    }
    world.limit = std::size_t(random.index(600));
    for (int walk = 0; walk < 8; ++walk) {
      for (double& d : world.distance)
        d = random.index(5) == 0 ? -random(0, 1) : random.index(9) == 0 ? kNever : random(0.1, 9);
      world.follow(world.plan());
      EXPECT_FALSE(world.follow(world.plan()))
          << "standing still, nothing comes and goes any more, seed " << seed;
      for (std::size_t c = 0; c < world.bytes.size(); ++c) {
        if (world.distance[c] <= 0 && world.bytes[c] > 0) {
          EXPECT_NE(world.residence[c], Residence::absent) << seed;
        }
        if (world.residence[c] == Residence::loading) world.residence[c] = Residence::resident;  // arrived
      }
      world.follow(world.plan());
      EXPECT_LE(world.taken(), std::max(world.limit, world.needed())) << seed;
    }
  }
}

class WalkDistancesTest : public testing::TestWithParam<Configuration> {};

TEST_P(WalkDistancesTest, TheRegionOfTheEyeNeedsItsCoversCamerasAndNoOther) {
  const Layout layout = test::makeLayout(GetParam(), {}, 3);
  const RegionNeeds needs = regionNeeds(layout, false);
  test::Random random(5);
  for (int n = 0; n < 40; ++n) {
    const int r = random.index(layout.regions.size());
    const Region& region = layout.regions[std::size_t(r)];
    const WalkDistances distances =
        walkDistances(layout, needs, {random.within(region.polygon), random(-3, 3), {}});
    std::vector<char> needed(layout.cameras.size(), 0);
    for (const Cover& cover : region.covers)
      for (const Piece& piece : cover.pieces) needed[std::size_t(piece.camera)] = 1;
    for (std::size_t c = 0; c < needed.size(); ++c) EXPECT_EQ(distances.camera[c] <= 0, needed[c] != 0);
    EXPECT_EQ(distances.region[std::size_t(r)], 0);
  }
}
INSTANTIATE_TEST_SUITE_P(AllConfigurations, WalkDistancesTest, testing::ValuesIn(test::kAllConfigurations));

TEST(WalkDistances, TheWayAheadCountsLessThanTheWayBack) {
  const Layout layout = test::makeLayout(Configuration::b, {}, 6);
  const RegionNeeds needs = regionNeeds(layout, true);
  const glm::dvec2 eye(0.1, 0.05);
  const WalkDistances standing = walkDistances(layout, needs, {eye, 0, {}});
  const WalkDistances walking = walkDistances(layout, needs, {eye, 0, {1.4, 0}});
  int ahead = 0, behind = 0;
  for (std::size_t r = 0; r < layout.regions.size(); ++r) {
    if (standing.region[r] == 0) continue;
    const glm::dvec2 towards = glm::normalize(needs.centre[r] - eye);
    EXPECT_GE(walking.region[r], standing.region[r] * (1 - 1e-12));
    if (towards.x > 0.9) {
      EXPECT_LT(walking.region[r], 1.06 * standing.region[r]);
      ++ahead;
    } else if (towards.x < -0.9) {
      EXPECT_GT(walking.region[r], 1.5 * standing.region[r]);
      ++behind;
    }
  }
  EXPECT_GT(ahead, 3);
  EXPECT_GT(behind, 3);
}

TEST(WalkDistances, CamerasThatLookWhereTheEyeLooksComeFirst) {
  const Layout layout = test::makeLayout(Configuration::b);
  const RegionNeeds needs = regionNeeds(layout, false);
  for (const double yaw : {0.0, 1.0, 2.5, -2.0}) {
    const WalkDistances distances = walkDistances(layout, needs, {{0.1, 0.1}, yaw, {}});
    const auto first = std::ranges::min_element(distances.camera) - distances.camera.begin();
    EXPECT_GT(glm::dot(needs.direction[std::size_t(first)], directionOf(yaw)), std::cos(radians(31)));
  }
}

TEST(WalkDistances, WalkingToAndFroOverABorderLoadsEachCaptureOnce) {
  const Layout layout = test::makeLayout(Configuration::b, {}, 4);
  const RegionNeeds needs = regionNeeds(layout, false);
  const Region& ring = layout.regions[std::size_t(*layout.regionAt({0, 0}))];
  const glm::dvec2 corner = ring.polygon.corners[0], next = ring.polygon.corners[1];
  const glm::dvec2 border = 0.5 * (corner + next), out = glm::normalize(border - ring.polygon.centroid());
  World world(layout.cameras.size());
  world.limit = 10 * 40;  // room for both regions, not for all
  ASSERT_GT(world.bytes.size() * 10, world.limit);
  int settled = 0;
  for (int step = 0; step < 200; ++step) {
    const double side = std::sin(0.3 * step);
    world.distance =
        walkDistances(layout, needs, {border + 0.05 * side * out, 0.3, out * std::cos(0.3 * step)}).camera;
    for (std::size_t c = 0; c < world.bytes.size(); ++c)
      if (world.distance[c] <= 0 && world.residence[c] == Residence::resident)
        world.lastUse[c] = ++world.uses;
    const int before = world.loads;
    for (const auto& s : world.plan().steps)
      EXPECT_TRUE(step < 60 || world.distance[std::size_t(s.load)] > 0);
    world.follow(world.plan());
    settled = world.loads == before ? settled + 1 : 0;
  }
  EXPECT_GT(settled, 100) << "after a few crossings nothing comes or goes";
}

}  // namespace
}  // namespace acentric
