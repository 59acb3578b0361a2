/// Where local geometry ends and captures begin: nothing is left open between them.

#include <algorithm>
#include <cmath>

#include "engine/geometry/conventions.h"
#include "tests/pipeline/baked_room.h"

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

/// Of frames from all over the plan, in all directions, level and down at the floor. The room is closed: what
/// is open is a hole.
std::uint64_t holesOf(const test::BakedRoom& room, Renderer renderer) {
  ViewSettings settings;
  settings.renderer = renderer;
  TaskRunner runner(1);
  FrameMemory memory;
  std::uint64_t holes = 0;
  for (int n = 0; n < 40; ++n) {
    PerspectiveView view;
    view.eye = {0.9 * std::cos(2.4 * n), 0.9 * std::sin(2.4 * n) * n / 40, room.open.layout->eyeZ()};
    view.yawRadians = 0.37 * n;
    view.pitchRadians = n % 3 == 0 ? radians(-35) : 0;
    view.width = 640, view.height = 360;
    auto frame = renderFrame(room.walk, view, settings, runner, memory);
    EXPECT_TRUE(frame) << frame.error().describe();
    if (!frame) return 0;
    holes += std::uint64_t(std::ranges::count_if(frame->source.pixels, test::isOpen));
    memory.frame = std::move(*frame);
  }
  return holes;
}

TEST(BorderStrip, LeavesNothingOpenBetweenLocalGeometryAndCaptures) {
  const test::BakedRoom room(narrowRoom(), test::smallProject(1.2, 4));
  for (const Renderer renderer : {Renderer::list, Renderer::zbuffer, Renderer::precise})
    EXPECT_EQ(holesOf(room, renderer), 0u) << int(renderer);
}

}  // namespace
}  // namespace acentric
