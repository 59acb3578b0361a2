/// Frame times of the OpenGL renderer, and of the CPU's in the same run, on a load like a walk's.
#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "engine/view/render.h"
#include "engine/view_gl/gl_renderer.h"
#include "tests/view/analytic_scene.h"

using namespace acentric;

int main() {
  const auto context = HeadlessContext::create();
  if (!context) return fmt::print("{}\n", context.error().describe()), 1;
  fmt::print("{}\n", (*context)->description());
  const auto renderer = GlRenderer::create();
  if (!renderer) return fmt::print("{}\n", renderer.error().describe()), 1;

  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const WalkScene scene =
      test::walkScene(test::randomBoxes(1, 60, 3.2), layout, *layout->regionAt({0, 0}), 8);
  PerspectiveView view;  // 960 x 540
  view.eye = {0.4, 0.3, layout->eyeZ()};
  view.yawRadians = 0.7;
  TaskRunner two(1);
  for (bool secondary : {false, true})
    for (bool fill : {false, true}) {
      ViewSettings settings;
      settings.secondaryCover = secondary;
      settings.fillHoles = fill;
      FrameStats best;
      best.totalSeconds = 1e9;
      double processor =
          1e9;  // seconds of all threads: on a busy machine the fairer measure of a software driver
      for (int i = 0; i < 6; ++i) {
        const std::clock_t start = std::clock();
        const auto stats = (*renderer)->draw(scene, view, settings);
        processor = std::min(processor, double(std::clock() - start) / CLOCKS_PER_SEC);
        if (!stats) return fmt::print("{}\n", stats.error().describe()), 1;
        if (stats->totalSeconds < best.totalSeconds) best = *stats;
      }
      double cpu = 1e9;
      for (int i = 0; i < 6; ++i)
        cpu = std::min(cpu, renderFrame(scene, view, settings, two)->stats.totalSeconds);
      fmt::print(
          "{} images, {} samples{}: gl {:.1f} ms (warp {:.1f}, fill {:.1f}; {:.1f} ms of processor time); ",
          best.images, best.samplesRead, fill ? ", filled" : "", best.totalSeconds * 1e3,
          best.warpSeconds * 1e3, best.fillSeconds * 1e3, processor * 1e3);
      fmt::print("list on 2 threads {:.1f} ms\n", cpu * 1e3);
    }
}
