/// Frames of the OpenGL renderer, and of the CPU's by turns, on a load like a walk's.
#include <fmt/format.h>

#include "engine/view/render.h"
#include "engine/view_gl/gl_renderer.h"
#include "tests/bench_functions/benches.h"
#include "tests/view/analytic_scene.h"

namespace acentric::bench {

Status benchGlFrames(const Subject& subject, Figures& figures) {
  const auto context = HeadlessContext::create();
  if (!context) return tl::unexpected(context.error());
  figures.fact("OpenGL", (*context)->description());
  const auto renderer = GlRenderer::create();
  if (!renderer) return tl::unexpected(renderer.error());
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const WalkScene scene =
      test::walkScene(test::randomBoxes(1, 60, 3.2), layout, *layout->regionAt({0, 0}), 8);
  PerspectiveView view;  // 960 x 540
  view.eye = {0.4, 0.3, layout->eyeZ()};
  view.yawRadians = 0.7;
  TaskRunner runner(subject.threads - 1);
  for (const bool secondary : {false, true})
    for (const bool fill : {false, true}) {
      ViewSettings settings;
      settings.secondaryCover = secondary;
      settings.fillHoles = fill;
      const std::string what =
          fmt::format("960x540{}{}", secondary ? ", with the other hand" : "", fill ? ", holes filled" : "");
      if (const auto first = (*renderer)->draw(scene, view, settings); !first)
        return tl::unexpected(first.error());
      else
        figures.fact(what + ": samples read", first->samplesRead);
      std::vector<double> gl, list;
      for (int turn = 0; turn < 6; ++turn) {
        gl.push_back((*renderer)->draw(scene, view, settings)->totalSeconds * 1e3);
        list.push_back(renderFrame(scene, view, settings, runner)->stats.totalSeconds * 1e3);
      }
      figures.add(what, "ms", gl, "list on the CPU", list);
    }
  return {};
}

}  // namespace acentric::bench
