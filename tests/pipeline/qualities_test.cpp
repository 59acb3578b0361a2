#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/pipeline/bake_plan.h"
#include "tests/pipeline/small_project.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {

using test::SceneBuilder;

class Qualities : public FolderTest {
 protected:
  OpenProject openSmallRoom() const {
    SceneBuilder builder;
    builder.box(builder.material(test::matte()), {-4, -4, 0}, {4, 4, 3}, true).point({0, 0, 2.5f}, 50);
    Project project = test::smallProject(0.5, 2);
    project.bake.ambientRays = 0;
    return test::openWith(builder.rays(), project, folder_ / "room.acentric.json");
  }
  static ProjectBakeReport baked(const OpenProject& open, const BakeRequest& request) {
    TaskRunner runner(1);
    auto report = bakeProject(open, request, runner);
    EXPECT_TRUE(report) << (report ? "" : report.error().describe());
    return report ? *report : ProjectBakeReport{};
  }
  static LoadedWalk loaded(const OpenProject& open) {
    TaskRunner runner(1);
    auto walk = loadWalk(open, nullptr, runner);
    EXPECT_TRUE(walk);
    return walk ? std::move(*walk) : LoadedWalk{};
  }
};

TEST_F(Qualities, TheWalkShowsTheBestOfEachCamera) {
  const OpenProject open = openSmallRoom();
  BakeRequest request;
  request.surfaceLight = false;
  const int cameras = int(open.keys.size());
  ASSERT_GT(cameras, 4);
  EXPECT_EQ(baked(atQuality(open, Quality::preview), request).captures.baked, cameras);
  LoadedWalk walk = loaded(open);
  EXPECT_EQ(walk.missing, 0);
  EXPECT_EQ(walk.coarse, cameras);
  EXPECT_EQ(coarseText(walk), fmt::format("{0} of {0} cameras are previews or drafts so far", cameras));
  EXPECT_EQ(walk.walk.captures[0]->camera.columns, 30) << "a quarter of the resolution";
  EXPECT_EQ(std::ranges::count(bakedCameras(open), true), 0) << "a preview is not the bake";
  EXPECT_EQ(std::ranges::count(capturesOnDisk(open).stale, true), 0) << "nor is it of another project";
  Project other = open.project;
  other.layout().eyeHeight += 0.05;
  const OpenProject changed = test::openWith(open.rays, other, open.file);
  EXPECT_EQ(std::ranges::count(capturesOnDisk(changed).stale, true), cameras);

  request.cameras = std::vector{2};
  baked(open, request);
  walk = loaded(open);
  EXPECT_EQ(walk.coarse, cameras - 1);
  EXPECT_EQ(walk.walk.captures[2]->camera.columns, 120);
  EXPECT_EQ(walk.walk.captures[0]->camera.columns, 30);
  EXPECT_EQ(walk.keys[2], open.keys[2]);

  // A draft replaces the preview, but not what is final.
  request.cameras.reset();
  baked(atQuality(open, Quality::draft), request);
  walk = loaded(open);
  EXPECT_EQ(walk.walk.captures[2]->camera.columns, 120);
  EXPECT_EQ(walk.walk.captures[0]->camera.columns, 60);
}

TEST_F(Qualities, CoarseFirstMakesPreviewsOnlyOfWhatHasNothingYet) {
  const OpenProject open = openSmallRoom();
  BakeRequest request;
  request.surfaceLight = false;
  request.coarseFirst = true;
  std::stop_source stop;
  TaskRunner runner(1);
  request.from = glm::dvec2(100, 0);  // where there is no view that comes first
  // Stopped at the first camera of the final pass: by then every camera has a preview.
  request.watch = [&](const CameraNews& news) {
    if (!news.preview) stop.request_stop();
  };
  const auto stopped = bakeProject(open, request, runner, {}, stop.get_token());
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().kind, ErrorKind::cancelled);
  EXPECT_EQ(loaded(open).missing, 0);
  EXPECT_GT(loaded(open).coarse, 0);
  request.watch = {};
  const ProjectBakeReport rest = baked(open, request);
  EXPECT_EQ(rest.captures.baked + rest.captures.reused, int(open.keys.size()));
  EXPECT_EQ(coarseText(loaded(open)), "");
  EXPECT_EQ(baked(open, request).captures.baked, 0);
}

}  // namespace
}  // namespace acentric
