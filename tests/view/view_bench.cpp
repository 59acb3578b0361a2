/// Samples per second of the renderers on a load like a walk's: a hexagon ring, dense captures of 480
/// columns.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "analytic_scene.h"
#include "engine/view/kernels.h"
#include "engine/view/render.h"
#include "engine/view/view_plan.h"
#include "engine/view/warp.h"

using namespace acentric;

namespace {

double best(int repeats, const std::function<void()>& work) {
  double seconds = 1e9;
  for (int i = 0; i < repeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    seconds =
        std::min(seconds, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return seconds;
}

}  // namespace

int main() {
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const auto region = layout->regionAt({0, 0});
  const WalkScene scene = test::walkScene(test::randomBoxes(1, 60, 3.2), layout, *region, 8);
  PerspectiveView view;
  view.eye = {0.4, 0.3, layout->eyeZ()};
  view.yawRadians = 0.7;

  for (bool secondary : {false, true}) {
    ViewSettings settings;
    settings.secondaryCover = secondary;
    const auto plan = planView(scene, view, settings);
    if (!plan) return 1;
    struct Case {
      std::string name;
      ProjectSamples project;
      bool depthTest;
    };
    std::vector<Case> cases;
    for (const Kernels& kernels : supportedKernels()) cases.push_back({kernels.name, kernels.project, false});
    cases.push_back({"depth buffer", supportedKernels().back().project, true});
    for (const Case& c : cases) {
      WarpOptions options;
      options.project = c.project;
      options.depthTest = c.depthTest;
      Canvas canvas;
      clearCanvas(scene, view, settings, *plan, 0, view.width, canvas);
      WarpCounts counts;
      const double seconds = best(
          20, [&] { counts = warpPieces(scene, view, settings, *plan, options, 0, view.width, canvas); });
      fmt::print(
          "{} pieces, {:12} one thread: {:6.2f} ms, {} read, {} drawn, {:.0f} M drawn/s, {:.0f} M read/s\n",
          plan->pieces.size(), c.name, seconds * 1e3, counts.samplesRead, counts.samplesDrawn,
          static_cast<double>(counts.samplesDrawn) / seconds * 1e-6,
          static_cast<double>(counts.samplesRead) / seconds * 1e-6);
    }
    TaskRunner two(1);
    FrameMemory memory;
    for (const auto& [renderer, reconstruction] : {std::pair(Renderer::scalar, Reconstruction::splat),
                                                   std::pair(Renderer::list, Reconstruction::splat),
                                                   std::pair(Renderer::zbuffer, Reconstruction::splat),
                                                   std::pair(Renderer::list, Reconstruction::point),
                                                   std::pair(Renderer::scalar, Reconstruction::filtered),
                                                   std::pair(Renderer::list, Reconstruction::filtered)}) {
      settings.renderer = renderer;
      settings.reconstruction = reconstruction;
      settings.fillHoles = true;
      FrameStats stats;
      std::size_t holes = 0;
      const double seconds = best(10, [&] {
        auto frame = renderFrame(scene, view, settings, two, memory);
        stats = frame->stats;
        holes = frame->holeCount();
        memory.frame = std::move(*frame);
      });
      fmt::print("frame {} {} 2 threads {:.2f} ms (warp {:.2f}, fill {:.2f}), {} holes\n", nameOf(renderer),
                 nameOf(reconstruction), seconds * 1e3, stats.warpSeconds * 1e3, stats.fillSeconds * 1e3,
                 holes);
    }
  }
}
