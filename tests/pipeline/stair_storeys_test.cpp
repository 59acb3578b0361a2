#include "engine/pipeline/stair_storeys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <set>

#include "engine/layout/storey_choice.h"
#include "engine/pipeline/new_project.h"
#include "engine/pipeline/scene_scale.h"
#include "engine/pipeline/walk_ground.h"
#include "tests/support/stair_hall.h"

namespace acentric {
namespace {
namespace fs = std::filesystem;
using test::StairHall;
using testing::HasSubstr;

/// Floors at 0, 0.9 and 2.7 m, a flight and a ramp: laid out once for all tests.
class StairStoreysTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / ("acentric_stairs_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    StairHall::write(folder_ / "hall.obj");
    ImportHost host;
    host.importer = ACENTRIC_IMPORTER;
    NewProjectOptions options;
    options.import.up = UpAxis::z;
    options.everyStorey = options.stairs = true;
    options.cellSize = 3;
    TaskRunner runner(1);
    const fs::path file = folder_ / "hall.acentric.json";
    const auto open = makeProject(folder_ / "hall.obj", file, options, host, runner);
    ASSERT_TRUE(open) << open.error().describe();
    auto storeys = openStoreys(open->open, host);
    ASSERT_TRUE(storeys) << storeys.error().describe();
    storeys_ = new std::vector<OpenProject>(std::move(*storeys));
  }
  static void TearDownTestSuite() {
    delete storeys_;
    fs::remove_all(folder_);
  }
  static const Project& project() { return storeys_->front().project; }
  static StoreyGround ground() { return StoreyGround(storeys_->front().layouts); }
  static int storeyAtHeight(double height) {
    for (std::size_t s = 0; s < project().storeys.size(); ++s)
      if (!isStairs(project().storeys[s]) &&
          std::abs(project().storeys[s].layout.floorHeight - height) < 0.05)
        return int(s);
    return -1;
  }

  /// Walks straight on in the steps of a frame; the ground stays near the truth, has no jump, and there is a
  /// region and a camera height for the eye everywhere. The storeys on the way, in order.
  template <class Truth>
  static std::vector<int> expectWalk(const Footing& from, const glm::dvec2& to, const Truth& truth) {
    const StoreyGround ground = StairStoreysTest::ground();
    const glm::dvec2 step = 0.023 * glm::normalize(to - from.place);
    std::vector<int> way{from.storey};
    Footing at = from;
    while (glm::dot(to - at.place, step) > 0) {
      const Footing next = ground.walk(at, at.place + step);
      EXPECT_LT(glm::distance(next.place, at.place + step), 1e-6) << "stopped at " << at.place.x;
      if (next.place == at.place) break;
      EXPECT_LT(std::abs(next.ground - at.ground), 0.04) << at.place.x;
      EXPECT_NEAR(next.ground, truth(next.place.x), 0.1) << at.place.x;
      const OpenProject& open = (*storeys_)[std::size_t(next.storey)];
      EXPECT_TRUE(open.layout->regionAt(next.place)) << at.place.x;
      EXPECT_NEAR(next.ground, open.layout->spec.floorHeight, 0.25) << "far from its cameras";
      // A frame that knows the eye alone is drawn from where it stands, too, and as near to its cameras.
      const glm::dvec3 eye(next.place, next.ground + open.layout->spec.eyeHeight);
      const OpenProject& drawn = (*storeys_)[storeyAt(*storeys_, eye)];
      EXPECT_TRUE(drawn.layout->regionAt(next.place)) << at.place.x;
      EXPECT_NEAR(eye.z, drawn.layout->eyeZ(), 0.25);
      if (way.back() != next.storey) way.push_back(next.storey);
      at = next;
    }
    return way;
  }

