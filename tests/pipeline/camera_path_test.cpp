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
