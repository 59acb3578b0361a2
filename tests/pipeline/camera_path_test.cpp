#include "engine/pipeline/camera_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "engine/base/file.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;

class CameraPathTest : public testing::Test {
 protected:
  fs::path file_ = fs::temp_directory_path() / ("acentric-path-test-" + std::to_string(::getpid()) + ".json");
  void TearDown() override { fs::remove(file_); }
  std::string refusalOf(const std::string& text) {
    EXPECT_TRUE(writeTextAtomically(file_, text));
    const auto path = loadPath(file_);
    return path ? "accepted" : path.error().describe();
  }
};

TEST_F(CameraPathTest, RoundTrips) {
  const CameraPath path{{{{1, 2.5, 1.6}, radians(90.0), radians(-10.0)}, {{-3, 0, 1.6}, 0, 0}}};
  ASSERT_TRUE(savePath(path, file_));
  const auto back = loadPath(file_);
  ASSERT_TRUE(back) << back.error().describe();
  ASSERT_EQ(back->poses.size(), 2u);
  EXPECT_EQ(back->poses[0].eye, path.poses[0].eye);
  EXPECT_NEAR(back->poses[0].yawRadians, path.poses[0].yawRadians, 1e-7);
  EXPECT_NEAR(back->poses[0].pitchRadians, path.poses[0].pitchRadians, 1e-7);
}

TEST_F(CameraPathTest, RefusesWithAPointerToTheCulprit) {
  using testing::HasSubstr;
  EXPECT_THAT(refusalOf(R"({"version":1,"frames":[{"eye":[0,0,1]},{"eye":[0,0]}]})"), HasSubstr("/frames/1"));
  EXPECT_THAT(refusalOf(R"({"version":1,"frames":[{"eye":[0,0,1],"pitch":91}]})"), HasSubstr("pitch"));
  EXPECT_THAT(refusalOf(R"({"version":1,"frames":[{"eye":[0,"a",1]}]})"), HasSubstr("/frames/0"));
  EXPECT_THAT(refusalOf(R"({"version":1,"frames":[]})"), HasSubstr("/frames"));
  EXPECT_THAT(refusalOf(R"({"version":2,"frames":[{"eye":[0,0,1]}]})"), HasSubstr("camera path"));
  EXPECT_THAT(refusalOf("{"), HasSubstr("JSON"));
}

/// 2 s eastwards while turning left over north by 20 degrees, then 1 s of looking up.
CameraPath threePoses() {
  return {{{{0, 0, 1.6}, radians(350.0), 0, 0},
           {{4, 0, 1.6}, radians(10.0), 0, 2},
           {{4, 0, 1.6}, radians(10.0), radians(30.0), 3}}};
}

TEST_F(CameraPathTest, TimesRoundTrip) {
  ASSERT_TRUE(savePath(threePoses(), file_));
  const auto back = loadPath(file_);
  ASSERT_TRUE(back) << back.error().describe();
  ASSERT_TRUE(back->timed());
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(back->poses[i].seconds, threePoses().poses[i].seconds);
}

TEST_F(CameraPathTest, RefusesTimesThatDoNotAscend) {
  using testing::HasSubstr;
  const auto frames = [](const std::string& list) { return R"({"version":1,"frames":[)" + list + "]}"; };
  const std::string first = R"({"eye":[0,0,1],"seconds":0})", third = R"({"eye":[0,0,1],"seconds":2})";
  EXPECT_EQ(refusalOf(frames(first + "," + third)), "accepted");
  EXPECT_THAT(refusalOf(frames(first + "," + third + "," + third)), HasSubstr("/frames/2"));
  EXPECT_THAT(refusalOf(frames(third + "," + first)), HasSubstr("/frames/0"));
  EXPECT_THAT(refusalOf(frames(first + R"(,{"eye":[0,0,1]},)" + third)), HasSubstr("/frames/1"));
  EXPECT_THAT(refusalOf(frames(first + R"(,{"eye":[0,0,1],"seconds":1e9})")), HasSubstr("/frames/1"));
  EXPECT_THAT(refusalOf(frames(first + R"(,{"eye":[0,0,1],"seconds":"2"})")), HasSubstr("seconds"));
}

TEST(PoseAt, MovesAndTurnsEvenlyTheShorterWayRound) {
  const CameraPath path = threePoses();
  const PathPose middle = poseAt(path, 1);
  EXPECT_NEAR(middle.eye.x, 2, 1e-12);
  EXPECT_NEAR(std::remainder(middle.yawRadians, kTwoPi), 0, 1e-12);
  EXPECT_NEAR(poseAt(path, 2.5).pitchRadians, radians(15.0), 1e-12);
  EXPECT_EQ(poseAt(path, -1), path.poses.front());
  EXPECT_EQ(poseAt(path, 7), path.poses.back());
  for (const PathPose& pose : path.poses) EXPECT_EQ(poseAt(path, pose.seconds), pose);
}

TEST(FramesOf, HoldsThirtyASecondAndTheLastPose) {
  const CameraPath frames = framesOf(threePoses());
  EXPECT_FALSE(frames.timed());
  ASSERT_EQ(frames.poses.size(), 91u);
  EXPECT_NEAR(frames.poses[15].eye.x, 1, 1e-9);
  EXPECT_EQ(frames.poses.back().pitchRadians, threePoses().poses.back().pitchRadians);
  EXPECT_TRUE(frames.check());
  EXPECT_EQ(framesOf(frames), frames) << "one without times stays as it is";
}

Layout someLayout() {
  LayoutSpec spec;
  spec.cellSize = 1;
  spec.outline.loops = {{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}};
  return *buildLayout(spec);
}

TEST(Tour, StaysInsideTheLayoutAndVisitsEveryWalkableRegion) {
  const Layout layout = someLayout();
  const CameraPath path = tourOf(layout, {0, 0}, 2000);
  ASSERT_EQ(path.poses.size(), 2000u);
  std::vector<int> visits(layout.regions.size(), 0);
  for (const PathPose& pose : path.poses) {
    const auto region = layout.regionAt(glm::dvec2(pose.eye));
    ASSERT_TRUE(region);
    ++visits[std::size_t(*region)];
    EXPECT_EQ(pose.eye.z, layout.eyeZ());
  }
  for (std::size_t r = 0; r < visits.size(); ++r)
    if (layout.spec.outline.contains(layout.regions[r].polygon.centroid())) {
      EXPECT_GT(visits[r], 0);
    }
}

TEST(Clamp, LeavesInsidePointsAloneAndBringsOthersIn) {
  const Layout layout = someLayout();
  EXPECT_EQ(clampToPlan(layout, {0.25, 0.5}), glm::dvec2(0.25, 0.5));
  for (int k = 0; k < 360; ++k) {
    const glm::dvec2 inside = clampToPlan(layout, 30.0 * directionOf(radians(double(k))));
    EXPECT_TRUE(layout.regionAt(inside));
  }
}

}  // namespace
}  // namespace acentric