  static inline fs::path folder_;
  static inline std::vector<OpenProject>* storeys_ = nullptr;
};

TEST_F(StairStoreysTest, AFlightIsWalkedUpAndDownPieceByPiece) {
  const int lower = storeyAtHeight(0), upper = storeyAtHeight(StairHall::kUpper);
  ASSERT_GE(lower, 0);
  ASSERT_GE(upper, 0);
  const glm::dvec2 below(2, StairHall::kFlightY), above(10, StairHall::kFlightY);
  std::vector<int> up = expectWalk(ground().on(lower, below).value(), above, StairHall::flightGround);
  EXPECT_EQ(up.front(), lower);
  EXPECT_EQ(up.back(), upper);
  EXPECT_GE(up.size(), 2u + 8);
  EXPECT_EQ(std::set<int>(up.begin(), up.end()).size(), up.size()) << "none is entered twice";
  std::vector<int> down = expectWalk(ground().on(upper, above).value(), below, StairHall::flightGround);
  std::ranges::reverse(down);
  EXPECT_EQ(down, up);
}

TEST_F(StairStoreysTest, ARampIsWalkedToo) {
  const int lower = storeyAtHeight(0), upper = storeyAtHeight(StairHall::kPlatform);
  ASSERT_GE(upper, 0);
  const std::vector<int> up = expectWalk(ground().on(lower, {11.5, StairHall::kRampY}).value(),
                                         {1, StairHall::kRampY}, StairHall::rampGround);
  EXPECT_EQ(up.back(), upper);
  EXPECT_GE(up.size(), 2u + 3);
}

TEST_F(StairStoreysTest, NobodyWalksOffTheSideOfAFlightNorThroughTheFloor) {
  const StoreyGround ground = StairStoreysTest::ground();
  Footing at = ground.on(storeyAtHeight(0), {2, StairHall::kFlightY}).value();
  while (at.place.x < 6) at = ground.walk(at, at.place + glm::dvec2(0.02, 0));
  for (int n = 0; n < 100; ++n) at = ground.walk(at, at.place + glm::dvec2(0, 0.03));
  EXPECT_LT(at.place.y, StairHall::kFlightY + 0.7 + 0.25);
  EXPECT_GT(at.ground, 1);
  // On the gallery, above the ramp's foot, and below it.
  EXPECT_NEAR(ground.on(storeyAtHeight(StairHall::kUpper), {9.5, StairHall::kRampY}).value().ground,
              StairHall::kUpper, 1e-3);
  EXPECT_NEAR(ground.on(storeyAtHeight(0), {12, 4}).value().ground, 0, 1e-3);
  EXPECT_FALSE(ground.on(storeyAtHeight(StairHall::kUpper), {4, 4}));
}

TEST_F(StairStoreysTest, EachPieceHasFewCamerasAtItsEyeHeight) {
  int pieces = 0;
  for (const OpenProject& open : *storeys_) {
    const Storey& storey = open.project.current();
    if (!isStairs(storey)) continue;
    ++pieces;
    EXPECT_LE(open.layout->cameras.size(), 40u) << storey.name;
    const LayoutSpec& spec = storey.layout;
    double low = 1e9, high = -1e9;
    for (const auto& loop : spec.outline.loops)
      for (const glm::dvec2& corner : loop)
        low = std::min(low, spec.groundAt(corner)), high = std::max(high, spec.groundAt(corner));
    EXPECT_LT(high - low, 0.3 + 2 * 0.35 * glm::length(spec.slope->rise))
        << "what it reaches over its neighbours";
    EXPECT_TRUE(mayStand(*open.layout, storey.spawn.position)) << storey.name;
  }
  EXPECT_GE(pieces, 11);
}

TEST_F(StairStoreysTest, AreInTheProjectsFile) {
  const auto read = parseProject(formatProject(project()), "hall.acentric.json");
  ASSERT_TRUE(read) << read.error().describe();
  ASSERT_EQ(read->storeys.size(), project().storeys.size());
  for (std::size_t s = 0; s < read->storeys.size(); ++s) {
    const Storey &is = read->storeys[s], &was = project().storeys[s];
    EXPECT_EQ(is.layout.slope, was.layout.slope) << was.name;
    EXPECT_TRUE(!isStairs(was) || is == was) << was.name;
  }
  EXPECT_EQ(read->paths, project().paths);
  EXPECT_EQ(formatProject(*read), formatProject(project()));
}

TEST_F(StairStoreysTest, FollowTheModelsScale) {
  const Scene& scene = *storeys_->front().imported;
  const Project half = atScale(project(), scene, 0.5 * scene.report.metresPerUnit);
  const auto first = std::ranges::find_if(project().storeys, isStairs) - project().storeys.begin();
  const LayoutSpec &was = project().storeys[std::size_t(first)].layout,
                   &is = half.storeys[std::size_t(first)].layout;
  ASSERT_TRUE(is.slope);
  EXPECT_EQ(is.slope->rise, was.slope->rise);
  EXPECT_NEAR(is.cellSize, 0.5 * was.cellSize, 1e-9);
  EXPECT_NEAR(glm::distance(is.slope->at, is.latticeOrigin),
              0.5 * glm::distance(was.slope->at, was.latticeOrigin), 1e-9);
}

TEST_F(StairStoreysTest, PathsLeadUpThem) {
  ASSERT_EQ(project().paths.size(), 2u);
  for (const WalkPath& path : project().paths) {
    EXPECT_TRUE(isStairs(project().storeys[std::size_t(path.storey)]));
    for (std::size_t p = 1; p < path.path.poses.size(); ++p)
      EXPECT_GT(path.path.poses[p].eye.z, path.path.poses[p - 1].eye.z);
  }
  Project without = project();
  EXPECT_EQ(removeStairs(without), int(std::ranges::count_if(project().storeys, isStairs)));
  EXPECT_TRUE(without.paths.empty());
  EXPECT_TRUE(std::ranges::none_of(without.storeys, isStairs));
}

TEST_F(StairStoreysTest, RefuseASlopeThatIsNone) {
  Project bad = project();
  for (const glm::dvec2 rise : {glm::dvec2(3, 0), glm::dvec2(std::nan(""), 0)}) {
    bad.layout().slope = {{0, 0}, rise};
    ASSERT_FALSE(bad.check());
    EXPECT_THAT(bad.check().error().message,
                testing::AllOf(HasSubstr("/layout"), HasSubstr("rise"), HasSubstr("0..2")));
  }
}

TEST(StoreyChoice, TakesTheStoreyThatHoldsTheEyeBeforeOneAtItsHeight) {
  LayoutSpec spec;
  spec.outline.loops = {{{0, 0}, {2, 0}, {2, 2}, {0, 2}}};
  const Layout low = buildLayout(spec).value();
  spec.floorHeight = 0.3;
  spec.latticeOrigin = {20, 0};
  spec.outline.loops = {{{20, 0}, {22, 0}, {22, 2}, {20, 2}}};
  const Layout beside = buildLayout(spec).value();
  EXPECT_LT(misfitOf(low, {1, 1, 1.8}), misfitOf(beside, {1, 1, 1.8}));
  EXPECT_TRUE(std::isinf(misfitOf(Layout{}, {0, 0, 0})));
}

}  // namespace
}  // namespace acentric
