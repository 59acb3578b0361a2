/// Where local geometry ends and captures begin: nothing is left open between them.

#include <gtest/gtest.h>

#include "engine/bake/bake.h"
#include "engine/scene/local_geometry.h"
#include "engine/view/render.h"
#include "tests/bake/memory_sink.h"
#include "tests/pipeline/small_project.h"

namespace acentric {
namespace {

/// A room so small that its walls cross the borders of all regions.
RayScenePtr narrowRoom() {
  test::SceneBuilder builder;
  Material grey = test::matte({0.4f, 0.35f, 0.3f});
  grey.unlit = true;
  builder.box(builder.material(grey), {-2.1, -1.9, 0}, {2.1, 1.9, 2.6}, true);
  return builder.rays();
}

class BorderStrip : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    open_ = new OpenProject(test::openWith(narrowRoom(), test::smallProject(1.2, 4)));
    walk_ = new WalkScene;
    test::MemorySink memory;
    TaskRunner runner(1);
    std::vector<int> all;
    for (std::size_t c = 0; c < open_->layout->cameras.size(); ++c) all.push_back(int(c));
    ASSERT_TRUE(bake(*open_->rays, *open_->layout, all, open_->project.bake, memory, runner));
    walk_->scene = open_->scene;
    walk_->layout = open_->layout;
    walk_->plan = open_->plan;
    for (const Region& region : open_->layout->regions)
      walk_->local.push_back(
          std::make_shared<const LocalGeometry>(clipToPolygon(*open_->scene, region.grown)));
    for (const ContentKey& key : open_->keys)
      walk_->captures.push_back(
          std::make_shared<const DisplayCapture>(prepareForDisplay(*memory.find(key), 1)));
  }
  static void TearDownTestSuite() { delete open_, delete walk_; }

  /// Of frames from all over the plan, in all directions, level and down at the floor. The room is closed:
  /// what is open is a hole.
  static std::uint64_t holesOf(const WalkScene& walk, Renderer renderer) {
    ViewSettings settings;
    settings.renderer = renderer;
    TaskRunner runner(1);
    FrameMemory memory;
    std::uint64_t holes = 0;
    for (int n = 0; n < 40; ++n) {
      PerspectiveView view;
      view.eye = {0.9 * std::cos(2.4 * n), 0.9 * std::sin(2.4 * n) * n / 40, open_->layout->eyeZ()};
      view.yawRadians = 0.37 * n;
      view.pitchRadians = n % 3 == 0 ? radians(-35) : 0;
      view.width = 640, view.height = 360;
      auto frame = renderFrame(walk, view, settings, runner, memory);
      EXPECT_TRUE(frame) << frame.error().describe();
      if (!frame) return 0;
      for (const PixelSource source : frame->source.pixels)
        holes += source == kSourceHole || source == kSourceInvented ? 1 : 0;
      memory.frame = std::move(*frame);
    }
    return holes;
  }

  static inline OpenProject* open_ = nullptr;
  static inline WalkScene* walk_ = nullptr;
};

TEST_F(BorderStrip, LeavesNothingOpenBetweenLocalGeometryAndCaptures) {
  for (const Renderer renderer : {Renderer::list, Renderer::zbuffer, Renderer::precise})
    EXPECT_LT(holesOf(*walk_, renderer), 20u) << int(renderer);
}

}  // namespace
}  // namespace acentric
