#include "engine/cli/bench_gl/gl_timing.h"

#include <fmt/format.h>

#include <thread>

#include "engine/base/stopwatch.h"
#include "engine/cli/machine/commit.h"
#include "engine/measure/statistics.h"
#include "engine/view_gl/gl_renderer.h"

namespace acentric::cli {
namespace {

constexpr const char* kMeasured =
    "frame: wall time from planning the view until the card has finished drawing (glFinish), the picture not "
    "read back; card: the same by the card's clock (GL_TIMESTAMP), without planning; readBack: reading "
    "colours and sources back afterwards";

struct Times {
  std::vector<double> frame, card, readBack;  // milliseconds
  std::uint64_t patches = 0;
  FrameStats last;
};

std::vector<PerspectiveView> viewsOf(const PackedWalk& packed, const GlTimingOptions& options) {
  const std::size_t all = packed.path.poses.size();
  const std::size_t count = options.frames > 0 ? std::min(all, std::size_t(options.frames)) : all;
  std::vector<PerspectiveView> views;
  for (std::size_t i = 0; i < count; ++i)
    views.push_back(viewAt(packed.path.poses[i * all / count], packed.project.fovDegrees, options.pixels));
  return views;
}

}  // namespace

Result<GlTiming> timeGl(const PackedWalk& packed, const GlTimingOptions& options) {
  auto context = HeadlessContext::create();
  if (!context) return tl::unexpected(context.error());
  TaskRunner runner(int(std::max(1U, std::thread::hardware_concurrency())) - 1);  // for planning
  const auto renderer = GlRenderer::create({.runner = &runner});
  if (!renderer) return tl::unexpected(renderer.error());
  const std::vector<PerspectiveView> views = viewsOf(packed, options);
  ViewSettings settings = packed.project.view;
  settings.renderer = Renderer::gl;
  settings.reconstruction = Reconstruction::patches;
  Times times;
  for (int repeat = 0; repeat < options.repeats + 1; ++repeat)
    for (const PerspectiveView& view : views) {
      const auto stats = (*renderer)->draw(packed.walk, view, settings);
      if (!stats) return tl::unexpected(stats.error());
      const Stopwatch reading;
      if ((*renderer)->readBack().source.empty()) return fail(ErrorKind::internal, "no picture was drawn");
      if (repeat == 0) continue;  // sends captures to the card, compiles shaders
      times.frame.push_back(stats->totalSeconds * 1e3);
      times.card.push_back((*renderer)->cardSeconds() * 1e3);
      times.readBack.push_back(reading.seconds() * 1e3);
      times.patches += stats->samplesRead;
      times.last = *stats;
    }

  const Spread frame = spreadOf(times.frame), card = spreadOf(times.card),
               readBack = spreadOf(times.readBack);
  const double patches = double(times.patches) / double(std::max<std::size_t>(times.frame.size(), 1));
  GlTiming out;
  out.json = {{"version", ACENTRIC_VERSION},
              {"commit", commitName()},
              {"glRenderer", (*context)->description()},
              {"width", options.pixels.x},
              {"height", options.pixels.y},
              {"frames", views.size()},
              {"repeats", options.repeats},
              {"measured", kMeasured},
              {"frameMsMedian", frame.median},
              {"frameMsP99", frame.p99},
              {"cardMsMedian", card.median},
              {"cardMsP99", card.p99},
              {"readBackMsMedian", readBack.median},
              {"framesPerSecond", frame.median > 0 ? 1e3 / frame.median : 0},
              {"patchesPerFrame", patches},
              {"localTriangles", times.last.localTriangles}};
  out.text = fmt::format(
      "{}\n{}x{}, {} frames x {}\n"
      "  frame {:.3f} ms median, {:.3f} ms p99; card {:.3f} ms; read back {:.3f} ms; {:.0f} patches\n",
      (*context)->description(), options.pixels.x, options.pixels.y, views.size(), options.repeats,
      frame.median, frame.p99, card.median, readBack.median, patches);
  out.text += fmt::format("{}\n", kMeasured);
  return out;
}

}  // namespace acentric::cli
