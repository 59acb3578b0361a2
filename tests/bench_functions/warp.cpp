/// Frames of the renderers on a load like a walk's: a hexagon ring, dense captures of 480
/// columns.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/geometry/conventions.h"
#include "engine/view/render.h"
#include "engine/view/view_plan.h"
#include "engine/view/warp.h"
#include "tests/bench_functions/benches.h"
#include "tests/view/analytic_scene.h"

namespace acentric::bench {
namespace {

/// Frames of an empty room and boxes, at so many samples per degree.
Status timeFrames(double perDegree, int layers, int width, int height, Figures& figures) {
  const std::string size =
      fmt::format("{}x{}, {}/degree, {} layer{}", width, height, perDegree, layers, layers > 1 ? "s" : "");
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const auto region = layout->regionAt({0, 0});
  const WalkScene scene = test::walkScene(test::randomBoxes(1, 60, 3.2), layout, *region, perDegree, layers);
  PerspectiveView view;
  view.width = width, view.height = height;
  view.eye = {0.4, 0.3, layout->eyeZ()};
  view.yawRadians = 0.7;

  for (bool secondary : {false, true}) {
    ViewSettings settings;
    settings.secondaryCover = secondary;
    const auto plan = planView(scene, view, settings);
    if (!plan) return tl::unexpected(plan.error());
    const std::string work = fmt::format("{}, {} pieces: ", size, plan->pieces.size());
    for (const bool depthTest : {false, true}) {
      WarpOptions options;
      options.depthTest = depthTest;
      Canvas canvas;
      clearCanvas(scene, view, *plan, 0, view.width, canvas);
      WarpCounts counts;
      const auto warp = [&] {
        counts = warpPieces(scene, view, settings, *plan, options, 0, view.width, canvas);
      };
      figures.add(work + (depthTest ? "warp with a depth buffer, 1 thread" : "warp, 1 thread"), "ms",
                  scaled(secondsOf(20, warp), 1e3));
      figures.fact(work + "samples read", counts.samplesRead);
      figures.fact(work + "samples drawn", counts.samplesDrawn);
    }
    TaskRunner two(1);
    FrameMemory memory;
    const auto draw = [&](Renderer renderer, Reconstruction reconstruction) {
      settings.renderer = renderer;
      settings.reconstruction = reconstruction;
      settings.fillHoles = true;
      auto frame = renderFrame(scene, view, settings, two, memory);
      memory.frame = std::move(*frame);
    };
    for (const Renderer other : {Renderer::scalar, Renderer::zbuffer}) {
      const Turns turns = secondsByTurns(
          10, [&] { draw(Renderer::list, Reconstruction::splat); },
          [&] { draw(other, Reconstruction::splat); });
      figures.add(fmt::format("{}frame, list splat, against {}", work, nameOf(other)), "ms",
                  scaled(turns.one, 1e3), nameOf(other), scaled(turns.other, 1e3));
    }
    figures.add(work + "frame, list point", "ms",
                scaled(secondsOf(10, [&] { draw(Renderer::list, Reconstruction::point); }), 1e3));
  }
  return {};
}

}  // namespace

Status benchWarp(const Subject&, Figures& figures) {
  if (Status timed = timeFrames(8, 1, 960, 540, figures); !timed) return timed;
  return timeFrames(20, 3, 1280, 720, figures);
}

}  // namespace acentric::bench
