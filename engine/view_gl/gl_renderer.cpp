#include "engine/view_gl/gl_renderer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <chrono>

#include "engine/base/contract.h"
#include "engine/view/view_plan.h"
#include "engine/view_gl/capture_buffers.h"
#include "engine/view_gl/frame_target.h"
#include "engine/view_gl/gl_check.h"
#include "engine/view_gl/gl_program.h"
#include "engine/view_gl/gl_state.h"
#include "engine/view_gl/point_pass.h"

namespace acentric {
namespace {

/// Captures beyond this leave graphics memory, those unused for longest first.
constexpr std::size_t kCaptureBudgetBytes = std::size_t(2) << 30;

using Clock = std::chrono::steady_clock;

/// Seconds since `start`, after the work submitted so far is done: statistics are of drawing, not of
/// queueing.
double secondsOfDrawing(Clock::time_point start) {
  glFinish();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

struct GlRenderer::Impl {
  ProgramCache programs;
  CaptureResidency captures;
  FrameTarget target;
  PointPass points{programs, captures};
  FrameStats stats;

  Result<FrameStats> draw(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings);
};

Result<FrameStats> GlRenderer::Impl::draw(const WalkScene& scene, const PerspectiveView& view,
                                          const ViewSettings& settings) {
  const Clock::time_point start = Clock::now();
  const Result<ViewPlan> plan = planView(scene, view, settings);
  if (!plan) return tl::unexpected(plan.error());

  const GlStateGuard guard;
  forgetGlErrors();
  stats = {};
  stats.missingImages = plan->missingImages;
  captures.dropGone(scene);
  if (Status sized = target.resize(view.width, view.height); !sized) return tl::unexpected(sized.error());
  target.begin();
  const Clock::time_point warpStart = Clock::now();
  if (Status drawn = points.draw(scene, *plan, view, settings, target, stats); !drawn)
    return tl::unexpected(drawn.error());
  stats.warpSeconds = secondsOfDrawing(warpStart);
  captures.trim(kCaptureBudgetBytes);
  stats.totalSeconds = secondsOfDrawing(start);
  return stats;
}

GlRenderer::GlRenderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
GlRenderer::~GlRenderer() = default;

Result<std::unique_ptr<GlRenderer>> GlRenderer::create() {
  const int version = epoxy_gl_version();
  if (version < 43 || !epoxy_is_desktop_gl())
    return fail(
        ErrorKind::unsupported,
        fmt::format("the current context has OpenGL {}.{}, at least 4.3 is needed: use a CPU renderer",
                    version / 10, version % 10),
        "OpenGL");
  const GlStateGuard guard;
  forgetGlErrors();
  std::unique_ptr<GlRenderer> renderer(new GlRenderer(std::make_unique<Impl>()));
  // The variant that every walk needs: a driver that refuses our shaders says so now, not in the first frame.
  const Result<GlProgram*> program = renderer->impl_->programs.get("points.vert", "points.frag", {"SPLAT"});
  if (!program) return tl::unexpected(program.error());
  if (Status made = checkGl("starting"); !made) return tl::unexpected(made.error());
  return renderer;
}

Result<FrameStats> GlRenderer::draw(const WalkScene& scene, const PerspectiveView& view,
                                    const ViewSettings& settings) {
  return impl_->draw(scene, view, settings);
}

unsigned GlRenderer::colourTexture() const { return impl_->target.colourCodes(); }

Frame GlRenderer::readBack() const {
  const GlStateGuard guard;
  Frame frame = impl_->target.read();
  frame.stats = impl_->stats;
  return frame;
}

std::vector<std::string> GlRenderer::variants() const { return impl_->programs.variants(); }

}  // namespace acentric
