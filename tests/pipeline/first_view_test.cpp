#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <set>

#include "engine/pipeline/local_triangles.h"
#include "engine/pipeline/walk_stream.h"
#include "tests/pipeline/small_project.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {

using test::SceneBuilder;

class FirstView : public FolderTest {
 protected:
  /// A room with posts all over it, so that each region draws some that others do not.
  OpenProject openPosts(const std::string& name) const {
    SceneBuilder builder;
    const int matte = builder.material(test::matte());
    builder.box(matte, {-5, -5, 0}, {5, 5, 3}, true).point({0.3f, 0.2f, 2.5f}, 50);
    for (int x = -4; x <= 4; x += 2)
      for (int y = -4; y <= 4; y += 2) {
        const glm::vec3 low(float(x) + 0.1f, float(y) + 0.1f, 0);
        builder.box(matte, low, low + glm::vec3(0.2f, 0.2f, 1));
      }
    Project project = test::smallProject(4, 1);
    project.bake.ambientRays = 0;
    project.bake.surfaceTexel = 0.1;
    return test::openWith(builder.rays(), project, folder_ / (name + ".acentric.json"));
  }
  static BakeRequest coarseFirst() {
    BakeRequest request;
    request.coarseFirst = true;
    request.from = glm::dvec2(0, 0);
    return request;
  }
  static ProjectBakeReport baked(const OpenProject& open, const BakeRequest& request,
                                 const std::stop_token& stop = {}) {
    TaskRunner runner(1);
    auto report = bakeProject(open, request, runner, {}, stop);
    EXPECT_TRUE(report || stop.stop_requested()) << report.error().describe();
    return report ? *report : ProjectBakeReport{};
  }
  static SurfaceLight lightOf(const OpenProject& open, const ContentKey& key) {
    auto light = CaptureStore::open(captureFolderFor(open.file))->getSurfaceLight(key);
    EXPECT_TRUE(light);
    return light ? std::move(*light) : SurfaceLight{};
  }
  /// Of the light that a walk would have now; nothing where it has none.
  static std::optional<ContentKey> loadedLightKey(const OpenProject& open) {
    const auto start = startWalk(open, nullptr);
    EXPECT_TRUE(start);
    if (!start || !start->walk.walk.surfaceLight) return std::nullopt;
    return start->walk.surfaceLightKey;
  }
  static bool same(const SurfaceLight& a, const SurfaceLight& b) {
    return a.firstSample == b.firstSample && a.light.size() == b.light.size() &&
           std::memcmp(a.light.data(), b.light.data(), a.light.size() * sizeof(HalfColour)) == 0;
  }
};

TEST_F(FirstView, IsCompleteBeforeAnythingElseIsBegun) {
  const OpenProject open = openPosts("order");
  const std::vector<int> view = firstViewCameras(open, {0, 0});
  ASSERT_GT(view.size(), 2u);
  ASSERT_LT(view.size(), open.keys.size());
  const auto inView = [&](int camera) { return std::ranges::find(view, camera) != view.end(); };

  std::set<std::pair<bool, int>> done;  // preview?, camera
  const auto count = [&](bool preview, bool first) {
    return std::size_t(std::ranges::count_if(
        done, [&](const auto& entry) { return entry.first == preview && inView(entry.second) == first; }));
  };
  const std::size_t others = open.keys.size() - view.size();
  bool lit = false;
  BakeRequest request = coarseFirst();
  request.watch = [&](const CameraNews& news) {
    if (news.stage == CameraStage::done) done.insert({news.preview, news.camera});
    if (news.stage != CameraStage::tracing || news.columnsDone > 0) return;
    const bool first = inView(news.camera);
    const std::size_t othersBegun = count(true, false) + count(false, false);
    EXPECT_TRUE(news.preview || count(true, true) == view.size()) << "previews of the first view come first";
    EXPECT_TRUE(!first || othersBegun == 0) << "others come after";
    EXPECT_TRUE(first || count(false, true) == view.size()) << "the first view is complete";
    EXPECT_TRUE(first || news.preview || count(true, false) == others) << "all have a preview";
    if (first || !news.preview || lit) return;
    lit = true;
    EXPECT_EQ(loadedLightKey(open), firstLightKey(open.surfaceLightKey)) << "with its light";
  };
  const ProjectBakeReport report = baked(open, request);
  EXPECT_TRUE(lit);
  EXPECT_EQ(report.captures.baked, int(open.keys.size()));
  EXPECT_EQ(done.size(), 2 * open.keys.size());
  std::set<int> reported;
  for (const BakedCamera& camera : report.captures.cameras) reported.insert(camera.camera);
  EXPECT_EQ(reported.size(), open.keys.size()) << "each is in the report";
  EXPECT_TRUE(report.surfaceLightBaked);
  EXPECT_EQ(report.surfaceLightResumed, 0u) << "what this bake left for itself is no earlier bake's";
}

TEST_F(FirstView, HasTheLightThatIsWholeLaterAndTheMeanElsewhere) {
  const OpenProject whole = openPosts("whole"), open = openPosts("open");
  baked(whole, {});
  const SurfaceLight expected = lightOf(whole, whole.surfaceLightKey);

  const std::vector<int> view = firstViewCameras(open, {0, 0});
  std::stop_source stop;
  BakeRequest request = coarseFirst();
  request.watch = [&](const CameraNews& news) {
    if (std::ranges::find(view, news.camera) == view.end()) stop.request_stop();
  };
  baked(open, request, stop.get_token());
  const ContentKey first = firstLightKey(open.surfaceLightKey);
  const SurfaceLight light = lightOf(open, first);
  ASSERT_EQ(light.resolution.size(), expected.resolution.size());
  const Region& home = open.layout->regions[std::size_t(*open.layout->regionAt({0, 0}))];
  const std::vector<std::uint8_t> near = localTrianglesOf(*open.drawn, home);
  std::size_t others = 0, alike = 0;
  for (std::size_t t = 0; t < near.size(); ++t) {
    EXPECT_LE(light.resolution[t], expected.resolution[t]) << "the whole is finer at the edges of shadows";
    for (std::uint32_t s = light.firstSample[t]; s < light.firstSample[t + 1]; ++s)
      if (near[t] == 0) {
        ++others;
        EXPECT_GT(unpackColour(light.light[s]).x, 0) << "not black";
      } else if (light.resolution[t] == expected.resolution[t]) {
        ++alike;
        EXPECT_EQ(unpackColour(light.light[s]),
                  unpackColour(expected.light[expected.firstSample[t] + s - light.firstSample[t]]));
      }
  }
  EXPECT_GT(alike, 0u);
  EXPECT_GT(others, 0u);

  request.watch = {};
  const ProjectBakeReport rest = baked(open, request);
  EXPECT_GT(rest.surfaceLightResumed, 0u) << "what the first view had is not baked again";
  EXPECT_TRUE(same(lightOf(open, open.surfaceLightKey), expected));
  EXPECT_FALSE(CaptureStore::open(captureFolderFor(open.file))->hasSurfaceLight(first)) << "it is done with";
  EXPECT_EQ(loadedLightKey(open), open.surfaceLightKey);
}

}  // namespace
}  // namespace acentric
